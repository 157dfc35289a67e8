// The outputs of one run, each with what it is in words and a short table of its numbers.
#pragma once

#include <string>
#include <vector>

#include "report/report_page.hpp"

namespace ballflow::report {

/// The names of the outputs of a run: by type what people look for first, others by name.
std::vector<std::string> outputs_in_order(const nlohmann::json& report);

/// HTML; empty for a sweep and for a run without outputs.
std::string output_cards(const ReportInput& input);

}  // namespace ballflow::report
