// Plots of a table of results: along the axes of a sweep, and balls against error.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "report/compare.hpp"

namespace ballflow::report {

/// SVG pictures one after the other: number of balls with its proven bound, gap, distances. Empty when the
/// table has fewer than two rows. `report`: of the run; `all`: its table with the fields of all outputs.
std::string result_plots(const nlohmann::json& report, const cli::Comparison& all);

}  // namespace ballflow::report
