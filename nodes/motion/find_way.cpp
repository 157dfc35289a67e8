#include "motion/find_way.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "exact/separation.hpp"
#include "motion/ball_boxes.hpp"
#include "motion/free_segments.hpp"
#include "motion/free_skeleton.hpp"
#include "power/power_diagram.hpp"
#include "power/voids.hpp"

namespace ballflow::geometry {
namespace {

void check_point(Vec3 p, const char* name) {
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (is_finite(p) && largest <= largest_separable) return;
  throw InputError(std::string(name) + " has a coordinate that is not finite, or beyond 1e140",
                   "give a point near the balls, in their unit");
}

struct End {
  std::int32_t component = -1, ball = -1;
};

End end_at(Vec3 p, const FreeSegments& segments, const Voids& voids, const PowerDiagram& diagram) {
  End end;
  end.ball = segments.ball_at(p);
  if (end.ball >= 0) return end;
  end.component = voids.place_of(p).number;
  if (end.component >= 0) return end;
  // On the sphere but for what was rounded when the radius was squared.
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < diagram.centers.size(); ++i) {
    const double power = squared_distance(p, diagram.centers[i]) - diagram.weights[i];
    if (power < least) least = power, end.ball = static_cast<std::int32_t>(i);
  }
  return end;
}

/// Leaves out corners where the way between others keeps the clearance.
std::vector<Vec3> straightened(const std::vector<Vec3>& way, double clearance, const FreeSegments& segments,
                               Monitor& monitor) {
  std::vector<Vec3> kept{way.front()};
  for (std::size_t i = 0; i + 1 < way.size();) {
    std::size_t j = way.size() - 1;
    for (; j > i + 1; --j) {
      if (monitor.cancelled()) throw Cancelled();
      if (segments.clearance(way[i], way[j], clearance) >= clearance) break;
    }
    kept.push_back(way[j]);
    i = j;
  }
  return kept;
}

/// Points between the points, so that corners can be cut nearer to them.
std::vector<Vec3> divided(const std::vector<Vec3>& way) {
  constexpr int pieces = 8;
  std::vector<Vec3> points{way.front()};
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (int k = 1; k < pieces; ++k)
      points.push_back(way[i - 1] + (static_cast<double>(k) / pieces) * (way[i] - way[i - 1]));
    points.push_back(way[i]);
  }
  return points;
}

double clearance_of(const std::vector<Vec3>& way, const FreeSegments& segments) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < way.size(); ++i)
    least = std::min(least, segments.clearance(way[i], way[std::min(i + 1, way.size() - 1)]));
  return least;
}

}  // namespace

Vec3 parse_point(std::string_view text, const char* name) {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = text.data() + text.size();
  while (at != end) {
    if (*at == ' ' || *at == ',' || *at == '\t') {
      ++at;
      continue;
    }
    if (*at == '+' && at + 1 != end) ++at;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool whole = next == end || *next == ' ' || *next == ',' || *next == '\t';
    if (error != std::errc() || !whole || !std::isfinite(value)) break;
    numbers.push_back(value);
    at = next;
  }
  if (at != end || numbers.size() != 3)
    throw InputError(std::string(name) + " is \"" + std::string(text) + "\"",
                     "give three finite numbers, as in \"0 1.5 -2\"");
  return {numbers[0], numbers[1], numbers[2]};
}

Way find_way(const Balls& balls, const PowerDiagram& diagram, Vec3 start, Vec3 goal, Monitor& monitor,
             const MinkowskiReport* report) {
  if (balls.size() == 0)
    throw InputError("there are no balls: nothing is in the way", "give at least one ball");
  check_diagram_of(diagram, balls);
  check_point(start, "start");
  check_point(goal, "goal");
  const BallBoxes boxes(balls, monitor);
  const FreeSegments segments(boxes);
  const Voids voids(diagram, monitor);
  monitor.step(0.2);

  Way way;
  way.balls = static_cast<std::int64_t>(balls.size());
  way.start = start;
  way.goal = goal;
  if (report != nullptr) {
    const WayProof proof = report->contains() ? WayProof::contain
                           : report->inside() ? WayProof::inside
                                              : WayProof::balls;
    way.proof = static_cast<std::uint8_t>(proof);
  }
  way.components = voids.count();
  const End from = end_at(start, segments, voids, diagram), to = end_at(goal, segments, voids, diagram);
  way.start_component = from.component;
  way.goal_component = to.component;
  way.start_ball = from.component >= 0 ? -1 : from.ball;
  way.goal_ball = to.component >= 0 ? -1 : to.ball;
  const bool start_inside = from.component < 0, goal_inside = to.component < 0;
  const WayAnswer answer = start_inside && goal_inside      ? WayAnswer::both_inside
                           : start_inside                   ? WayAnswer::start_inside
                           : goal_inside                    ? WayAnswer::goal_inside
                           : from.component == to.component ? WayAnswer::way
                                                            : WayAnswer::none;
  way.answer = static_cast<std::uint8_t>(answer);
  if (answer != WayAnswer::way) return way;

  const FreeSkeleton skeleton(diagram, voids, monitor);
  monitor.step(0.5);
  std::vector<Vec3> points = skeleton.way(start, goal, from.component);
  if (points.size() < 2) points = {start, goal};  // one place is a way to itself
  const double clearance = clearance_of(points, segments);
  monitor.step(0.7);
  if (clearance > 0) {
    points = straightened(points, clearance, segments, monitor);
    // Every round cuts corners off that are left; after some there is little to gain, and few points to
    // divide.
    for (int round = 0; round < 4 && points.size() > 2 && points.size() < 200; ++round) {
      // What lies on a segment has its clearance, but for rounding.
      const double enough = clearance_of(points, segments) * (1 - 1e-9);
      points = straightened(divided(points), enough, segments, monitor);
    }
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (monitor.cancelled()) throw Cancelled();
    if (!segments.free(points[i], points[i + 1])) return way;  // rounding has closed it
  }
  way.clearance = std::max(0.0, clearance_of(points, segments));
  std::vector<double> clearances;
  clearances.reserve(points.size());
  for (const Vec3& p : points) clearances.push_back(std::max(0.0, segments.clearance(p, p)));
  way.points = std::move(points);
  way.clearances = std::move(clearances);
  return way;
}

}  // namespace ballflow::geometry
