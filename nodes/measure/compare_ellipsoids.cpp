#include "measure/compare_ellipsoids.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "measure/blocks.hpp"
#include "measure/ellipsoid_union.hpp"
#include "measure/one_sided.hpp"
#include "measure/surface_samples.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 8;  // ellipsoids in one task
constexpr int lines = 512;        // along each edge of the grid that the volume is counted on

/// The least t >= `known` for which the ellipsoid with half-axes max(a - t, floor) does not meet the
/// triangle, or a little more. The floor keeps it from being flat, and only makes it larger.
double shrinkage(const Ellipsoid& e, const std::array<Vec3, 3>& triangle, double known) {
  const double floor = 0x1p-20 * e.longest();
  const auto meets = [&](double t) {
    const Vec3 a = e.radii();
    const Vec3 rest{std::max(a.x - t, floor), std::max(a.y - t, floor), std::max(a.z - t, floor)};
    const auto relative = [&](Vec3 p) {
      const Vec3 u = e.relative(p);
      return Vec3{u.x * a.x / rest.x, u.y * a.y / rest.y, u.z * a.z / rest.z};
    };
    return triangle_distance({}, relative(triangle[0]), relative(triangle[1]), relative(triangle[2])) <
           1 - 0x1p-40;
  };
  if (!meets(known)) return known;
  double low = known, high = e.longest();
  while (high - low > std::max(0.01 * low, 0x1p-20 * e.longest())) {
    const double middle = low > 0 && high > 4 * low ? 2 * low : low + (high - low) / 2;
    (meets(middle) ? low : high) = middle;
  }
  return high;
}

double protrusion(const EllipsoidUnion& all, const ComparedSurface& surface, Monitor& monitor) {
  double largest = 0;
  const auto parts = by_blocks<double>(all.size(), block, monitor, [&](auto first, auto last, double& most) {
    for (std::size_t i = first; i < last; ++i) {
      double t = 0;
      surface.near(all[i].center(), all[i].longest(),
                   [&](const std::array<Vec3, 3>& triangle) { t = shrinkage(all[i], triangle, t); });
      most = std::max(most, t);
    }
  });
  for (const double part : parts) largest = std::max(largest, part);
  return largest;
}

void require_comparable(const Ellipsoids& ellipsoids, const PointSet& points, const TriangleMesh& mesh,
                        const CompareOptions& options) {
  if (!(options.spacing > 0 && std::isfinite(options.spacing))) {
    throw InputError("spacing is " + std::to_string(options.spacing), "it is a finite number above 0");
  }
  for (const std::string& broken :
       {broken_invariant(ellipsoids), broken_invariant(mesh), broken_invariant(points)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  if (ellipsoids.size() == 0) {
    throw InputError("there are no ellipsoids to compare", "connect the ellipsoids of a model");
  }
  if (mesh.triangles.empty() && points.points.empty()) {
    throw InputError("there is no surface: neither triangles nor points", "connect a mesh or its samples");
  }
}

}  // namespace

Comparison compare_ellipsoids(const Ellipsoids& ellipsoids, const PointSet& points, const TriangleMesh& mesh,
                              const CompareOptions& options, Monitor& monitor) {
  require_comparable(ellipsoids, points, mesh, options);
  monitor.step(0);
  ComparedSurface surface(points, mesh);
  const EllipsoidUnion all(ellipsoids);
  const double longest = std::max(surface.box().longest_edge(), bounding_box(ellipsoids).longest_edge());
  const double edge = surface.box().longest_edge() > 0 ? surface.box().longest_edge() : longest;
  Comparison result;
  result.spacing = options.spacing / 100 * edge;
  const double tolerance = 0x1p-30 * longest;  // of positions, far above rounding

  Budget surface_budget(options.most_samples, "samples of the surface");
  surface.sample(result.spacing, surface_budget);
  Budget union_budget(options.most_samples, "samples of the boundary of the union");
  PartMonitor sampling(monitor, 0, 0.3), there(monitor, 0.3, 0.5), back(monitor, 0.5, 0.7),
      beyond(monitor, 0.7, 0.8), measuring(monitor, 0.8, 0.9);
  const BoundarySamples boundary = boundary_samples(all, result.spacing, tolerance, union_budget, sampling);
  std::vector<Vec3> on_boundary;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    if (boundary.on_boundary[k] != 0) on_boundary.push_back(boundary.positions[k]);
  }
  if (on_boundary.empty()) {
    throw InputError(
        "no sample lies on the boundary of the union: every ellipsoid shows less than the spacing of it",
        "set a smaller spacing");
  }
  const Tally of_surface =
      from_surface(surface, all, BoxTree(on_boundary), on_boundary, result.spacing, tolerance, there);
  const Tally of_union = from_union(boundary, surface, true, back);
  result.surface_samples = static_cast<std::int64_t>(surface.samples());
  result.union_samples = static_cast<std::int64_t>(boundary.size());
  put_distances(result, of_surface, of_union, surface.is_cloud(), tolerance);
  result.protrusion = protrusion(all, surface, beyond);
  result.union_volume = union_volume(all, ellipsoids, lines, measuring);
  result.compared_with = static_cast<std::uint8_t>(ComparedWith::cloud);
  if (!surface.is_cloud()) {
    const WindingNumber winding(mesh, monitor);
    const bool closed = winding.chain().closed();
    result.compared_with =
        static_cast<std::uint8_t>(closed ? ComparedWith::closed_mesh : ComparedWith::open_mesh);
    result.surface_encloses = closed ? 1 : 0;
    result.surface_volume = winding.enclosed_volume();
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
