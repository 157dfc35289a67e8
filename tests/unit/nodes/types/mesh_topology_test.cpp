#include <gtest/gtest.h>

#include <limits>

#include "types/cover_check.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {
namespace {

/// Topology does not look at coordinates.
TriangleMesh mesh_of(std::size_t vertices, std::vector<Triangle> triangles) {
  return {std::vector<Vec3>(vertices), std::move(triangles)};
}

const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

/// A grid of a x b quads on a torus (wrap) or a disk, split in triangles.
TriangleMesh grid(int a, int b, bool wrap) {
  const int columns = wrap ? a : a + 1, rows = wrap ? b : b + 1;
  std::vector<Triangle> triangles;
  const auto id = [&](int i, int j) { return (j % rows) * columns + i % columns; };
  for (int j = 0; j < b; ++j) {
    for (int i = 0; i < a; ++i) {
      triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh_of(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), triangles);
}

TEST(mesh_topology, of_no_triangles_is_neither_closed_nor_manifold) {
  const MeshTopology t = mesh_topology(mesh_of(3, {}));
  EXPECT_FALSE(t.closed);
  EXPECT_FALSE(t.manifold);
  EXPECT_EQ(t.genus, -1);
  EXPECT_EQ(t.components, 0);
  EXPECT_EQ(t.vertices, 3);
}

TEST(mesh_topology, a_tetrahedron_is_a_sphere) {
  const MeshTopology t = mesh_topology(mesh_of(4, tetrahedron));
  EXPECT_TRUE(t.closed && t.manifold && t.oriented);
  EXPECT_EQ(t.genus, 0);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.boundary_loops, 0);
}

TEST(mesh_topology, an_unused_vertex_counts_as_a_vertex_and_changes_nothing_else) {
  const MeshTopology t = mesh_topology(mesh_of(9, tetrahedron));
  EXPECT_EQ(t.vertices, 9);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.genus, 0);
}

TEST(mesh_topology, a_wrapped_grid_is_a_torus) {
  const MeshTopology t = mesh_topology(grid(7, 5, true));
  EXPECT_TRUE(t.closed && t.manifold && t.oriented);
  EXPECT_EQ(t.genus, 1);
}

TEST(mesh_topology, a_flat_grid_is_a_disk_with_one_loop) {
  const MeshTopology t = mesh_topology(grid(7, 5, false));
  EXPECT_FALSE(t.closed);
  EXPECT_TRUE(t.manifold && t.oriented);
  EXPECT_EQ(t.genus, 0);
  EXPECT_EQ(t.boundary_loops, 1);
  EXPECT_EQ(t.boundary_edges, 24);
}

TEST(mesh_topology, a_torus_with_two_holes_keeps_its_genus) {
  TriangleMesh mesh = grid(9, 9, true);
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  triangles.erase(triangles.begin() + 100);
  triangles.erase(triangles.begin());
  mesh.triangles = triangles;
  const MeshTopology t = mesh_topology(mesh);
  EXPECT_FALSE(t.closed);
  EXPECT_TRUE(t.manifold);
  EXPECT_EQ(t.genus, 1);
  EXPECT_EQ(t.boundary_loops, 2);
  EXPECT_EQ(t.boundary_edges, 6);
}

TEST(mesh_topology, genus_adds_up_over_components) {
  const TriangleMesh one = grid(5, 5, true);
  std::vector<Triangle> triangles(one.triangles.begin(), one.triangles.end());
  for (Triangle t : one.triangles) triangles.push_back({t[0] + 25, t[1] + 25, t[2] + 25});
  const MeshTopology t = mesh_topology(mesh_of(50, triangles));
  EXPECT_EQ(t.components, 2);
  EXPECT_EQ(t.genus, 2);
}

TEST(mesh_topology, one_turned_triangle_spoils_the_orientation_only) {
  std::vector<Triangle> triangles = tetrahedron;
  std::swap(triangles[2][0], triangles[2][1]);
  const MeshTopology t = mesh_topology(mesh_of(4, triangles));
  EXPECT_TRUE(t.closed && t.manifold);
  EXPECT_FALSE(t.oriented);
  EXPECT_EQ(t.genus, -1);
}

