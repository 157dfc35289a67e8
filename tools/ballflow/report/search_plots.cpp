#include "report/search_plots.hpp"

#include <cmath>
#include <utility>

#include "report/member.hpp"
#include "report/plot.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;

std::string drawn(const std::string& node, const Value& curve, double bound) {
  Plot plot;
  plot.title = "Balls after steps of " + node + ", and what every cover needs";
  plot.x_name = "steps";
  plot.y_name = "balls";
  Series balls, least;
  balls.name = "balls";
  least.name = "lower bound";
  least.guide = true;
  for (const Value& row : curve) {
    if (!row.is_array() || row.size() != 2) continue;
    const double steps = number_of(row[0]), count = number_of(row[1]);
    if (!std::isfinite(steps) || !std::isfinite(count)) continue;
    balls.x.push_back(steps);
    balls.y.push_back(count);
    least.x.push_back(steps);
    least.y.push_back(bound);
  }
  if (balls.x.empty()) return "";
  plot.series.push_back(std::move(balls));
  if (std::isfinite(bound)) plot.series.push_back(std::move(least));
  return svg(plot);
}

}  // namespace

std::string search_plots(const nlohmann::json& report) {
  std::string out;
  const Value& nodes = member(report, "nodes");
  if (!nodes.is_object()) return out;
  for (const auto& [path, node] : nodes.items()) {
    const Value& outputs = member(node, "outputs");
    if (!outputs.is_object()) continue;
    for (const auto& [port, output] : outputs.items()) {
      const Value& summary = member(output, "summary");
      const Value& curve = member(summary, "curve");
      if (curve.is_array()) out += drawn(path, curve, number_of(member(summary, "lower_bound")));
    }
  }
  return out;
}

}  // namespace ballflow::report
