#include "planar/polygon_meshes.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Kernel2 = CGAL::Exact_predicates_inexact_constructions_kernel;
struct Side {
  bool known = false, inside = false;
};
using Faces =
    CGAL::Constrained_triangulation_face_base_2<Kernel2,
                                                CGAL::Triangulation_face_base_with_info_2<Side, Kernel2>>;
using Tiling = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel2,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel2>,
                                         Faces>,
    CGAL::No_constraint_intersection_tag>;

[[noreturn]] void refuse_crossing() {
  throw InputError("rings of the polygon cross or touch", "separate them; ReadPolygon says where they meet");
}

/// A face on the other side of an edge of the polygon is inside where this one is not.
void tell_inside(Tiling& tiling) {
  std::vector<Tiling::Face_handle> waiting{tiling.infinite_face()};
  waiting.back()->info() = {true, false};
  while (!waiting.empty()) {
    const Tiling::Face_handle face = waiting.back();
    waiting.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Tiling::Face_handle next = face->neighbor(k);
      if (next->info().known) continue;
      next->info() = {true, face->info().inside != face->is_constrained(k)};
      waiting.push_back(next);
    }
  }
}

}  // namespace

PolygonMeshes polygon_meshes(const Polygon2& polygon, Monitor& monitor) {
  if (const std::string broken = broken_invariant(polygon); !broken.empty())
    throw InputError("the polygon is damaged: " + broken, "repair it, or read it again");
  if (polygon.components() == 0) throw InputError("the polygon has no components", "give one with an inside");
  Lookout look(monitor);
  Tiling tiling;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<Tiling::Vertex_handle> handles;
  for (const Vec2 p : polygon.vertices) {
    look(64);
    handles.push_back(tiling.insert({p.x, p.y}));
    if (tiling.number_of_vertices() != handles.size()) refuse_crossing();
    handles.back()->info() = static_cast<std::int32_t>(handles.size() - 1);
  }
  try {
    for (std::size_t ring = 0; ring < polygon.rings(); ++ring) {
      const auto first = static_cast<std::size_t>(polygon.ring_offsets[ring]),
                 last = static_cast<std::size_t>(polygon.ring_offsets[ring + 1]);
      for (std::size_t i = first; i < last; ++i) {
        look(64);
        const std::size_t j = i + 1 < last ? i + 1 : first;
        tiling.insert_constraint(handles[i], handles[j]);
        edges.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      }
    }
  } catch (const Tiling::Intersection_of_constraints_exception&) {
    refuse_crossing();
  }
  tell_inside(tiling);

  std::vector<Triangle> tiles;
  for (const auto& face : tiling.finite_face_handles()) {
    if (!face->info().inside) continue;
    tiles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  const auto n = static_cast<std::int32_t>(polygon.vertices.size());
  const double height = 2 * bounding_box(polygon).longest_edge();
  std::vector<Vec3> in_plane, both;
  for (const Vec2 p : polygon.vertices) in_plane.push_back({p.x, p.y, 0});
  for (const double z : {-height, height}) {
    for (const Vec3 p : in_plane) both.push_back({p.x, p.y, z});
  }
  std::vector<Triangle> sides;
  for (const Triangle& t : tiles) {
    sides.push_back({t[0], t[2], t[1]});
    sides.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  for (const auto [i, j] : edges) {  // the inside is on the left
    sides.push_back({i, j, j + n});
    sides.push_back({i, j + n, i + n});
  }
  monitor.step(1);
  return {{std::move(in_plane), std::move(tiles)}, {std::move(both), std::move(sides)}};
}

}  // namespace ballflow::geometry
