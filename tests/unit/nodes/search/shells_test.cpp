#include "search/shells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "search/self_intersection.hpp"

namespace ballflow::geometry {
namespace {

/// Boxes and octahedra side by side and inside each other.
struct Pieces {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  Pieces& add(const std::vector<Vec3>& corners, const std::vector<Triangle>& faces, bool inwards) {
    const auto first = static_cast<std::int32_t>(vertices.size());
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    for (const auto& [a, b, c] : faces)
      triangles.push_back(inwards ? Triangle{first + a, first + c, first + b}
                                  : Triangle{first + a, first + b, first + c});
    return *this;
  }
  Pieces& box(Vec3 lower, Vec3 upper, bool inwards = false) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back({i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    return add(corners,
               {{0, 2, 1},
                {1, 2, 3},
                {4, 5, 6},
                {5, 7, 6},
                {0, 1, 4},
                {1, 5, 4},
                {2, 6, 3},
                {3, 6, 7},
                {0, 4, 2},
                {2, 4, 6},
                {1, 3, 5},
                {3, 7, 5}},
               inwards);
  }
  TriangleMesh mesh() const { return {vertices, triangles}; }
};

TEST(shells, have_the_volume_and_area_of_boxes) {
  const Shells shells = shells_of(Pieces().box({10, 20, 30}, {12, 23, 34}).box({0, 0, 0}, {1, 1, 1}).mesh());
  ASSERT_EQ(shells.shells.size(), 2u);
  EXPECT_DOUBLE_EQ(shells.shells[0].volume, 24);
  EXPECT_DOUBLE_EQ(shells.shells[0].area, 2 * (6 + 8 + 12));
  EXPECT_EQ(shells.shells[0].genus, 0);
  EXPECT_EQ(shells.shells[0].triangles, 12);
  EXPECT_EQ(shells.shells[0].vertices, 8);
  EXPECT_EQ(shells.shells[0].box.upper, (Vec3{12, 23, 34}));
  EXPECT_EQ(shells.shells[0].parent, -1);
  EXPECT_EQ(shells.shell.back(), 1);
  EXPECT_DOUBLE_EQ(shells.volume(), 25);
  EXPECT_DOUBLE_EQ(shells.area(), 58);
  EXPECT_EQ(shells.betti(), (Betti{2, 0, 0}));
}

TEST(shells, lie_in_the_smallest_one_around_them) {
  // From inside out, so that numbers do not say it: a solid in a cavity in a solid.
  const Shells shells = shells_of(
      Pieces().box({2, 2, 2}, {3, 3, 3}).box({1, 1, 1}, {4, 4, 4}, true).box({0, 0, 0}, {5, 5, 5}).mesh());
  EXPECT_EQ(shells.shells[0].parent, 1);
  EXPECT_EQ(shells.shells[1].parent, 2);
  EXPECT_EQ(shells.shells[2].parent, -1);
  EXPECT_EQ(shells.betti(), (Betti{2, 0, 1}));
  EXPECT_DOUBLE_EQ(shells.volume(), 125 - 27 + 1);
  EXPECT_FALSE(shells.shells[1].faces_outwards);
  for (const Shell& shell : shells.shells) EXPECT_TRUE(shell.bounds && !shell.turned);
}

TEST(shells, that_face_outwards_inside_the_solid_bound_nothing) {
  const Shells shells = shells_of(Pieces().box({0, 0, 0}, {5, 5, 5}).box({1, 1, 1}, {4, 4, 4}).mesh());
  EXPECT_FALSE(shells.shells[1].bounds);
  EXPECT_TRUE(shells.shells[0].bounds);
  EXPECT_DOUBLE_EQ(shells.volume(), 125);
  EXPECT_EQ(shells.betti(), (Betti{1, 0, 0}));
}

TEST(shells, that_face_inwards_and_bound_no_cavity_are_turned) {
  const Shells one = shells_of(Pieces().box({0, 0, 0}, {1, 2, 3}, true).mesh());
  EXPECT_TRUE(one.inside_out);
  EXPECT_DOUBLE_EQ(one.volume(), 6);
  const Shells two = shells_of(Pieces().box({0, 0, 0}, {1, 2, 3}, true).box({5, 0, 0}, {9, 4, 4}).mesh());
  EXPECT_FALSE(two.inside_out);
  EXPECT_TRUE(two.shells[0].turned);
  EXPECT_DOUBLE_EQ(two.volume(), 70);
  EXPECT_EQ(two.betti(), (Betti{2, 0, 0}));
}

/// Whether a segment runs through the inside of a triangle, in doubles: for points in general position.
bool pierces(Vec3 p, Vec3 q, const std::array<Vec3, 3>& t) {
  const auto side = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(cross(b - a, c - a), d - a) > 0; };
  if (side(t[0], t[1], t[2], p) == side(t[0], t[1], t[2], q)) return false;
  const bool first = side(p, q, t[0], t[1]);
  return side(p, q, t[1], t[2]) == first && side(p, q, t[2], t[0]) == first;
}

TEST(self_intersections, of_random_triangles_are_those_of_every_pair) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0, 1), near(-0.15, 0.15);
  TriangleMesh mesh;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < 300; ++i) {
    const Vec3 p{anywhere(random), anywhere(random), anywhere(random)};
    for (int k = 0; k < 3; ++k) vertices.push_back(p + Vec3{near(random), near(random), near(random)});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  std::vector<std::array<std::int32_t, 2>> expected;
  const auto corners = [&](std::size_t t) {
    return std::array<Vec3, 3>{vertices[3 * t], vertices[3 * t + 1], vertices[3 * t + 2]};
  };
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    for (std::size_t t = s + 1; t < triangles.size(); ++t) {
      const auto a = corners(s), b = corners(t);
      bool crosses = false;
      for (std::size_t k = 0; k < 3; ++k)
        crosses = crosses || pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a);
      if (crosses) expected.push_back({static_cast<std::int32_t>(s), static_cast<std::int32_t>(t)});
    }
  }
  ASSERT_GT(expected.size(), 100u);
  mesh = {vertices, triangles};
  const SelfIntersections found = self_intersections(mesh, 100000, no_monitor());
  EXPECT_EQ(found.pairs, expected);
  EXPECT_TRUE(found.all);
  EXPECT_TRUE(found.flat.empty());
  const SelfIntersections some = self_intersections(mesh, 10, no_monitor());
  EXPECT_EQ(some.pairs.size(), 10u);
  EXPECT_FALSE(some.all);
}

TEST(self_intersections, list_triangles_without_area_and_go_on) {
  Pieces pieces = Pieces().box({0, 0, 0}, {2, 2, 2}).box({1, 1, 1}, {3, 3, 3});
  const std::size_t crossings = self_intersections(pieces.mesh(), 1000, no_monitor()).pairs.size();
  EXPECT_GT(crossings, 0u);
  pieces.add({{9, 9, 9}, {10, 10, 10}, {11, 11, 11}}, {{0, 1, 2}}, false);
  const SelfIntersections found = self_intersections(pieces.mesh(), 1000, no_monitor());
  EXPECT_EQ(found.flat, std::vector<std::int32_t>{24});
  EXPECT_EQ(found.pairs.size(), crossings);
}

}  // namespace
}  // namespace ballflow::geometry
