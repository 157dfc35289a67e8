#include "search/ellipsoid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.hpp"

using namespace ballflow::geometry;

namespace {

double uniform(Random& random, double low, double high) { return low + (high - low) * random.unit(); }

Frame any_frame(Random& random) {
  return frame_of(
      {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.1, 1)});
}

Vec3 direction(Random& random) {
  for (;;) {
    const Vec3 v{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    if (squared_length(v) > 0.01 && squared_length(v) <= 1) return 1 / length(v) * v;
  }
}

constexpr std::array<Vec3, 6> half_axes{Vec3{1, 1, 1},         {3, 2, 1},       {1, 50, 50},
                                        {0.505, 0.505, 0.015}, {1e-4, 1, 0.01}, {2, 2 + 1e-9, 2}};

}  // namespace

TEST(Ellipsoid, points_above_the_surface_are_as_far_as_they_are_high) {
  Random random(1);
  for (const Vec3 a : half_axes) {
    const double longest = std::max({a.x, a.y, a.z});
    for (int k = 0; k < 400; ++k) {
      const Frame frame = any_frame(random);
      const Vec3 center{uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2)};
      const Ellipsoid e(center, a, frame);
      const Vec3 u = direction(random);
      const Vec3 gradient{u.x / a.x, u.y / a.y, u.z / a.z};
      const Vec3 normal = frame.out_of(1 / length(gradient) * gradient);
      // Convex: outside, as far as one likes. Inside as far as the smallest radius of curvature of all, which
      // is (shortest half-axis)^2 / longest.
      const double shortest = std::min({a.x, a.y, a.z});
      const double height =
          k % 2 == 0 ? uniform(random, 0, 3) : -uniform(random, 0, shortest * shortest / longest);
      const double found = e.signed_distance(e.at(u) + height * normal);
      EXPECT_NEAR(found, height, 1e-12 * (longest + std::abs(height))) << a.x << " " << a.y << " " << a.z;
    }
  }
}

TEST(Ellipsoid, centers_and_planes_of_symmetry_have_the_distance_that_formulas_say) {
  for (const Vec3 a : half_axes) {
    const Ellipsoid e({1, 2, 3}, a, {});
    const double shortest = std::min({a.x, a.y, a.z}), longest = std::max({a.x, a.y, a.z});
    EXPECT_NEAR(e.signed_distance({1, 2, 3}), -shortest, 1e-12 * longest);
    for (const double t : {0.0, 0.3, 0.7, 0.999, 1.0, 1.5, 20.0}) {
      // On the longest axis: the nearest point is off the axis while x < (l^2 - s^2) / l, s the shortest.
      const Vec3 along = a.x == longest ? Vec3{1, 0, 0} : a.y == longest ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
      const double x = t * longest, l = longest, s = shortest;
      const double expected = x < (l * l - s * s) / l ? -s * std::sqrt(1 - x * x / (l * l - s * s)) : x - l;
      EXPECT_NEAR(e.signed_distance(Vec3{1, 2, 3} + x * along), expected, 1e-11 * l) << t;
    }
  }
}

TEST(Ellipsoid, no_point_of_the_surface_is_nearer_than_it_says_and_one_is_hardly_farther) {
  Random random(2);
  for (const Vec3 a : half_axes) {
    const Ellipsoid e({}, a, any_frame(random));
    const double longest = std::max({a.x, a.y, a.z});
    for (int k = 0; k < 4; ++k) {
      const Vec3 p = e.at(uniform(random, 0, 1.5) * direction(random));
      const double found = std::abs(e.signed_distance(p));
      double nearest = 1e300;
      constexpr int n = 200;
      for (int i = 0; i < 2 * n; ++i) {
        for (int j = 0; j < n; ++j) {
          const double phi = i * 3.14159265358979 / n, theta = (j + 0.5) * 3.14159265358979 / n;
          nearest = std::min(nearest, distance(p, e.at({std::cos(phi) * std::sin(theta),
                                                        std::sin(phi) * std::sin(theta), std::cos(theta)})));
        }
      }
      EXPECT_LE(found, nearest * (1 + 1e-12) + 1e-12 * longest);
      EXPECT_GE(found, nearest - 4.0 / n * longest);
      EXPECT_EQ(e.contains(p), e.signed_distance(p) <= 0);
      EXPECT_LE(e.distance_at_least(p), std::max(0.0, e.signed_distance(p)) + 1e-12 * longest);
    }
  }
}

TEST(Rotation, quaternions_and_frames_say_the_same) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    Quaternion q{uniform(random, 0, 1), uniform(random, -1, 1), uniform(random, -1, 1),
                 uniform(random, -1, 1)};
    if (k % 5 == 0) q.w = 0;  // half turns, where a formula by the trace alone loses all digits
    const Frame frame = frame_of(q);
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    const Quaternion back = quaternion_of(frame);
    const double sign = back.w * q.w + back.x * q.x + back.y * q.y + back.z * q.z < 0 ? -1 : 1;
    EXPECT_NEAR(back.w, sign * q.w / norm, 1e-14);
    EXPECT_NEAR(back.x, sign * q.x / norm, 1e-14);
    EXPECT_NEAR(back.y, sign * q.y / norm, 1e-14);
    EXPECT_NEAR(back.z, sign * q.z / norm, 1e-14);
    EXPECT_NEAR(dot(frame.axes[2], cross(frame.axes[0], frame.axes[1])), 1, 1e-14);
    // v -> q v q*, by the product of quaternions.
    const Vec3 v{0.3, -0.7, 1.1}, u{q.x / norm, q.y / norm, q.z / norm};
    const double w = q.w / norm;
    const Vec3 turned = (2 * dot(u, v)) * u + (w * w - dot(u, u)) * v + (2 * w) * cross(u, v);
    EXPECT_LE(distance(frame.out_of(v), turned), 1e-14 * 4);
  }
}
