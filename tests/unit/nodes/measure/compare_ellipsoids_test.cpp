#include "measure/compare_ellipsoids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "compare_cases.hpp"
#include "measure/ellipsoid_union.hpp"
#include "search/ellipsoid.hpp"

namespace ballflow::geometry {
namespace {

using compare_cases::cube;
using compare_cases::unit;

Ellipsoids one(Vec3 center, Vec3 radii, Quaternion rotation = {}) {
  return {std::vector<Vec3>{center}, std::vector<Vec3>{radii}, std::vector<Quaternion>{rotation}};
}

Quaternion some_rotation(std::mt19937& random) {
  return quaternion_of(frame_of({unit(random), unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}));
}

CompareOptions fine(double spacing) {
  CompareOptions options;
  options.spacing = spacing;
  return options;
}

TEST(compare_ellipsoids, one_in_a_cube_has_the_distances_of_the_formulas) {
  const Comparison c = compare_ellipsoids(one({}, {0.5, 0.7, 0.9}), {}, cube(), fine(1));
  // The farthest of its points from the faces has three equal coordinates.
  const double t = 1 / std::sqrt(1 / 0.25 + 1 / 0.49 + 1 / 0.81);
  EXPECT_LE(c.union_to_surface.value, 1 - t + 1e-12);
  EXPECT_GE(c.union_to_surface.at_most, 1 - t);
  EXPECT_NEAR(c.union_to_surface.value, 1 - t, c.spacing);
  // And of the cube's points from it a corner.
  const double corner = Ellipsoid({}, {0.5, 0.7, 0.9}, {}).signed_distance({1, 1, 1});
  EXPECT_NEAR(c.surface_to_union.value, corner, c.spacing);
  EXPECT_GE(c.surface_to_union.at_most, corner);
  EXPECT_EQ(c.protrusion, 0);
  EXPECT_EQ(c.coverage, 0);
  EXPECT_NEAR(c.union_volume, 4 * std::numbers::pi / 3 * 0.5 * 0.7 * 0.9, 1e-3 * c.union_volume);
  EXPECT_DOUBLE_EQ(c.surface_volume, 8);
}

TEST(compare_ellipsoids, protrusion_is_what_half_axes_have_to_lose) {
  std::mt19937 random(3);
  for (const double beyond : {0.001, 0.2, 0.6}) {
    // Through two faces, and turned about the axis that meets them.
    const Ellipsoids through = one({}, {1 + beyond, 0.4, 0.05}, quaternion_of(frame_of({0.9, 0.3, 0, 0})));
    const double t = compare_ellipsoids(through, {}, cube(), fine(20)).protrusion;
    EXPECT_GE(t, beyond * (1 - 1e-9));
    EXPECT_LE(t, beyond * 1.01 + 1e-5);
  }
  // Whatever it says, no sampled point of ellipsoids with their centers inside is farther from the cube.
  for (int k = 0; k < 20; ++k) {
    const Ellipsoids any =
        one({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5},
            {unit(random) + 0.1, unit(random) + 0.1, unit(random) + 0.01}, some_rotation(random));
    const double t = compare_ellipsoids(any, {}, cube(), fine(20)).protrusion;
    const Ellipsoid e(any, 0);
    double farthest = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 v{unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
      const Vec3 p = e.at(1 / length(v) * v);
      const auto outside = [](double x) { return std::max(std::abs(x) - 1, 0.0); };
      farthest = std::max(farthest, length({outside(p.x), outside(p.y), outside(p.z)}));
    }
    EXPECT_LE(farthest, t + 1e-12);
  }
}

TEST(compare_ellipsoids, balls_as_ellipsoids_are_compared_as_balls_are) {
  std::mt19937 random(5);
  std::vector<Vec3> centers, half_axes;
  std::vector<double> radii;
  std::vector<Quaternion> rotations;
  for (int i = 0; i < 30; ++i) {
    centers.push_back({1.8 * unit(random) - 0.9, 1.8 * unit(random) - 0.9, 1.8 * unit(random) - 0.9});
    radii.push_back(0.2 + 0.4 * unit(random));
    half_axes.push_back({radii.back(), radii.back(), radii.back()});
    rotations.push_back(some_rotation(random));
  }
  const Comparison a = compare(compare_cases::balls_of(centers, radii), {}, cube(), fine(2)),
                   b = compare_ellipsoids({centers, half_axes, rotations}, {}, cube(), fine(2));
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.surface_samples, b.surface_samples);
  EXPECT_NEAR(a.coverage, b.coverage, 1e-12);
  EXPECT_NEAR(a.uncovered, b.uncovered, 1e-12);
  EXPECT_NEAR(a.union_volume, b.union_volume, 1e-3 * a.union_volume);
  EXPECT_NEAR(a.surface_to_union.at_least, b.surface_to_union.at_least, 1e-12);
  EXPECT_NEAR(a.surface_to_union.value, b.surface_to_union.value, 1.1 * a.spacing);
  // Their samples of the boundary differ.
  EXPECT_NEAR(a.union_to_surface.value, b.union_to_surface.value, a.spacing);
  EXPECT_NEAR(a.union_to_surface.mean, b.union_to_surface.mean, 0.02 * a.union_to_surface.mean);
  EXPECT_GE(b.protrusion, a.protrusion * (1 - 1e-9));
  EXPECT_LE(b.protrusion, 1.01 * a.protrusion + 1e-5);
}

TEST(compare_ellipsoids, two_that_overlap_have_the_volume_of_the_image_of_a_lens) {
  // Two unit balls at the distance 1, stretched by (3, 1, 0.1): union 2 balls less a lens of 5 pi / 12.
  std::mt19937 random(8);
  const Quaternion q = some_rotation(random);
  const Frame f = frame_of(q);
  const Ellipsoids both{{f.out_of({0, 0, 0}), f.out_of({3, 0, 0})}, {Vec3{3, 1, 0.1}, {3, 1, 0.1}}, {q, q}};
  const EllipsoidUnion all(both);
  const double expected = 0.3 * (8 * std::numbers::pi / 3 - 5 * std::numbers::pi / 12);
  EXPECT_NEAR(union_volume(all, both, 256, no_monitor()), expected, 2e-3 * expected);
  // The areas of the samples sum to the area of what shows: an ellipsoid of revolution has a formula.
  const Ellipsoids disc = one({1, 2, 3}, {2, 2, 0.5}, q);
  Budget budget(10'000'000, "samples");
  const BoundarySamples samples = boundary_samples(EllipsoidUnion(disc), 0.05, 1e-9, budget);
  double area = 0;
  for (const double part : samples.areas) area += part;
  const double e = std::sqrt(1 - 0.25 * 0.25);
  EXPECT_NEAR(area, 2 * std::numbers::pi * 4 * (1 + (1 - e * e) / e * std::atanh(e)), 0.01 * area);
}

TEST(compare_ellipsoids, says_what_is_wrong) {
  const auto refusal = [](const Ellipsoids& all, const PointSet& points, const TriangleMesh& mesh,
                          double spacing) {
    try {
      compare_ellipsoids(all, points, mesh, fine(spacing));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(refusal({}, {}, cube(), 1).find("no ellipsoids"), std::string::npos);
  EXPECT_NE(refusal(one({}, {1, 1, 1}), {}, {}, 1).find("no surface"), std::string::npos);
  EXPECT_NE(refusal(one({}, {1, 1, 0}), {}, cube(), 1).find("damaged"), std::string::npos);
  EXPECT_NE(refusal(one({}, {1, 1, 1}), {}, cube(), 0).find("spacing"), std::string::npos);
  EXPECT_NE(refusal(one({}, {1, 1, 1}), {}, cube(), 0.001).find("million"), std::string::npos);
  // Points alone are a surface, too.
  const Comparison cloud =
      compare_ellipsoids(one({}, {1, 1, 1}), {{Vec3{2, 0, 0}, {0, 0, 1}}, {}}, {}, fine(5));
  EXPECT_NEAR(cloud.uncovered, 1, 1e-12);
  EXPECT_EQ(cloud.coverage, 0.5);
}

}  // namespace
}  // namespace ballflow::geometry
