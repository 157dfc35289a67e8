#include "minkowski/minkowski_sum_2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "minkowski/hierarchical_sums.hpp"
#include "minkowski/plane_sums.hpp"
#include "minkowski/sum_lists.hpp"
#include "power/regular_triangulation_2.hpp"
#include "power/usable_balls.hpp"

namespace ballflow::geometry {
namespace {

// Measured with bench_minkowski: lists as in space, a vertex with two triangles about 200 bytes, and all that
// were ever vertices 40.
constexpr double bytes_per_vertex = 250, bytes_per_pair = 72 + bytes_per_vertex / 4,
                 bytes_per_survivor = 72 + bytes_per_vertex / 2;

void bound_error(const PolygonComparisons& of, MinkowskiReport& report) {
  if (of.a == nullptr && of.b == nullptr) return;
  report.error_bound = 0;
  const auto add = [&report](const OutlineComparison* comparison, std::uint8_t& compared_with) {
    if (comparison == nullptr) return;
    if (const std::string broken = broken_invariant(*comparison); !broken.empty())
      throw InputError("a comparison is damaged: " + broken, "compute it again");
    report.error_bound += comparison->a_to_b_at_most;
    compared_with = static_cast<std::uint8_t>(ComparedWith::closed_mesh);
  };
  add(of.a, report.a_compared_with);
  add(of.b, report.b_compared_with);
}

Ball ball_of(const Balls& balls, std::size_t i) { return {balls.centers[i], balls.radii[i]}; }

/// Three sums whose centers are not on one line, as they are rounded; none where a and b are on one line.
std::optional<std::array<Ball, 3>> corners(const Balls& a, const Balls& b) {
  const Ball first = ball_of(a, 0) + ball_of(b, 0);
  std::optional<Ball> second;
  for (std::size_t i = 1; i < a.size() + b.size(); ++i) {
    const Ball sum = i < a.size() ? ball_of(a, i) + ball_of(b, 0) : ball_of(a, 0) + ball_of(b, i - a.size());
    if (sum.center == first.center) continue;
    if (!second) {
      second = sum;
      continue;
    }
    const auto plane = [](const Ball& ball) { return Vec2{ball.center.x, ball.center.y}; };
    if (orientation(plane(first), plane(*second), plane(sum)) != 0) return std::array{first, *second, sum};
  }
  return std::nullopt;
}

}  // namespace

MinkowskiSum2 minkowski_sum_2(const Balls& a, const Balls& b, const MinkowskiSum2Options& options,
                              Monitor& monitor, const PolygonComparisons& of) {
  require_discs(a, "a", "MinkowskiSum");
  require_discs(b, "b", "MinkowskiSum");
  MinkowskiSum2 result;
  const Sums sums(a, b);
  bound_error(of, result.report);
  result.report.pairs = sums.pairs();
  const bool minimal = options.keep == MinkowskiKeep::minimal;
  if (sums.pairs() == 0) {
    if (minimal) result.report.minimal = 0;
    return result;
  }
  const auto begin = corners(a, b);
  if (!begin) {
    // On one line, where the triangulation in space knows what to do. Every disc that contributes has an arc.
    // So it is needed.
    MinkowskiSum line = minkowski_sum(a, b, {}, monitor);
    result.balls = std::move(line.balls);
    result.report = line.report;
    if (minimal) result.report.minimal = result.report.count;
    bound_error(of, result.report);
    return result;
  }
  PartMonitor most(monitor, 0, minimal ? 0.6 : 1);
  PlaneSums triangulation((*begin)[0], (*begin)[1], (*begin)[2]);
  if (options.algorithm == MinkowskiAlgorithm2::hierarchical) {
    result.report.survivors =
        HierarchicalSums(a, b, triangulation, {bytes_per_survivor, bytes_per_vertex}).run(most);
    result.avoided = result.report.pairs - result.report.survivors;
  } else {
    const bool all = options.algorithm == MinkowskiAlgorithm2::quadratic;
    std::vector<Ball> left =
        all ? all_sums(sums, bytes_per_pair, most) : filtered_sums(sums, bytes_per_survivor, most);
    result.report.survivors = static_cast<std::int64_t>(left.size());
    PartMonitor part(most, 0.15, 0.9);
    triangulation.insert(std::move(left), part);
  }
  PartMonitor part(most, 0.9, 1);
  Contributing found = triangulation.contributing(part);
  result.report.survivors = std::max(result.report.survivors, static_cast<std::int64_t>(found.balls.size()));
  PartMonitor last(monitor, minimal ? 0.6 : 1, 1);
  result.balls = keep(std::move(found), options.keep, UnionOf::discs, result.report, last);
  return result;
}

}  // namespace ballflow::geometry
