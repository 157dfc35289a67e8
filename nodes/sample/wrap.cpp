#include "sample/wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SoupOracle = CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<Kernel>;

/// What CGAL's wrap asks about the triangles, several times for every cell that it carves: the only place
/// where a cancellation can be noticed (CGAL 5.5 has no callback).
class WatchedOracle : public SoupOracle {
 public:
  WatchedOracle(double alpha, Monitor& monitor) : SoupOracle(alpha, Kernel()), monitor_(&monitor) {}
  template <class Query>
  bool do_intersect(const Query& query) const {
    monitor_->step(0.1);
    return SoupOracle::do_intersect(query);
  }

 private:
  Monitor* monitor_;
};

}  // namespace

TriangleMesh wrap(const TriangleMesh& mesh, const WrapOptions& options, Monitor& monitor) {
  if (mesh.triangles.empty()) {
    throw InputError("there are no triangles to wrap",
                     "clouds of points are labelled without a surface (labels=angle)");
  }
  if (const std::string broken = broken_invariant(mesh); !broken.empty()) {
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  }
  const auto require = [](const char* name, double value) {
    if (value >= 0.01 && value <= 50) return;
    throw InputError(std::string(name) + " is " + std::to_string(value), "use from 0.01 to 50 %");
  };
  require("alpha", options.alpha);
  require("offset", options.offset);
  monitor.step(0);
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::array<std::size_t, 3>> faces;
  Box box;
  for (const Triangle& t : mesh.triangles) {
    auto& face = faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      face[k] = static_cast<std::size_t>(t[k]);
      box.add(mesh.vertices[face[k]]);
    }
  }
  const double percent = box.longest_edge() / 100;
  if (!(percent > 0)) throw InputError("all triangles are one point", "check the file");
  CGAL::Surface_mesh<Kernel::Point_3> wrapped;
  WatchedOracle oracle(options.alpha * percent, monitor);
  oracle.add_triangle_soup(points, faces, CGAL::parameters::default_values());
  CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<WatchedOracle> carve(oracle);
  carve(options.alpha * percent, options.offset * percent, wrapped);
  monitor.step(0.9);
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> number(wrapped.number_of_vertices() + wrapped.number_of_removed_vertices(), -1);
  for (const auto v : wrapped.vertices()) {
    number[v] = static_cast<std::int32_t>(vertices.size());
    const auto& p = wrapped.point(v);
    vertices.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<Triangle> triangles;
  for (const auto f : wrapped.faces()) {
    Triangle triangle{};
    std::size_t k = 0;
    for (const auto v : wrapped.vertices_around_face(wrapped.halfedge(f))) triangle[k++] = number[v];
    triangles.push_back(triangle);
  }
  monitor.step(1);
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace ballflow::geometry
