#include "ellipsoids/scale_back.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "search/surface_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 256;

double growth_of(const Scaling& scaling, const ScaleBackOptions& options, const Bisection* search) {
  const double percent = search != nullptr ? search->value : options.epsilon;
  for (const double length : {percent, options.max_error}) {
    if (!(length >= 0 && std::isfinite(length))) {
      throw InputError("the growth is " + std::to_string(length), "it is a finite number, at least 0");
    }
  }
  return options.max_error > 0 && search == nullptr ? options.max_error
                                                    : percent / 100 * scaling.longest_edge;
}

}  // namespace

ScaledBack scale_back(const Balls& balls, const Scaling& scaling, const TriangleMesh& mesh,
                      const ScaleBackOptions& options, const Bisection* search, Monitor& monitor) {
  for (const std::string& broken :
       {broken_invariant(balls), broken_invariant(scaling), broken_invariant(mesh)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  ScaledBack result;
  result.growth = growth_of(scaling, options, search);
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  if (!mesh.triangles.empty()) {
    PartMonitor building(monitor, 0, 0.2);
    const SurfaceTree surface(mesh, building);
    for_each_block(radii.size(), block, monitor, 0.2, 0.9,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i)
                       if (const auto near = surface.nearest(balls.centers[i], radii[i]))
                         radii[i] = near->distance;
                   });
  }
  const ScalingMap map(scaling);
  const Vec3 f = scaling.factors;
  const double e = result.growth;
  std::vector<Vec3> centers, half_axes;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] < balls.radii[i]) {
      ++result.shortened;
      result.shortened_by = std::max(result.shortened_by, balls.radii[i] - radii[i]);
    }
    const double r = radii[i];
    const Vec3 grown = options.growth == EllipsoidGrowth::axes
                           ? Vec3{r / f.x + e, r / f.y + e, r / f.z + e}
                           : Vec3{(r + e) / f.x, (r + e) / f.y, (r + e) / f.z};
    const Vec3 center = map.back(balls.centers[i]);
    if (!is_finite(grown) || !is_finite(center)) {
      throw InputError("ball " + std::to_string(i) + " leaves the range of numbers where it is scaled back",
                       "scale the model to a size near 1");
    }
    if (!(grown.x > 0 && grown.y > 0 && grown.z > 0)) continue;
    centers.push_back(center);
    half_axes.push_back(grown);
  }
  std::vector<Quaternion> rotations(centers.size(), scaling.rotation);
  result.ellipsoids = {std::move(centers), std::move(half_axes), std::move(rotations)};
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
