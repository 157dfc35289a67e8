// The style sheet of a report.
#pragma once

#include <string>

namespace ballflow::report {

/// Light and dark after the reader's setting; the colours of series are those of categories in pictures.
std::string style_sheet();

}  // namespace ballflow::report
