#include "minkowski/disc_tree.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Min_sphere_of_spheres_d_traits_2<Kernel, double, CGAL::Tag_true>;

Ball around(const std::vector<Ball>& discs) {
  std::vector<Traits::Sphere> circles;
  for (const Ball& disc : discs)
    circles.emplace_back(Kernel::Point_2(disc.center.x, disc.center.y), disc.radius);
  CGAL::Min_sphere_of_spheres_d<Traits> smallest(circles.begin(), circles.end());
  auto at = smallest.center_cartesian_begin();
  Ball bound;
  bound.center.x = *at++;
  bound.center.y = *at;
  if (!is_finite(bound.center)) bound.center = discs[0].center;
  // Whatever was rounded there: it contains them all.
  for (const Ball& disc : discs)
    bound.radius = std::max(bound.radius, distance(bound.center, disc.center) + disc.radius);
  const Vec3 c = bound.center;
  bound.radius += 0x1p-48 * (bound.radius + std::abs(c.x) + std::abs(c.y));
  return bound;
}

void add(std::vector<DiscTreeNode>& nodes, std::vector<Ball> discs, std::size_t leaf_size, int depth) {
  const std::size_t here = nodes.size();
  nodes.emplace_back();
  const auto largest = std::max_element(discs.begin(), discs.end(),
                                        [](const Ball& a, const Ball& b) { return a.radius < b.radius; });
  nodes[here].bound = around(discs);
  nodes[here].largest = *largest;
  nodes[here].count = static_cast<std::int64_t>(discs.size());
  Box box;
  for (const Ball& disc : discs) box.add(disc.center);
  if (discs.size() <= leaf_size || box.longest_edge() == 0 || depth == 60) {
    discs.erase(largest);
    std::stable_sort(discs.begin(), discs.end(),
                     [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    nodes[here].discs = std::move(discs);
  } else {
    nodes[here].children = static_cast<std::int32_t>(nodes.size());
    const double half = box.longest_edge() / 2;
    std::array<std::vector<Ball>, 4> parts;
    for (const Ball& disc : discs) {
      const bool right = disc.center.x - box.lower.x > half, up = disc.center.y - box.lower.y > half;
      parts[static_cast<std::size_t>(2 * right + up)].push_back(disc);
    }
    for (std::vector<Ball>& part : parts) {
      if (!part.empty()) add(nodes, std::move(part), leaf_size, depth + 1);
    }
  }
  nodes[here].next = static_cast<std::int32_t>(nodes.size());
}

}  // namespace

std::vector<DiscTreeNode> disc_tree(const Balls& discs, std::size_t leaf_size) {
  std::vector<Ball> all;
  for (std::size_t i = 0; i < discs.size(); ++i) all.push_back({discs.centers[i], discs.radii[i]});
  std::vector<DiscTreeNode> nodes;
  if (!all.empty()) add(nodes, std::move(all), leaf_size, 0);
  return nodes;
}

}  // namespace ballflow::geometry
