#include "cgal_reconstructions.hpp"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_reconstruction_3/Weighted_PCA_smoother.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/poisson_surface_reconstruction.h>
#include <CGAL/property_map.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace ballflow::bench {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

std::vector<Point> to_cgal(std::span<const Vec3> points) {
  std::vector<Point> result;
  for (const Vec3& p : points) result.emplace_back(p.x, p.y, p.z);
  return result;
}

template <class Facets>
TriangleMesh mesh_of(std::span<const Vec3> points, const Facets& facets) {
  std::vector<Triangle> triangles;
  for (const auto& f : facets) {
    triangles.push_back(
        {static_cast<std::int32_t>(f[0]), static_cast<std::int32_t>(f[1]), static_cast<std::int32_t>(f[2])});
  }
  return {std::vector<Vec3>(points.begin(), points.end()), std::move(triangles)};
}

}  // namespace

TriangleMesh advancing_front(std::span<const Vec3> points) {
  const std::vector<Point> cloud = to_cgal(points);
  std::vector<std::array<std::size_t, 3>> facets;
  CGAL::advancing_front_surface_reconstruction(cloud.begin(), cloud.end(), std::back_inserter(facets));
  return mesh_of(points, facets);
}

TriangleMesh scale_space(std::span<const Vec3> points) {
  using Reconstruction = CGAL::Scale_space_surface_reconstruction_3<Kernel>;
  const std::vector<Point> cloud = to_cgal(points);
  Reconstruction reconstruction(cloud.begin(), cloud.end());
  reconstruction.increase_scale(4, CGAL::Scale_space_reconstruction_3::Weighted_PCA_smoother<Kernel>());
  reconstruction.reconstruct_surface(CGAL::Scale_space_reconstruction_3::Advancing_front_mesher<Kernel>());
  std::vector<std::array<std::size_t, 3>> facets;
  for (auto f = reconstruction.facets_begin(); f != reconstruction.facets_end(); ++f) facets.push_back(*f);
  return mesh_of(points, facets);
}

TriangleMesh poisson(std::span<const Vec3> points, std::span<const Vec3> normals) {
  using Oriented = std::pair<Point, Kernel::Vector_3>;
  std::vector<Oriented> cloud;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cloud.emplace_back(Point(points[i].x, points[i].y, points[i].z),
                       Kernel::Vector_3(normals[i].x, normals[i].y, normals[i].z));
  }
  const CGAL::First_of_pair_property_map<Oriented> position;
  const CGAL::Second_of_pair_property_map<Oriented> normal;
  const double spacing =
      CGAL::compute_average_spacing<CGAL::Sequential_tag>(cloud, 6, CGAL::parameters::point_map(position));
  CGAL::Surface_mesh<Point> surface;
  if (!CGAL::poisson_surface_reconstruction_delaunay(cloud.begin(), cloud.end(), position, normal, surface,
                                                     spacing))
    return {};
  std::vector<Vec3> vertices;
  for (const auto v : surface.vertices()) {
    const Point& p = surface.point(v);
    vertices.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<std::array<std::uint32_t, 3>> facets;
  for (const auto f : surface.faces()) {
    std::array<std::uint32_t, 3> t{};
    std::size_t k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = v;
    facets.push_back(t);
  }
  return mesh_of(vertices, facets);
}

}  // namespace ballflow::bench
