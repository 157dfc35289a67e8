#include "mesh/simplified_mesh.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace Collapse = CGAL::Surface_mesh_simplification;

class Watch : public Collapse::Edge_collapse_visitor_base<Surface> {
 public:
  explicit Watch(Monitor& monitor, std::size_t wanted)
      : monitor_(&monitor), look_(monitor), wanted_(wanted) {}
  void OnCollected(const Profile&, const boost::optional<double>&) { look_(1024); }
  void OnSelected(const Profile&, const boost::optional<double>&, size_type initial, size_type current) {
    if (!look_.due(1024)) return;
    const std::size_t all = initial > wanted_ ? initial - wanted_ : 1;
    monitor_->step(static_cast<double>(initial - current) / static_cast<double>(all));
  }

 private:
  Monitor* monitor_;
  Lookout look_;
  std::size_t wanted_;
};

}  // namespace

TriangleMesh simplified_mesh(const TriangleMesh& mesh, std::size_t faces, Monitor& monitor) {
  if (mesh.triangles.size() <= faces) return mesh;
  Surface surface;
  surface.reserve(static_cast<Surface::size_type>(mesh.vertices.size()),
                  static_cast<Surface::size_type>(3 * mesh.triangles.size() / 2),
                  static_cast<Surface::size_type>(mesh.triangles.size()));
  for (const Vec3& v : mesh.vertices) surface.add_vertex({v.x, v.y, v.z});
  const auto vertex = [](std::int32_t v) {
    return Surface::Vertex_index(static_cast<Surface::size_type>(v));
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (surface.add_face(vertex(a), vertex(b), vertex(c)) == Surface::null_face())
      throw std::logic_error("a mesh that is no manifold cannot be simplified");
  }
  const std::size_t edges = faces + faces / 2;
  Collapse::Count_stop_predicate<Surface> stop(edges + 1);  // ends when there are fewer
  Collapse::edge_collapse(surface, stop, CGAL::parameters::visitor(Watch(monitor, edges)));
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> place(surface.number_of_vertices() + surface.number_of_removed_vertices(), -1);
  for (const Surface::Vertex_index v : surface.vertices()) {
    place[v] = static_cast<std::int32_t>(vertices.size());
    const Kernel::Point_3& p = surface.point(v);
    vertices.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<Triangle> triangles;
  for (const Surface::Face_index f : surface.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = place[v];
    triangles.push_back(t);
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace ballflow::geometry
