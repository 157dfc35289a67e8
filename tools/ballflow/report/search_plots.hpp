// Plots of what longer searches found.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ballflow::report {

/// An SVG picture for every node of a report whose output has a `curve` in its summary, rows of (steps,
/// balls): how many balls the cover had after how many steps, and the lower bound of the same summary. Empty
/// where there is none; rows that are no two numbers are left out.
std::string search_plots(const nlohmann::json& report);

}  // namespace ballflow::report
