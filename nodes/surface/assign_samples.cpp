#include "surface/assign_samples.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "power/power_walk.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The ball to which a point has the least power.
class PowerTree {
 public:
  /// Some of the balls; keeps a reference.
  PowerTree(const Balls& balls, std::vector<std::int32_t> some, Monitor& monitor)
      : balls_(balls), some_(std::move(some)), tree_(centers_of(balls, some_), leaf_size, monitor) {
    const auto nodes = tree_.nodes();
    largest_.assign(nodes.size(), 0);
    for (std::size_t self = nodes.size(); self-- > 0;) {
      const BoxTree::Node& node = nodes[self];
      if (node.second != 0) {
        largest_[self] = std::max(largest_[self + 1], largest_[at(node.second)]);
        continue;
      }
      for (std::int32_t k = node.first; k < node.last; ++k)
        largest_[self] = std::max(largest_[self], weight(ball(k)));
    }
  }

  std::int32_t nearest(Vec3 p) const {
    std::int32_t best = -1;
    double least = std::numeric_limits<double>::infinity();  // no power is below it but the best ball's
    std::array<std::pair<double, std::int32_t>, 80> stack;   // the size halves at every level
    std::size_t depth = 0;
    stack[depth++] = {bound(0, p), 0};
    while (depth > 0) {
      const auto [low, self] = stack[--depth];
      if (low > least) continue;
      const BoxTree::Node& node = tree_.nodes()[at(self)];
      if (node.second != 0) {
        std::pair<double, std::int32_t> near{bound(self + 1, p), self + 1},
            far{bound(node.second, p), node.second};
        if (far.first < near.first) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
        continue;
      }
      for (std::int32_t k = node.first; k < node.last; ++k) {
        const std::int32_t i = ball(k);
        if (best >= 0) {
          const int order =
              compare_powers(p, balls_.centers[at(best)], weight(best), balls_.centers[at(i)], weight(i));
          if (order > 0 || (order == 0 && i > best)) continue;
        }
        best = i;
        const double squared = squared_distance(balls_.centers[at(i)], p);
        least = squared - weight(i) + slack * (squared + weight(i));
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  static constexpr double slack = 0x1p-48;  // of the terms of a power, beyond what rounding takes

  static std::vector<Vec3> centers_of(const Balls& balls, const std::vector<std::int32_t>& some) {
    std::vector<Vec3> centers;
    centers.reserve(some.size());
    for (const std::int32_t i : some) centers.push_back(balls.centers[at(i)]);
    return centers;
  }
  double weight(std::int32_t i) const { return balls_.radii[at(i)] * balls_.radii[at(i)]; }
  std::int32_t ball(std::int32_t k) const { return some_[at(tree_.order()[at(k)])]; }
  /// No ball of a node has a power below it.
  double bound(std::int32_t self, Vec3 p) const {
    const double d = distance_to_box(tree_.nodes()[at(self)].box, p), w = largest_[at(self)];
    return d * d - w - slack * (d * d + w);
  }

  const Balls& balls_;
  std::vector<std::int32_t> some_;
  BoxTree tree_;
  std::vector<double> largest_;  // per node the largest weight in it
};

/// Per ball the first vertex of the surface that is its centre, or -1.
std::vector<std::int32_t> first_vertices(const SurfaceReport& surface, std::size_t balls) {
  std::vector<std::int32_t> vertex(balls, -1);
  for (std::size_t v = 0; v < surface.vertex_balls.size(); ++v) {
    const std::int32_t ball = surface.vertex_balls[v];
    if (ball < 0) continue;
    if (at(ball) >= balls) {
      throw InputError("vertex " + std::to_string(v) + " of the surface is the centre of ball " +
                           std::to_string(ball) + ", but there are " + std::to_string(balls) + " balls",
                       "connect the balls whose power diagram the surface was made of");
    }
    if (vertex[at(ball)] < 0) vertex[at(ball)] = static_cast<std::int32_t>(v);
  }
  return vertex;
}

std::vector<std::int32_t> nearest_of(const Balls& balls, std::vector<std::int32_t> some,
                                     const Array<Vec3>& points, Monitor& monitor) {
  const PowerTree tree(balls, std::move(some), monitor);
  std::vector<std::int32_t> result(points.size());
  for_each_block(points.size(), 1024, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) result[i] = tree.nearest(points[i]);
  });
  return result;
}

}  // namespace

SampleAssignment assign_samples(const Balls& balls, const PointSet& sample, const SurfaceReport* surface,
                                const PointSet* original, Monitor& monitor) {
  if (original != nullptr && original->points.size() != sample.points.size()) {
    throw InputError("there are " + std::to_string(sample.points.size()) + " samples, but " +
                         std::to_string(original->points.size()) + " as they came",
                     "connect the points that these were before they were denoised");
  }
  if (balls.size() == 0)
    throw InputError("there are no balls that samples could belong to", "keep at least one ball");
  std::vector<std::int32_t> vertex, all(balls.size()), some;
  if (surface != nullptr) vertex = first_vertices(*surface, balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    all[i] = static_cast<std::int32_t>(i);
    if (surface != nullptr && vertex[i] >= 0) some.push_back(all[i]);
  }
  if (surface != nullptr && some.empty())
    throw InputError("the surface has no vertices that samples could belong to", "look at its report");
  SampleAssignment result;
  result.points = original != nullptr ? original->points : sample.points;
  PartMonitor of_balls(monitor, 0, 0.5), of_vertices(monitor, 0.5, 1);
  std::vector<std::int32_t> nearest = nearest_of(balls, std::move(all), sample.points, of_balls);
  if (surface != nullptr) {
    std::vector<std::int32_t> vertices = nearest;
    if (some.size() < balls.size()) vertices = nearest_of(balls, std::move(some), sample.points, of_vertices);
    for (std::int32_t& v : vertices) v = vertex[at(v)];
    result.vertices = std::move(vertices);
  }
  result.balls = std::move(nearest);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
