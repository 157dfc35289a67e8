#include "types/way.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace ballflow::geometry {
namespace {

std::string rounded_length(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

double length(const Way& way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.points.size(); ++i) sum += distance(way.points[i - 1], way.points[i]);
  return sum;
}

std::string describe(const Way& way) {
  const bool contain = way.proof == static_cast<std::uint8_t>(WayProof::contain),
             inside = way.proof == static_cast<std::uint8_t>(WayProof::inside);
  const auto ball = [](const char* what, std::int32_t i) {
    return std::string(what) + " is in ball " + std::to_string(i);
  };
  // What is in a ball of those that lie in the forbidden places is forbidden.
  const std::string hit = inside ? ": proven to be a collision" : contain ? ": perhaps a collision" : "";
  switch (way.said()) {
    case WayAnswer::way: {
      const std::string proven = contain ? ": proven" : inside ? ", but the solids may be in it" : "";
      if (way.points.empty()) return "there is a way, narrower than rounding tells" + proven;
      return "a way of length " + rounded_length(length(way)) + ", nowhere nearer than " +
             rounded_length(way.clearance) + " to a ball" + proven;
    }
    case WayAnswer::none:
      return "no way: the balls part start (component " + std::to_string(way.start_component) +
             " of what they leave) from goal (component " + std::to_string(way.goal_component) + ")" +
             (inside    ? ": proven"
              : contain ? "; a closer fit may find one"
                        : "");
    case WayAnswer::start_inside:
      return ball("the start", way.start_ball) + hit;
    case WayAnswer::goal_inside:
      return ball("the goal", way.goal_ball) + hit;
    case WayAnswer::both_inside:
      return ball("the start", way.start_ball) + ", and " + ball("the goal", way.goal_ball) + hit;
  }
  return {};
}

std::string broken_invariant(const Way& w) {
  if (w.answer > static_cast<std::uint8_t>(WayAnswer::both_inside)) return "the answer is above 4";
  if (w.proof > static_cast<std::uint8_t>(WayProof::inside)) return "the proof is above 2";
  if (!is_finite(w.start) || !is_finite(w.goal)) return "start or goal is not finite";
  if (w.balls < 0 || w.components < 1) return "the number of balls or components is too small";
  const auto one = [&](const char* name, bool is_inside, std::int32_t component,
                       std::int32_t ball) -> std::string {
    if (is_inside ? component != -1 || ball < 0 || ball >= w.balls
                  : component < 0 || component >= w.components || ball != -1)
      return std::string("component or ball of the ") + name + " does not fit the answer";
    return {};
  };
  const WayAnswer said = w.said();
  const bool both = said == WayAnswer::both_inside;
  if (std::string why =
          one("start", both || said == WayAnswer::start_inside, w.start_component, w.start_ball);
      !why.empty())
    return why;
  if (std::string why = one("goal", both || said == WayAnswer::goal_inside, w.goal_component, w.goal_ball);
      !why.empty())
    return why;
  if (said == WayAnswer::way && w.start_component != w.goal_component) return "a way between two components";
  if (said == WayAnswer::none && w.start_component == w.goal_component) return "no way within one component";
  if (w.clearances.size() != w.points.size()) return "not as many clearances as points";
  if (w.points.empty()) return {};
  if (said != WayAnswer::way) return "a polyline, but no way";
  if (!(w.points.front() == w.start) || !(w.points.back() == w.goal)) return "the polyline has other ends";
  if (!(w.clearance >= 0) || !std::isfinite(w.clearance)) return "the clearance is negative or not finite";
  for (std::size_t i = 0; i < w.points.size(); ++i) {
    if (!is_finite(w.points[i]) || !(w.clearances[i] >= 0) || std::isnan(w.clearances[i]))
      return "point " + std::to_string(i) + " is not finite, or without clearance";
  }
  return {};
}

}  // namespace ballflow::geometry
