#include "cover/cover_points.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::vector<std::array<std::int32_t, 2>> edges_of(const TriangleMesh& surface) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Triangle& triangle : surface.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t u = triangle[k], v = triangle[(k + 1) % 3];
      edges.push_back({std::min(u, v), std::max(u, v)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Those of `added` that are no sample and not among the others, in their order.
std::vector<Vec3> new_points(std::span<const Vec3> samples, const std::vector<Vec3>& added) {
  std::vector<std::pair<Vec3, std::size_t>> all;
  for (const Vec3& p : samples) all.emplace_back(p, all.size());
  for (const Vec3& p : added) all.emplace_back(p, all.size());
  std::sort(all.begin(), all.end());
  std::vector<bool> seen_before(all.size(), false);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].first == all[i - 1].first) seen_before[all[i].second] = true;
  }
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < added.size(); ++i) {
    if (!seen_before[samples.size() + i]) result.push_back(added[i]);
  }
  return result;
}

}  // namespace

double thickness(const TriangleMesh& surface, const Balls& balls) {
  std::vector<double> radius(surface.vertices.size(), 0);  // of the largest ball through each sample
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (const std::int32_t s : balls.samples_of(i)) {
      if (at(s) < radius.size()) radius[at(s)] = std::max(radius[at(s)], balls.radii[i]);
    }
  }
  std::vector<double> sum(radius.size(), 0);  // of the lengths of edges
  std::vector<int> edges(radius.size(), 0);
  for (const auto& [u, v] : edges_of(surface)) {
    const double length = distance(surface.vertices[at(u)], surface.vertices[at(v)]);
    for (const std::int32_t s : {u, v}) {
      sum[at(s)] += length;
      ++edges[at(s)];
    }
  }
  std::vector<double> ratios;
  for (std::size_t s = 0; s < radius.size(); ++s) {
    if (sum[s] > 0) ratios.push_back(radius[s] * edges[s] / sum[s]);
  }
  if (ratios.empty()) return 0;
  const auto median = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), median, ratios.end());
  return *median;
}

Demand demand_for(double thickness) {
  return thickness >= 1.5 ? Demand::samples : thickness >= 1 ? Demand::facets : Demand::edges;
}

CoverPoints cover_points(const PointSet& samples, const TriangleMesh& surface, Demand demand,
                         const Balls& balls) {
  if (const std::string broken = broken_invariant(surface); !broken.empty()) {
    throw InputError("the surface is damaged: " + broken, "connect the surface that Refine made");
  }
  if (demand == Demand::automatic) {
    const bool known = !surface.triangles.empty() && !balls.defining_samples.empty();
    demand = known ? demand_for(thickness(surface, balls)) : Demand::samples;
  }
  if (surface.triangles.empty() || demand == Demand::samples) return {Demand::samples, samples, {}};
  if (!std::equal(surface.vertices.begin(), surface.vertices.end(), samples.points.begin(),
                  samples.points.end())) {
    throw InputError("the vertices of the surface are not the points",
                     "connect points and surface of one Refine node");
  }
  if (demand == Demand::patches) return {demand, samples, {samples.points, surface.triangles}};
  const std::span<const Vec3> p = samples.points.span();
  std::vector<Vec3> centers;
  for (const auto& [a, b, c] : surface.triangles) {
    std::array<Vec3, 3> corners{p[at(a)], p[at(b)], p[at(c)]};
    std::sort(corners.begin(), corners.end());  // rounding must not depend on the first corner
    centers.push_back((1.0 / 3) * (corners[0] + corners[1] + corners[2]));
  }
  if (demand == Demand::edges) {
    for (const auto& [u, v] : edges_of(surface)) centers.push_back(0.5 * (p[at(u)] + p[at(v)]));
  }
  std::vector<Vec3> points(p.begin(), p.end());
  const std::vector<Vec3> added = new_points(p, centers);
  points.insert(points.end(), added.begin(), added.end());
  return {demand, {std::move(points), {}}, {}};
}

}  // namespace ballflow::geometry
