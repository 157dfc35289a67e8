#include "measure/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "measure/blocks.hpp"
#include "measure/boundary_samples.hpp"
#include "measure/one_sided.hpp"
#include "measure/surface_samples.hpp"
#include "measure/union_measure.hpp"
#include "power/alpha_shape.hpp"
#include "search/box_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 128;  // balls in one task

double protrusion(const Balls& balls, const ComparedSurface& surface, Monitor& monitor) {
  double largest = 0;
  for (const double part :
       by_blocks<double>(balls.size(), block, monitor, [&](auto first, auto last, double&most) {
         for (std::size_t i = first; i < last; ++i)
           most = std::max(most, balls.radii[i] - surface.distance_to(balls.centers[i]));
       }))
    largest = std::max(largest, part);
  return largest;
}

double union_volume(const Balls& balls, Monitor& monitor) {
  PartMonitor triangulating(monitor, 0, 0.8), measuring(monitor, 0.8, 1);
  return union_measure(alpha_shape(balls, {}, triangulating), measuring).volume;
}

void require_comparable(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                        const CompareOptions& options) {
  if (!(options.spacing > 0 && std::isfinite(options.spacing))) {
    throw InputError("spacing is " + std::to_string(options.spacing), "it is a finite number above 0");
  }
  for (const std::string& broken :
       {broken_invariant(balls), broken_invariant(mesh), broken_invariant(points)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  if (balls.size() == 0) throw InputError("there are no balls to compare", "connect the balls of a model");
  if (mesh.triangles.empty() && points.points.empty()) {
    throw InputError("there is no surface: neither triangles nor points", "connect a mesh or its samples");
  }
}

}  // namespace

Comparison compare(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                   const CompareOptions& options, Monitor& monitor) {
  require_comparable(balls, points, mesh, options);
  monitor.step(0);
  ComparedSurface surface(points, mesh);
  const BallUnion all(balls);
  const double longest = std::max(surface.box().longest_edge(), bounding_box(balls).longest_edge());
  const double edge = surface.box().longest_edge() > 0 ? surface.box().longest_edge() : longest;
  Comparison result;
  result.spacing = edge > 0 ? options.spacing / 100 * edge : 1;
  const double tolerance = 0x1p-30 * longest;  // of positions on spheres, far above rounding

  Budget surface_budget(options.most_samples, "samples of the surface");
  surface.sample(result.spacing, surface_budget);
  Budget union_budget(options.most_samples, "samples of the boundary of the union");
  PartMonitor sampling(monitor, 0, 0.3);
  const BoundarySamples boundary = boundary_samples(all, result.spacing, tolerance, union_budget, sampling);
  std::vector<Vec3> on_boundary;
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    if (boundary.on_boundary[k] != 0) on_boundary.push_back(boundary.positions[k]);
  }
  if (on_boundary.empty()) {
    throw InputError(
        "no sample lies on the boundary of the union: every ball shows less than the spacing of it",
        "set a smaller spacing");
  }

  PartMonitor there(monitor, 0.3, 0.5), back(monitor, 0.5, 0.7), beyond(monitor, 0.7, 0.75);
  const Tally of_surface =
      from_surface(surface, all, BoxTree(on_boundary), on_boundary, result.spacing, tolerance, there);
  const bool has_area =
      std::any_of(balls.radii.begin(), balls.radii.end(), [](double radius) { return radius > 0; });
  const Tally of_union = from_union(boundary, surface, has_area, back);
  result.surface_samples = static_cast<std::int64_t>(surface.samples());
  result.union_samples = static_cast<std::int64_t>(boundary.size());
  put_distances(result, of_surface, of_union, surface.is_cloud(), tolerance);
  result.protrusion = protrusion(balls, surface, beyond);

  PartMonitor measuring(monitor, 0.75, 1);
  result.union_volume = union_volume(balls, measuring);
  result.compared_with = static_cast<std::uint8_t>(ComparedWith::cloud);
  if (!surface.is_cloud()) {
    // The same orientation, and the same notion of a closed mesh, as where poles are labelled.
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
