#include "planar/polygon_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "planar/read_polygon.hpp"
#include "planar_cases.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

double flat_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += 0.5 * length(cross(at(1) - at(0), at(2) - at(0)));
  }
  return sum;
}

TEST(polygon_meshes, tile_the_polygon_and_bound_a_prism_whose_cut_it_is) {
  for (const char* name : {"square", "sqroot", "euro?R=0.3", "gear", "frames", "comb", "star"}) {
    SCOPED_TRACE(name);
    const Polygon2 polygon = read_polygon({std::string("polygon:") + name}).polygon;
    const PolygonMeshes meshes = polygon_meshes(polygon);
    EXPECT_EQ(broken_invariant(meshes.flat), "");
    EXPECT_EQ(broken_invariant(meshes.prism), "");
    EXPECT_EQ(meshes.flat.vertices.size(), polygon.vertices.size());
    EXPECT_NEAR(flat_area(meshes.flat), area(polygon), 1e-12 * area(polygon));
    const MeshTopology topology = mesh_topology(meshes.prism);
    EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
    EXPECT_EQ(static_cast<std::size_t>(topology.components), polygon.components());
    const double edge = bounding_box(polygon).longest_edge();
    const WindingNumber winding(meshes.prism, no_monitor());
    EXPECT_EQ(winding.turned(), 0);
    EXPECT_NEAR(winding.enclosed_volume(), 4 * edge * area(polygon), 1e-9 * edge * area(polygon));
    // Distances and sides of points in the plane are those of the polygon.
    const SurfaceTree tree(meshes.prism);
    const auto rings = test::rings_of(polygon);
    const Box box = bounding_box(polygon);
    for (int i = -2; i < 23; ++i) {
      for (int j = -2; j < 23; ++j) {
        const Vec2 p{box.lower.x + (i + 0.37) / 20 * edge, box.lower.y + (j + 0.41) / 20 * edge};
        EXPECT_NEAR(tree.nearest({p.x, p.y, 0}, INFINITY)->distance, test::distance_to_boundary(polygon, p),
                    1e-12 * edge);
        EXPECT_EQ(winding.around({p.x, p.y, 0}).number != 0, test::inside(rings, p));
      }
    }
  }
}

TEST(polygon_meshes, are_refused_where_there_is_no_inside) {
  EXPECT_THROW(polygon_meshes({}), InputError);
  // Two squares that share a corner, and two that cross, as no reader lets them pass.
  const auto squares = [](double by) {
    Polygon2 two;
    two.vertices = std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<Vec2> all(two.vertices.begin(), two.vertices.end());
    for (std::size_t k = 0; k < 4; ++k) all.push_back(all[k] + Vec2{by, by});
    two.vertices = all;
    two.ring_offsets = std::vector<std::int64_t>{0, 4, 8};
    two.component_offsets = std::vector<std::int64_t>{0, 1, 2};
    return two;
  };
  EXPECT_THROW(polygon_meshes(squares(1)), InputError);
  EXPECT_THROW(polygon_meshes(squares(0.5)), InputError);
  EXPECT_EQ(polygon_meshes(squares(2)).flat.triangles.size(), 4u);
}

}  // namespace
}  // namespace ballflow::geometry
