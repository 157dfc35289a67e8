// From the facts about a model to what a run makes of it and what to do about that.
#pragma once

#include <string>

#include "inspect/model_report.hpp"

namespace ballflow::inspect {

/// The node of medial_axis.json that reads the model.
extern const std::string sample_node;

/// Fills in samples, labels, findings and command from the rest of the report.
void advise(ModelReport& report);

}  // namespace ballflow::inspect
