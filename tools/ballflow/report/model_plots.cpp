#include "report/model_plots.hpp"

#include <utility>

#include "report/html.hpp"
#include "report/member.hpp"
#include "report/plot.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;

/// A curve over the number of modes, which is `first` at its first value, and a standard deviation around it.
std::string drawn(const std::string& title, const std::string& y_name, int first, const Value& values,
                  const Value& deviations) {
  if (values.empty()) return "";
  Plot plot;
  plot.title = title;
  plot.x_name = "modes";
  plot.y_name = y_name;
  plot.zero = true;
  Series mean, around;
  around.name = "a standard deviation above";
  around.guide = true;
  Series below = around;
  below.name = "a standard deviation below";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) + first, y = number_of(values[i]);
    mean.x.push_back(x);
    mean.y.push_back(y);
    if (i >= deviations.size()) continue;
    const double deviation = number_of(deviations[i]);
    mean.labels.push_back("standard deviation " + number(deviation));
    around.x.push_back(x);
    around.y.push_back(y + deviation);
    below.x.push_back(x);
    below.y.push_back(y > deviation ? y - deviation : 0);
  }
  plot.series.push_back(std::move(mean));
  if (!around.x.empty()) {
    plot.series.push_back(std::move(around));
    plot.series.push_back(std::move(below));
  }
  return svg(plot);
}

}  // namespace

std::string model_plots(const nlohmann::json& report) {
  std::string out;
  const Value& outputs = member(report, "outputs");
  if (!outputs.is_object()) return out;
  for (const auto& [name, output] : outputs.items()) {
    if (member(output, "type") != "ShapePrior") continue;
    const Value& summary = member(output, "summary");
    out += drawn("Compactness (" + name + "): part of the variance in the first modes", "part", 1,
                 member(summary, "compactness"), Value());
    out += drawn("Generalization (" + name + "): distance of an instance from the model of the others",
                 "model units", 0, member(summary, "generalization"),
                 member(summary, "generalization_deviation"));
    out += drawn("Specificity (" + name + "): distance of random shapes from the nearest instance",
                 "model units", 1, member(summary, "specificity"), member(summary, "specificity_deviation"));
  }
  return out;
}

}  // namespace ballflow::report
