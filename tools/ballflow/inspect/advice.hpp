// From the facts about a model to what a run makes of it and what to do about that.
#pragma once

#include "inspect/model_report.hpp"

namespace ballflow::inspect {

/// Fills in samples, labels, findings and command from the rest of the report.
void advise(ModelReport& report);

}  // namespace ballflow::inspect