TEST(mesh_topology, a_moebius_strip_is_manifold_and_not_oriented) {
  const MeshTopology t = mesh_topology(mesh_of(5, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}}));
  EXPECT_TRUE(t.manifold);
  EXPECT_FALSE(t.oriented);
  EXPECT_EQ(t.boundary_loops, 1);
  EXPECT_EQ(t.genus, -1);
}

TEST(mesh_topology, two_tetrahedra_that_touch_in_a_vertex_are_closed_and_not_manifold) {
  std::vector<Triangle> triangles = tetrahedron;
  for (Triangle t : tetrahedron) {
    for (auto& v : t) v = v == 0 ? 0 : v + 3;
    triangles.push_back(t);
  }
  const MeshTopology t = mesh_topology(mesh_of(7, triangles));
  EXPECT_TRUE(t.closed);
  EXPECT_FALSE(t.manifold);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.nonmanifold_edges, 0);
}

TEST(mesh_topology, three_triangles_on_an_edge_are_a_nonmanifold_edge) {
  const MeshTopology t = mesh_topology(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_FALSE(t.manifold);
  EXPECT_FALSE(t.oriented);
  EXPECT_EQ(t.nonmanifold_edges, 1);
  EXPECT_EQ(t.boundary_edges, 6);
}

TEST(mesh_topology, a_degenerate_triangle_is_not_part_of_a_manifold) {
  std::vector<Triangle> triangles = tetrahedron;
  triangles.push_back({1, 1, 2});
  const MeshTopology t = mesh_topology(mesh_of(4, triangles));
  EXPECT_FALSE(t.closed);
  EXPECT_FALSE(t.manifold);
  EXPECT_EQ(t.genus, -1);
}

TEST(broken_invariant, names_the_face_with_an_index_out_of_range) {
  EXPECT_EQ(broken_invariant(mesh_of(4, tetrahedron)), "");
  EXPECT_EQ(broken_invariant(mesh_of(8, {{0, 1, 2}, {1, 99, 2}})),
            "face 1: vertex index 99 is out of range (8 vertices)");
  EXPECT_NE(broken_invariant(mesh_of(8, {{0, -1, 2}})), "");
}

TEST(broken_invariant, names_the_vertex_that_is_not_finite) {
  TriangleMesh mesh = mesh_of(4, tetrahedron);
  mesh.vertices = {{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}, {}, {}};
  EXPECT_EQ(broken_invariant(mesh), "vertex 1 is not finite");
}

TEST(broken_invariant, finds_equal_points_and_bad_normals) {
  PointSet points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  EXPECT_EQ(broken_invariant(points), "");
  points.normals = {{0, 0, 1}, {0, 1, 0}};
  EXPECT_EQ(broken_invariant(points), "3 points have 2 normals");
  points.normals = {{0, 0, 1}, {0, 1.1, 0}, {1, 0, 0}};
  EXPECT_EQ(broken_invariant(points), "normal 1 is not a unit vector");
  points.normals = {{0, 0, 1}, {0, std::numeric_limits<double>::quiet_NaN(), 0}, {1, 0, 0}};
  EXPECT_EQ(broken_invariant(points), "normal 1 is not a unit vector");
  points.normals = {};
  points.points = {{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}};
  EXPECT_EQ(broken_invariant(points), "points 0 and 2 are equal");
}

TEST(broken_invariant, of_a_cover_check_wants_ascending_samples_in_range) {
  EXPECT_EQ(broken_invariant(CoverCheck{2, 5, {1, 3}}), "");
  EXPECT_NE(broken_invariant(CoverCheck{2, 5, {3, 1}}), "");
  EXPECT_NE(broken_invariant(CoverCheck{2, 5, {3, 3}}), "");
  EXPECT_NE(broken_invariant(CoverCheck{2, 5, {5}}), "");
  EXPECT_NE(broken_invariant(CoverCheck{-1, 5, {}}), "");
}

}  // namespace
}  // namespace ballflow::geometry
