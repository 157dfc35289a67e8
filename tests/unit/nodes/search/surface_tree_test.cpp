#include "search/surface_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "shapes.hpp"

namespace ballflow::geometry {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()() { return static_cast<double>(random_()) / 2147483648.0 - 1; }
  Vec3 point() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937 random_;
};

TEST(surface_tree, the_nearest_point_of_a_sphere_is_about_one_radius_from_its_centre) {
  const TriangleMesh mesh = test::sphere(4).mesh();
  const SurfaceTree tree(mesh);
  Uniform random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = 2 * random.point();
    const auto found = tree.nearest(p, far);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, std::abs(length(p) - 1), 0.01);
    EXPECT_NEAR(found->distance, distance(p, found->point), 1e-12);
    EXPECT_NEAR(length(found->point), 1, 0.01);
  }
}

TEST(surface_tree, no_point_of_any_triangle_is_nearer_than_the_nearest) {
  Uniform random(2);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::int32_t t = 0; t < 60; ++t) {
    const Vec3 a = random.point();
    for (int k = 0; k < 3; ++k) vertices.push_back(a + 0.2 * random.point());
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  triangles.push_back({0, 0, 5});  // without area
  const TriangleMesh mesh{vertices, triangles};
  const SurfaceTree tree(mesh);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random.point();
    const auto found = tree.nearest(p, far);
    ASSERT_TRUE(found);
    double least = far;
    for (const auto& [a, b, c] : triangles) {
      const auto at = [&](std::int32_t v) { return vertices[static_cast<std::size_t>(v)]; };
      constexpr int steps = 40;
      for (int u = 0; u <= steps; ++u) {
        for (int v = 0; u + v <= steps; ++v) {
          const double s = 1.0 * u / steps, t = 1.0 * v / steps;
          least = std::min(least, distance(p, at(a) + s * (at(b) - at(a)) + t * (at(c) - at(a))));
        }
      }
    }
    EXPECT_LE(found->distance, least + 1e-12);
    EXPECT_GE(found->distance, least - 0.02);
    EXPECT_FALSE(tree.nearest(p, found->distance * (1 - 1e-9)));
  }
}

TEST(surface_tree, a_ray_meets_a_cube_where_the_formula_says_also_along_its_axes) {
  const TriangleMesh mesh = test::cube().mesh();
  const SurfaceTree tree(mesh);
  Uniform random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 from = 0.9 * random.point();
    Vec3 direction = random.point();
    if (i % 3 == 0) direction = i % 2 == 0 ? Vec3{0, 0, 1} : Vec3{0, -1, 0};
    double end = far;
    const auto side = [&](double at, double slope) {
      if (slope != 0) end = std::min(end, ((slope > 0 ? 1 : -1) - at) / slope);
    };
    side(from.x, direction.x);
    side(from.y, direction.y);
    side(from.z, direction.z);
    const auto hit = tree.first_hit(from, direction, 0, far);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, end, 1e-12 * end);
    EXPECT_FALSE(tree.first_hit(from, direction, 0, end * (1 - 1e-9)));
    EXPECT_FALSE(tree.first_hit(from, direction, end * (1 + 1e-9), far));
    EXPECT_EQ(tree.hits(from - 10 * direction, direction, 0, far).size(), 2u);
  }
}

TEST(surface_tree, normals_point_to_where_triangles_are_seen_counter_clockwise) {
  const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}, {0, 0, 1}}};
  const SurfaceTree tree(mesh);
  EXPECT_EQ(tree.normal(0), (Vec3{0, 0, 1}));
  EXPECT_EQ(tree.normal(1), (Vec3{0, 0, 0}));
}

TEST(surface_tree, a_mesh_without_triangles_is_nowhere) {
  const TriangleMesh mesh;
  const SurfaceTree tree(mesh);
  EXPECT_FALSE(tree.nearest({}, far));
  EXPECT_FALSE(tree.first_hit({}, {1, 0, 0}, 0, far));
}

}  // namespace
}  // namespace ballflow::geometry
