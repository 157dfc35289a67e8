// How far the sum of two unions is from the sum of the solids they stand for.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "measure/compare.hpp"
#include "minkowski_cases.hpp"
#include "sample/generate.hpp"

namespace ballflow::geometry {
namespace {

/// A finely triangulated sphere.
TriangleMesh sphere(double radius) {
  ShapeOptions options;
  options.shape = Shape::sphere;
  options.n = 1500;
  options.R = radius;
  return generate(options);
}

TEST(minkowski_error_bound, holds_for_the_surface_of_the_sum_of_two_solids) {
  const TriangleMesh mesh_a = sphere(1), mesh_b = sphere(0.5);
  const Balls a = balls_of({{0, 0, 0, 0.9}}), b = balls_of({{0, 0, 0, 0.45}});
  const CompareOptions options{.spacing = 1};
  const Comparison of_a = compare(a, {mesh_a.vertices, {}}, mesh_a, options),
                   of_b = compare(b, {mesh_b.vertices, {}}, mesh_b, options);
  // The surface of the sum of two concentric balls of 1 and 0.5 is 0.15 from the sum of balls of 0.9 and
  // 0.45.
  EXPECT_GE(error_bound(&of_a, &of_b), 0.15);
  EXPECT_LE(error_bound(&of_a, &of_b), 0.15 + of_a.spacing + of_b.spacing);
  // Without a comparison a solid is its balls.
  EXPECT_GE(error_bound(&of_a, nullptr), 0.1);
  EXPECT_LE(error_bound(nullptr, &of_b), 0.05 + of_b.spacing);
  EXPECT_LT(error_bound(nullptr, nullptr), 0);
}

TEST(minkowski_error_bound, is_claimed_for_closed_meshes_only) {
  const TriangleMesh closed = sphere(1);
  std::vector<Triangle> most(closed.triangles.begin(), closed.triangles.end() - 1);
  const TriangleMesh open{closed.vertices, std::move(most)};
  const Balls ball = balls_of({{0, 0, 0, 0.9}});
  const CompareOptions options{.spacing = 4};
  const Comparison solid = compare(ball, {closed.vertices, {}}, closed, options),
                   sheet = compare(ball, {open.vertices, {}}, open, options),
                   cloud = compare(ball, {closed.vertices, {}}, {}, options);
  const auto report = [&](const Comparison* a, const Comparison* b) {
    const MinkowskiReport found = minkowski_sum(ball, ball, {}, no_monitor(), {.a = a, .b = b}).report;
    EXPECT_EQ(broken_invariant(found), "");
    EXPECT_EQ(found.error_bound, error_bound(a, b));
    return found;
  };
  const auto why = [](const MinkowskiReport& r) {
    return why_unbounded(static_cast<ComparedWith>(r.a_compared_with),
                         static_cast<ComparedWith>(r.b_compared_with));
  };
  EXPECT_GE(report(&solid, &solid).error_bound, 0.2);
  EXPECT_EQ(why(report(&solid, &solid)), "");
  EXPECT_EQ(why(report(nullptr, &solid)), "");
  for (const Comparison* other : {&sheet, &cloud}) {
    EXPECT_EQ(report(other, nullptr).error_bound, -1);
    EXPECT_EQ(report(other, &solid).error_bound, -1);
    EXPECT_EQ(report(&solid, other).error_bound, -1);
  }
  EXPECT_EQ(why(report(&solid, &sheet)), "b was compared with an open mesh, which bounds no solid");
  EXPECT_EQ(
      why(report(&cloud, &sheet)),
      "a was compared with a cloud of points, and b was compared with an open mesh, which bounds no solid");
  EXPECT_EQ(why(report(nullptr, nullptr)), "neither a nor b was compared");
}

TEST(minkowski_error_bound, and_its_reason_exclude_each_other) {
  MinkowskiReport report;
  EXPECT_EQ(broken_invariant(report), "");
  report.error_bound = 1;
  EXPECT_NE(broken_invariant(report), "");
  report.a_compared_with = static_cast<std::uint8_t>(ComparedWith::open_mesh);
  EXPECT_NE(broken_invariant(report), "");
  report.a_compared_with = static_cast<std::uint8_t>(ComparedWith::closed_mesh);
  EXPECT_EQ(broken_invariant(report), "");
  report.error_bound = -1;
  EXPECT_NE(broken_invariant(report), "");
}

TEST(minkowski_sum, refuses_a_damaged_comparison) {
  const Balls ball = balls_of({{0, 0, 0, 1}});
  const Comparison damaged;  // compared with nothing
  EXPECT_THROW(minkowski_sum(ball, ball, {}, no_monitor(), {.b = &damaged}), InputError);
}

TEST(minkowski_error_bound, does_not_count_how_far_balls_reach_beyond_the_surface) {
  const TriangleMesh mesh = sphere(1);
  const Comparison large = compare(balls_of({{0, 0, 0, 1.5}}), {mesh.vertices, {}}, mesh, {.spacing = 1});
  EXPECT_LE(error_bound(&large, nullptr), large.spacing);
}

}  // namespace
}  // namespace ballflow::geometry
