#include "minkowski/ball_tree.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<Kernel, double, CGAL::Tag_true>;

Ball around(const std::vector<Ball>& balls) {
  std::vector<Traits::Sphere> circles;
  for (const Ball& ball : balls)
    circles.emplace_back(Kernel::Point_3(ball.center.x, ball.center.y, ball.center.z), ball.radius);
  CGAL::Min_sphere_of_spheres_d<Traits> smallest(circles.begin(), circles.end());
  auto at = smallest.center_cartesian_begin();
  Ball bound;
  bound.center.x = *at++;
  bound.center.y = *at++;
  bound.center.z = *at;
  if (!is_finite(bound.center)) bound.center = balls[0].center;
  // Whatever was rounded there: it contains them all.
  for (const Ball& ball : balls)
    bound.radius = std::max(bound.radius, distance(bound.center, ball.center) + ball.radius);
  const Vec3 c = bound.center;
  bound.radius += 0x1p-48 * (bound.radius + std::abs(c.x) + std::abs(c.y) + std::abs(c.z));
  return bound;
}

void add(std::vector<BallTreeNode>& nodes, std::vector<Ball> balls, std::size_t leaf_size, int depth) {
  const std::size_t here = nodes.size();
  nodes.emplace_back();
  const auto largest = std::max_element(balls.begin(), balls.end(),
                                        [](const Ball& a, const Ball& b) { return a.radius < b.radius; });
  nodes[here].bound = around(balls);
  nodes[here].largest = *largest;
  nodes[here].count = static_cast<std::int64_t>(balls.size());
  Box box;
  for (const Ball& ball : balls) box.add(ball.center);
  if (balls.size() <= leaf_size || box.longest_edge() == 0 || depth == 60) {
    std::stable_sort(balls.begin(), balls.end(),
                     [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    nodes[here].balls = std::move(balls);
  } else {
    nodes[here].children = static_cast<std::int32_t>(nodes.size());
    const double half = box.longest_edge() / 2;
    std::array<std::vector<Ball>, 8> parts;
    for (const Ball& ball : balls) {
      const Vec3 from = ball.center - box.lower;
      parts[static_cast<std::size_t>(4 * (from.x > half) + 2 * (from.y > half) + (from.z > half))].push_back(
          ball);
    }
    for (std::vector<Ball>& part : parts) {
      if (!part.empty()) add(nodes, std::move(part), leaf_size, depth + 1);
    }
  }
  nodes[here].next = static_cast<std::int32_t>(nodes.size());
}

}  // namespace

std::vector<BallTreeNode> ball_tree(const Balls& balls, std::size_t leaf_size) {
  std::vector<Ball> all;
  for (std::size_t i = 0; i < balls.size(); ++i) all.push_back({balls.centers[i], balls.radii[i]});
  std::vector<BallTreeNode> nodes;
  if (!all.empty()) add(nodes, std::move(all), leaf_size, 0);
  return nodes;
}

}  // namespace ballflow::geometry
