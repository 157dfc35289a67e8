#include "search/winding_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/arctangent.hpp"
#include "shapes.hpp"

namespace ballflow {
namespace {

using geometry::arctangent;
using geometry::solid_angle_fraction;
using geometry::SolidAngles;
using geometry::WindingNumber;
using test::Mesh;
using test::Vec3;

TEST(arctangent, is_that_of_the_c_library_up_to_rounding) {
  std::mt19937 random(3);
  for (int i = 0; i < 100000; ++i) {
    const double y = static_cast<double>(random()) - 2147483648.0,
                 x = static_cast<double>(random()) - 2147483648.0;
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    ASSERT_NEAR(arctangent(scale * y, x), std::atan2(scale * y, x), 1e-15);
  }
  EXPECT_EQ(arctangent(0, 0), 0);
  EXPECT_EQ(arctangent(0, 1), 0);
  EXPECT_NEAR(arctangent(0, -1), std::atan2(0.0, -1.0), 1e-15);
  EXPECT_NEAR(arctangent(-1, 0), std::atan2(-1.0, 0.0), 1e-15);
}

TEST(solid_angles, of_a_closed_surface_are_one_inside_and_zero_outside) {
  const Mesh sphere = test::sphere(3);
  const SolidAngles angles(sphere.vertices, sphere.triangles, geometry::no_monitor());
  EXPECT_NEAR(angles.sum({0.1, 0.2, -0.3}, 0).value, 1, 1e-12);
  EXPECT_NEAR(angles.sum({1.1, 0.2, -0.3}, 0).value, 0, 1e-12);
  EXPECT_NEAR(solid_angle_fraction({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}), 1.0 / 8, 1e-15);
}

TEST(solid_angles, deviate_by_less_than_the_bound_of_the_hierarchical_sum) {
  Mesh sheet = test::torus(40, 20, 0.3);
  sheet.triangles.resize(sheet.triangles.size() / 2);
  const SolidAngles angles(sheet.vertices, sheet.triangles, geometry::no_monitor());
  std::mt19937 random(4);
  int approximated = 0;
  for (int i = 0; i < 500; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0 * 6 - 3; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    const SolidAngles::Sum exact = angles.sum({x, y, z}, 0);
    EXPECT_EQ(exact.error, 0);
    for (const double tolerance : {1e-1, 1e-2, 1e-4}) {
      const SolidAngles::Sum sum = angles.sum({x, y, z}, tolerance);
      EXPECT_LE(sum.error, tolerance * (1 + 1e-9));
      EXPECT_LE(std::abs(sum.value - exact.value), sum.error + 1e-12);
      if (sum.error > 0) ++approximated;
    }
  }
  EXPECT_GT(approximated, 500);
}

TEST(winding_number, of_a_closed_mesh_counts_how_often_it_goes_around) {
  Mesh twice = test::cube();
  twice.add(test::cube().move({0, 0, 0}, 2));
  const WindingNumber winding(twice.mesh(), geometry::no_monitor());
  EXPECT_TRUE(winding.chain().closed());
  EXPECT_EQ(winding.chain().components, 2);
  // On a lattice every ray goes through edges and vertices.
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      for (int z = -5; z <= 5; ++z) {
        const int reach = std::max({std::abs(x), std::abs(y), std::abs(z)});
        if (reach == 2 || reach == 4) continue;  // on the surface
        EXPECT_EQ(winding.around({0.5 * x, 0.5 * y, 0.5 * z}).number, reach < 2 ? 2 : reach < 4 ? 1 : 0);
      }
    }
  }
  EXPECT_TRUE(winding.around({0.25, 0.5, -1}).on_surface);
  EXPECT_FALSE(winding.around({0.25, 0.5, -0.99}).on_surface);
}

TEST(winding_number, of_an_open_mesh_is_the_sum_of_its_solid_angles) {
  Mesh open = test::torus(40, 20, 0.3);
  std::mt19937 random(6);
  std::erase_if(open.triangles, [&](const auto&) { return random() % 10 == 0; });
  const WindingNumber winding(open.mesh(), geometry::no_monitor());
  EXPECT_FALSE(winding.chain().closed());
  for (int i = 0; i < 300; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0 * 3 - 1.5; };
    const double x = coordinate(), y = coordinate(), z = 0.3 * coordinate();
    double sum = 0;
    for (const auto& t : open.triangles) {
      const auto corner = [&](std::size_t k) { return open.vertices[static_cast<std::size_t>(t[k])]; };
      sum += solid_angle_fraction(corner(0), corner(1), corner(2), {x, y, z});
    }
    const double number = winding.around({x, y, z}).number;
    EXPECT_NEAR(number, sum, 0.1);
    for (const double threshold : {0.25, 0.5, 0.75}) EXPECT_EQ(number > threshold, sum > threshold);
  }
}

TEST(winding_number, of_separate_triangles_is_the_sum_of_their_solid_angles) {
  Mesh soup = test::sphere(2);
  Mesh separate;
  for (const auto& t : soup.triangles) {
    for (const std::int32_t v : t) separate.vertices.push_back(soup.vertices[static_cast<std::size_t>(v)]);
    const auto last = static_cast<std::int32_t>(separate.vertices.size());
    separate.triangles.push_back({last - 3, last - 2, last - 1});
  }
  const WindingNumber winding(separate.mesh(), geometry::no_monitor());
  EXPECT_EQ(winding.chain().boundary.size(), 3 * soup.triangles.size());
  EXPECT_NEAR(winding.around({0.1, 0.2, 0.3}).number, 1, 0.1);
  EXPECT_NEAR(winding.around({0.1, 1.2, 0.3}).number, 0, 0.1);
}

}  // namespace
}  // namespace ballflow
