#include "minkowski/minkowski_sum_2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "base/space_order.hpp"
#include "minkowski/disc_tree.hpp"
#include "minkowski/plane_sums.hpp"
#include "minkowski/sum_lists.hpp"
#include "power/regular_triangulation_2.hpp"

namespace ballflow::geometry {
namespace {

// Measured with bench_minkowski: lists as in space, a vertex with two triangles about 200 bytes, and all that
// were ever vertices 40.
constexpr double bytes_per_vertex = 250, bytes_per_pair = 72 + bytes_per_vertex / 4,
                 bytes_per_survivor = 72 + bytes_per_vertex / 2;

void require_plane(const Balls& discs, const char* name) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (discs.centers[i].z == 0) continue;
    throw InputError("input " + std::string(name) + ": ball " + std::to_string(i) +
                         " has its center at z = " + std::to_string(discs.centers[i].z) +
                         ", and discs have z = 0",
                     "MinkowskiSum takes balls in space");
  }
}

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

/// The tree is over the larger set. First come the sums with the largest disc of every leaf, together, which
/// hide most others. Then every disc of the smaller set goes down the tree, level by level, as long as its
/// sum with the disc around a node may contribute: if that contributes nothing, neither do the sums below,
/// since in a disc inside another one the power to the other is not larger. The questions of a level are
/// asked in the order of a curve through the plane, so that the place of one is near that of the one before.
class Hierarchical {
 public:
  Hierarchical(const Balls& a, const Balls& b, PlaneSums& triangulation)
      : small_(a.size() < b.size() ? a : b),
        tree_(disc_tree(a.size() < b.size() ? b : a, leaf_size)),
        triangulation_(triangulation) {}

  /// Inserts what may contribute; returns how many pairs were looked at.
  std::int64_t run(Monitor& monitor) {
    const MemoryLimit memory(monitor);
    std::int64_t leaves = 0;
    for (const DiscTreeNode& node : tree_) leaves += node.children < 0;
    const std::int64_t first_sums = leaves * static_cast<std::int64_t>(small_.size());
    require_memory(first_sums, bytes_per_pair, memory);
    std::vector<Ball> sums;
    sums.reserve(static_cast<std::size_t>(first_sums));
    for (std::size_t i = 0; i < small_.size(); ++i) {
      for (const DiscTreeNode& node : tree_) {
        if (node.children < 0) sums.push_back(ball_of(small_, i) + node.largest);
      }
    }
    PartMonitor part(monitor, 0, 0.4);
    triangulation_.insert(std::move(sums), part);
    return first_sums + insert_below(memory, monitor);
  }

 private:
  // Of 4, 8, 16 and 24 the fastest for sums of 274 000 pairs.
  static constexpr std::size_t leaf_size = 16;
  // Nodes with more discs are entered without a question: hardly any of them is passed by.
  static constexpr std::int64_t asked_size = 64;

  struct Question {
    Ball bound;  // around the sums of a disc of the smaller set and those below a node
    std::int32_t disc, node;
  };

  Question question(std::int32_t disc, std::int32_t node) const {
    Ball one = ball_of(small_, static_cast<std::size_t>(disc));
    // By more than what rounding a sum can push it out.
    one.radius += 0x1p-48 * (one.radius + std::abs(one.center.x) + std::abs(one.center.y));
    return {one + tree_[static_cast<std::size_t>(node)].bound, disc, node};
  }

  /// Inserts the sums in leaves that may contribute, but those with the largest disc of each; how many.
  std::int64_t insert_below(const MemoryLimit& memory, Monitor& monitor) {
    std::int64_t inserted = 0;
    std::vector<Question> level, next;
    for (std::size_t i = 0; i < small_.size(); ++i)
      level.push_back(question(static_cast<std::int32_t>(i), 0));
    Lookout look(monitor);
    while (!level.empty()) {
      next.clear();
      for (const std::uint32_t k : along_curve(level)) {
        look(512);
        const Question& q = level[k];
        const DiscTreeNode& node = tree_[static_cast<std::size_t>(q.node)];
        if (node.count <= asked_size && !triangulation_.may_contribute(q.bound)) continue;
        const Ball disc = ball_of(small_, static_cast<std::size_t>(q.disc));
        for (const Ball& other : node.discs) triangulation_.insert(disc + other);
        inserted += static_cast<std::int64_t>(node.discs.size());
        if (node.children < 0) continue;
        for (std::int32_t child = node.children; child != node.next;
             child = tree_[static_cast<std::size_t>(child)].next)
          next.push_back(question(q.disc, child));
      }
      std::swap(level, next);
      require_memory(static_cast<std::int64_t>(triangulation_.vertices()), bytes_per_vertex, memory);
    }
    return inserted;
  }

  static std::vector<std::uint32_t> along_curve(const std::vector<Question>& level) {
    Box box;
    for (const Question& q : level) box.add(q.bound.center);
    const SpaceOrder place(box);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(level.size());
    for (std::size_t i = 0; i < level.size(); ++i)
      order[i] = {place(level[i].bound.center), static_cast<std::uint32_t>(i)};
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    result.reserve(order.size());
    for (const auto& [key, i] : order) result.push_back(i);
    return result;
  }

  const Balls& small_;
  const std::vector<DiscTreeNode> tree_;
  PlaneSums& triangulation_;
};

}  // namespace

MinkowskiSum2 minkowski_sum_2(const Balls& a, const Balls& b, const MinkowskiSum2Options& options,
                              Monitor& monitor, const PolygonComparisons& of) {
  require_usable(a, "a");
  require_usable(b, "b");
  require_plane(a, "a");
  require_plane(b, "b");
  MinkowskiSum2 result;
  const Sums sums(a, b);
  bound_error(of, result.report);
  result.report.pairs = sums.pairs();
  if (sums.pairs() == 0) return result;
  const auto begin = corners(a, b);
  if (!begin) {
    // On one line, where the triangulation in space knows what to do. Every disc that contributes has an arc.
    MinkowskiSum line = minkowski_sum(a, b, {}, monitor);
    result.balls = std::move(line.balls);
    result.report = line.report;
    bound_error(of, result.report);
    return result;
  }
  PlaneSums triangulation((*begin)[0], (*begin)[1], (*begin)[2]);
  if (options.algorithm == MinkowskiAlgorithm2::hierarchical) {
    result.report.survivors = Hierarchical(a, b, triangulation).run(monitor);
    result.avoided = result.report.pairs - result.report.survivors;
  } else {
    const bool all = options.algorithm == MinkowskiAlgorithm2::quadratic;
    std::vector<Ball> left =
        all ? all_sums(sums, bytes_per_pair, monitor) : filtered_sums(sums, bytes_per_survivor, monitor);
    result.report.survivors = static_cast<std::int64_t>(left.size());
    PartMonitor part(monitor, 0.15, 0.9);
    triangulation.insert(std::move(left), part);
  }
  PartMonitor part(monitor, 0.9, 1);
  Contributing found = triangulation.contributing(part);
  result.report.count = static_cast<std::int64_t>(found.balls.size());
  result.report.survivors = std::max(result.report.survivors, result.report.count);
  result.report.touching_boundary = found.touching_boundary;
  result.balls = canonical(std::move(found.balls));
  const Box box = bounding_box(result.balls);
  result.report.lower = box.lower;
  result.report.upper = box.upper;
  return result;
}

}  // namespace ballflow::geometry
