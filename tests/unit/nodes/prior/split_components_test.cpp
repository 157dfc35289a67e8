#include "prior/split_components.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sample/generate.hpp"

namespace ballflow::geometry {
namespace {

/// Two meshes in one, their triangles taking turns.
TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> vertices(a.vertices.begin(), a.vertices.end());
  vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
  std::vector<Triangle> triangles;
  const auto shift = static_cast<std::int32_t>(a.vertices.size());
  for (std::size_t i = 0; i < std::max(a.triangles.size(), b.triangles.size()); ++i) {
    if (i < a.triangles.size()) triangles.push_back(a.triangles[i]);
    if (i >= b.triangles.size()) continue;
    const Triangle& t = b.triangles[i];
    triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(split_components, gives_what_was_put_together_back_by_size) {
  const TriangleMesh small = generate({Shape::sphere, 100, 0.5}),
                     large = generate({Shape::torus, 400, 2, 0.5});
  const TriangleMesh both = together(small, large);
  const MeshComponent first = split_components(both, {0}), second = split_components(both, {1});
  EXPECT_EQ(first.components, 2);
  EXPECT_TRUE(first.mesh.vertices == large.vertices && first.mesh.triangles == large.triangles);
  EXPECT_TRUE(second.mesh.vertices == small.vertices && second.mesh.triangles == small.triangles);
}

TEST(split_components, of_equal_ones_that_with_the_first_triangle_comes_first) {
  const TriangleMesh one = generate({Shape::sphere, 100});
  TriangleMesh other = one;
  std::vector<Vec3> away(one.vertices.begin(), one.vertices.end());
  for (Vec3& p : away)
    p = p + Vec3{8, 0, 0};  // exact for coordinates of a unit sphere, but for the last bits
  other.vertices = away;
  const MeshComponent first = split_components(together(one, one), {0});
  EXPECT_EQ(first.components, 2);
  EXPECT_TRUE(first.mesh.vertices == one.vertices);
  EXPECT_EQ(split_components(together(one, other), {1}).mesh.triangles.size(), one.triangles.size());
}

TEST(split_components, names_how_many_there_are) {
  const TriangleMesh one = generate({Shape::sphere, 100});
  try {
    split_components(one, {3});
    FAIL() << "component 3 of 1";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("component 3 is asked for, the mesh has 1"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(split_components({}, {0}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
