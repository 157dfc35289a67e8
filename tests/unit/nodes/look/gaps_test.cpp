#include "look/gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace ballflow::geometry {
namespace {

/// A torus of n x m quadrangles, each two triangles.
TriangleMesh torus(std::int32_t n, std::int32_t m) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t k = 0; k < m; ++k) {
      const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * k / m, d = 1 + 0.4 * std::cos(v);
      vertices.push_back({d * std::cos(u), d * std::sin(u), 0.4 * std::sin(v)});
      const auto id = [&](std::int32_t a, std::int32_t b) { return a % n * m + b % m; };
      triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
      triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Every triangle with corners of its own, moved by at most `crack` in every direction.
TriangleMesh cracked(const TriangleMesh& mesh, double crack) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> move(-crack, crack);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(vertices.size());
    for (const std::int32_t v : t)
      vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] +
                         Vec3{move(random), move(random), move(random)});
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(gaps, of_a_closed_surface_are_none) {
  const Gaps gaps = gaps_of(torus(12, 8));
  EXPECT_EQ(gaps.open_edges, 0);
  EXPECT_TRUE(gaps.rims.empty());
  EXPECT_FALSE(gaps.small);
}

TEST(gaps, that_are_cracks_come_with_the_weld_that_closes_them) {
  for (const double crack : {1e-9, 1e-5, 1e-3}) {
    const TriangleMesh mesh = cracked(torus(12, 8), crack);
    const Gaps gaps = gaps_of(mesh);
    EXPECT_EQ(gaps.open_edges, static_cast<std::int64_t>(3 * mesh.triangles.size()));
    EXPECT_EQ(gaps.rims.size(), mesh.triangles.size());
    ASSERT_TRUE(gaps.small) << crack;
    EXPECT_EQ(gaps.small->left, 0);
    EXPECT_LE(gaps.small->tolerance, 10 * crack);
  }
}

TEST(gaps, that_are_holes_stay_open_whatever_is_welded) {
  TriangleMesh mesh = torus(24, 16);
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  triangles.erase(triangles.begin(), triangles.begin() + 2);  // a quadrangle
  triangles.erase(triangles.begin() + 300);                   // a triangle elsewhere
  mesh.triangles = std::move(triangles);
  const Gaps gaps = gaps_of(mesh);
  EXPECT_EQ(gaps.open_edges, 7);
  ASSERT_EQ(gaps.rims.size(), 2u);
  EXPECT_EQ(gaps.rims[0].edges, 4);
  EXPECT_EQ(gaps.rims[1].edges, 3);
  EXPECT_GT(gaps.rims[0].length, gaps.rims[1].length);
  EXPECT_FALSE(gaps.small);
}

TEST(gaps, beside_a_hole_are_closed_and_the_hole_is_counted) {
  TriangleMesh mesh = cracked(torus(12, 8), 1e-4);
  std::vector<Triangle> triangles(mesh.triangles.begin() + 1, mesh.triangles.end());
  mesh.triangles = std::move(triangles);
  const Gaps gaps = gaps_of(mesh);
  ASSERT_TRUE(gaps.small);
  EXPECT_EQ(gaps.small->left, 3);
}

}  // namespace
}  // namespace ballflow::geometry
