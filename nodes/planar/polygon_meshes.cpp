#include "planar/polygon_meshes.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "base/space_order.hpp"

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

/// An order in which insertion takes O(n log n), whatever the points (Amenta, Choi and Rote 2003): a random
/// few first, then twice as many, and so on; each time along a curve, so that the next one is close.
std::vector<std::size_t> insertion_order(const Polygon2& polygon) {
  struct Place {
    int round;
    std::uint64_t code;
    std::size_t index;
    auto operator<=>(const Place&) const = default;
  };
  const SpaceOrder along(bounding_box(polygon));
  Random random(1);
  std::vector<Place> places;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i)
    places.push_back(
        {-std::countr_zero(random.bits() | std::uint64_t{1} << 40), along(in_space(polygon.vertices[i])), i});
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> order;
  for (const Place& place : places) order.push_back(place.index);
  return order;
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
  std::vector<Tiling::Vertex_handle> handles(polygon.vertices.size());
  Tiling::Face_handle near;
  for (const std::size_t i : insertion_order(polygon)) {
    look(64);
    const Vec2 p = polygon.vertices[i];
    const std::size_t before = tiling.number_of_vertices();
    handles[i] = tiling.insert({p.x, p.y}, near);
    if (tiling.number_of_vertices() == before) refuse_crossing();
    handles[i]->info() = static_cast<std::int32_t>(i);
    near = handles[i]->face();
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
