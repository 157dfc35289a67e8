#include "refine/mirror_images.hpp"

#include <algorithm>

namespace ballflow::geometry {

std::vector<SurfacePoint> mirror_images(const RefinedTriangulation& triangulation,
                                        RefinedTriangulation::Cell cell, double least) {
  const SurfaceTree& surface = triangulation.surface();
  const RefinedCell& info = cell->info();
  const double skin = 1e-7 * triangulation.size();
  std::vector<SurfacePoint> images;
  for (int k = 0; k < 4; ++k) {
    const RefinedSample& sample = cell->vertex(k)->info();
    if (sample.number < 0) continue;
    const Vec3 p = position(cell->vertex(k));
    const Vec3 to_center = info.center - p;
    const double length_to_center = length(to_center);
    if (!(length_to_center > skin)) continue;
    const double start = skin / length_to_center;
    if (!surface.first_hit(p, to_center, start, 1)) continue;  // the sample sees the centre
    Vec3 normal = sample.triangle < 0 ? Vec3{} : surface.normal(sample.triangle);
    if (dot(normal, to_center) < 0) normal = -normal;
    auto image = surface.first_hit(p, normal, skin, length_to_center);
    if (!image || normal == Vec3{}) image = surface.first_hit(p, to_center, start, 1);
    // The ball is empty: the image is at least so far from all samples.
    const double room = info.radius - distance(image->point, info.center);
    const bool apart = std::all_of(images.begin(), images.end(), [&](const SurfacePoint& other) {
      return distance(other.point, image->point) >= least;
    });
    if (room >= least && apart) images.push_back(*image);
  }
  return images;
}

}  // namespace ballflow::geometry
