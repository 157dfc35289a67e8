#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "measure/union_measure.hpp"

namespace ballflow::geometry {
namespace {

void add_box(TriangleMesh& mesh, Vec3 lower, Vec3 upper, bool inwards = false) {
  std::vector<Vec3> v(mesh.vertices.begin(), mesh.vertices.end());
  std::vector<Triangle> t(mesh.triangles.begin(), mesh.triangles.end());
  const auto first = static_cast<std::int32_t>(v.size());
  for (int k = 0; k < 8; ++k) {
    v.push_back({(k & 1) != 0 ? upper.x : lower.x, (k & 2) != 0 ? upper.y : lower.y,
                 (k & 4) != 0 ? upper.z : lower.z});
  }
  for (Triangle face : std::vector<Triangle>{{0, 2, 3},
                                             {0, 3, 1},
                                             {4, 5, 7},
                                             {4, 7, 6},
                                             {0, 1, 5},
                                             {0, 5, 4},
                                             {2, 6, 7},
                                             {2, 7, 3},
                                             {0, 4, 6},
                                             {0, 6, 2},
                                             {1, 3, 7},
                                             {1, 7, 5}}) {
    for (std::int32_t& corner : face) corner += first;
    if (inwards) std::swap(face[0], face[1]);
    t.push_back(face);
  }
  mesh = {std::move(v), std::move(t)};
}

std::optional<SolidVolume> volume_of(const TriangleMesh& mesh) {
  MassProperties of_union;
  of_union.volume = 12;
  return compare_volume(of_union, mesh, {});
}

TEST(solid_volume, of_what_is_wound_around_once_is_by_formula) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 2, 3});
  add_box(mesh, {5, 0, 0}, {6, 1, 1});
  add_box(mesh, {0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}, true);  // a cavity
  const auto found = volume_of(mesh);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->exact);
  EXPECT_NEAR(found->volume, 6 + 1 - 0.125, 1e-12);
  EXPECT_NEAR(found->error, 12 / 6.875 - 1, 1e-12);
}

TEST(solid_volume, of_shells_in_each_other_that_face_outwards_counts_once) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 2, 3});
  add_box(mesh, {0.25, 0.25, 0.25}, {0.75, 0.75, 0.75});
  const auto found = volume_of(mesh);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->exact);
  EXPECT_NEAR(found->volume, 6, 1e-12);
}

TEST(solid_volume, of_triangles_that_are_there_twice_counts_once) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 2, 3});
  std::vector<Triangle> twice(mesh.triangles.begin(), mesh.triangles.end());
  twice.insert(twice.end(), mesh.triangles.begin(), mesh.triangles.end());
  const auto found = volume_of({mesh.vertices, std::move(twice)});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->exact);
  EXPECT_NEAR(found->volume, 6, 1e-9);  // every line sees twice what it should, exactly
}

TEST(solid_volume, of_crossing_pieces_counts_what_they_share_once) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {2, 2, 2});
  add_box(mesh, {1, 1, 1}, {3, 3, 3});
  const auto found = volume_of(mesh);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->exact);
  EXPECT_NEAR(found->volume, 15, 0.015);
}

TEST(solid_volume, of_an_open_mesh_is_not_known) {
  TriangleMesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 1, 1});
  mesh.triangles = std::vector<Triangle>(mesh.triangles.begin(), mesh.triangles.end() - 1);
  EXPECT_FALSE(volume_of(mesh));
}

}  // namespace
}  // namespace ballflow::geometry
