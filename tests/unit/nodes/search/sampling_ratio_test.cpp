#include "search/sampling_ratio.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shapes.hpp"

namespace ballflow::geometry {
namespace {

TEST(sampling_ratio, of_a_sphere_is_attained_at_a_circumcentre) {
  // All of a triangle is farther from the middle, and nearer to a corner, than the centre of its
  // circumcircle.
  for (const int levels : {1, 3, 4}) {
    const test::Mesh sphere = test::sphere(levels);
    double expected = 0;
    for (const auto& [i, j, k] : sphere.triangles) {
      const Vec3 a = sphere.vertices[static_cast<std::size_t>(i)],
                 b = sphere.vertices[static_cast<std::size_t>(j)],
                 c = sphere.vertices[static_cast<std::size_t>(k)];
      const double radius =
          distance(a, b) * distance(b, c) * distance(c, a) / (2 * length(cross(b - a, c - a)));
      expected = std::max(expected, radius / std::sqrt(1 - radius * radius));
    }
    const SamplingRatio r = sampling_ratio(sphere.vertices, sphere.mesh(), [](Vec3 p) { return length(p); });
    EXPECT_LE(r.at_least, expected * (1 + 1e-12)) << levels;
    EXPECT_GE(r.at_most, expected * (1 - 1e-12)) << levels;
    EXPECT_LE(r.at_most, 1.04 * r.at_least) << levels;
  }
}

TEST(sampling_ratio, bounds_what_random_points_of_the_mesh_say) {
  const test::Mesh torus = test::torus(30, 12, 0.4);
  const auto size = [](Vec3 p) {
    const double r = std::hypot(p.x, p.y);
    return std::min(r, std::hypot(r - 1, p.z));
  };
  std::vector<Vec3> some;  // a third of the vertices
  for (std::size_t i = 0; i < torus.vertices.size(); i += 3) some.push_back(torus.vertices[i]);
  const auto ratio_at = [&](Vec3 p) {
    double gap = 1e9;
    for (const Vec3& s : some) gap = std::min(gap, distance(p, s));
    return gap / size(p);
  };
  const SamplingRatio r = sampling_ratio(some, torus.mesh(), size);
  ASSERT_LT(r.at_least, 1);
  EXPECT_NEAR(ratio_at(r.at), r.at_least, 1e-12);
  std::mt19937 random(1);
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto& t = torus.triangles[random() % torus.triangles.size()];
    double u = static_cast<double>(random()) / 4294967296.0, v = static_cast<double>(random()) / 4294967296.0;
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 a = torus.vertices[static_cast<std::size_t>(t[0])];
    largest = std::max(largest, ratio_at(a + u * (torus.vertices[static_cast<std::size_t>(t[1])] - a) +
                                         v * (torus.vertices[static_cast<std::size_t>(t[2])] - a)));
  }
  EXPECT_LE(largest, r.at_most);
  EXPECT_GT(largest, 0.9 * r.at_least) << "the bound is not far off";
}

TEST(sampling_ratio, ends_where_nothing_follows) {
  // The feature size of a cube vanishes at its edges, if the diagonal planes are its axis.
  const test::Mesh cube = test::lattice_cube(6, 0, 1);
  const auto size = [](Vec3 p) {
    std::array<double, 3> c{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    std::sort(c.begin(), c.end());
    return (c[2] - c[1]) / std::sqrt(2.0);
  };
  const SamplingRatio r = sampling_ratio(cube.vertices, cube.mesh(), size);
  EXPECT_GE(r.at_least, 1);
  EXPECT_TRUE(std::isfinite(r.at_least));
  EXPECT_TRUE(std::isinf(r.at_most));
}

TEST(sampling_ratio, does_not_depend_on_threads) {
  const test::Mesh torus = test::torus(40, 20, 0.4);
  const auto run = [&] {
    return sampling_ratio(torus.vertices, torus.mesh(), [](Vec3 p) { return 0.2 + 0.1 * std::abs(p.x); });
  };
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SamplingRatio alone = run();
  for (const std::size_t threads : {2, 4}) {
    tbb::global_control several(tbb::global_control::max_allowed_parallelism, threads);
    const SamplingRatio r = run();
    EXPECT_EQ(r.at_least, alone.at_least);
    EXPECT_EQ(r.at_most, alone.at_most);
    EXPECT_EQ(r.at, alone.at);
  }
}

TEST(sampling_ratio, of_nothing) {
  const auto one = [](Vec3) { return 1.0; };
  EXPECT_EQ(sampling_ratio({}, {}, one).at_most, 0);
  EXPECT_THROW(sampling_ratio({}, test::cube().mesh(), one), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
