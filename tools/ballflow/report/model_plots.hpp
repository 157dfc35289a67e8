// Plots of models of shapes: how good they are with 0, 1, ... modes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ballflow::report {

/// SVG pictures one after the other for every output of type ShapePrior in a report: part of the variance in
/// the first modes, generalization and specificity, each with a standard deviation below it. Empty where
/// there is none.
std::string model_plots(const nlohmann::json& report);

}  // namespace ballflow::report
