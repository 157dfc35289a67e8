#include "measure/compare.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "compare_cases.hpp"

namespace ballflow::geometry {
namespace {

using compare_cases::balls_of;
using compare_cases::cube;
using compare_cases::unit;

constexpr double pi = std::numbers::pi;

void expect_within(const OneSidedDistance& d, double truth) {
  EXPECT_LE(d.at_least, truth * (1 + 1e-9));
  EXPECT_GE(d.at_most, truth * (1 - 1e-9));
}

TEST(compare, ball_in_a_cube_has_the_distances_of_the_formulas) {
  const CompareOptions options{.spacing = 1};
  const Comparison c = compare(balls_of({{0, 0, 0}}, {1}), {}, cube(), options);
  EXPECT_EQ(broken_invariant(c), "");
  EXPECT_DOUBLE_EQ(c.spacing, 0.02);
  // The corners are farthest from the ball, the point below a corner is farthest from the cube.
  const double corner = std::sqrt(3.0) - 1, below = 1 - 1 / std::sqrt(3.0);
  expect_within(c.surface_to_union, corner);
  expect_within(c.union_to_surface, below);
  EXPECT_NEAR(c.surface_to_union.value, corner, c.spacing);
  EXPECT_NEAR(c.union_to_surface.value, below, c.spacing);
  EXPECT_NEAR(c.hausdorff(), corner, c.spacing);
  EXPECT_NEAR(c.uncovered, corner, c.spacing);
  EXPECT_LT(c.coverage, 1e-3);
  EXPECT_LT(c.protrusion, 1e-12);

  // Mean of |x| - 1 over a face, and of 1 - max(|x|, |y|, |z|) over the sphere, by fine midpoint rules.
  double face = 0, sphere = 0, area = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n, r = std::sqrt(1 + x * x + y * y);
      face += (r - 1) / (n * n);
      area += 1 / (r * r * r);  // the solid angle of a piece of the face
      sphere += (1 - 1 / r) / (r * r * r);
    }
  }
  EXPECT_NEAR(c.surface_to_union.mean, face, 1e-3);
  EXPECT_NEAR(c.union_to_surface.mean, sphere / area, 1e-3);
  EXPECT_DOUBLE_EQ(c.chamfer(), (c.surface_to_union.mean + c.union_to_surface.mean) / 2);

  EXPECT_EQ(c.surface_encloses, 1);
  EXPECT_DOUBLE_EQ(c.surface_volume, 8);
  EXPECT_NEAR(c.union_volume, 4 * pi / 3, 1e-12);
}

TEST(compare, ball_through_the_faces_of_a_cube_covers_discs_and_protrudes) {
  const Comparison c = compare(balls_of({{0, 0, 0}}, {1.25}), {}, cube(), {.spacing = 1});
  EXPECT_NEAR(c.coverage, 6 * pi * (1.25 * 1.25 - 1) / 24, 2e-3);
  EXPECT_NEAR(c.protrusion, 0.25, 1e-12);
  expect_within(c.union_to_surface, std::max(0.25, 1 - 1.25 / std::sqrt(3.0)));
  expect_within(c.surface_to_union, std::sqrt(3.0) - 1.25);
}

TEST(compare, says_what_kind_of_surface_it_was) {
  const auto kind = [](const TriangleMesh& mesh) {
    const Comparison c = compare(balls_of({{0, 0, 0}}, {1}), {cube().vertices, {}}, mesh, {.spacing = 10});
    EXPECT_EQ(broken_invariant(c), "");
    return static_cast<ComparedWith>(c.compared_with);
  };
  const auto cube_of = [](std::vector<Triangle> triangles) {
    return TriangleMesh{cube().vertices, std::move(triangles)};
  };
  const TriangleMesh solid = cube();
  std::vector<Triangle> triangles(solid.triangles.begin(), solid.triangles.end());
  EXPECT_EQ(kind({}), ComparedWith::cloud);
  EXPECT_EQ(kind(cube_of(triangles)), ComparedWith::closed_mesh);
  std::swap(triangles[3][0], triangles[3][1]);
  EXPECT_EQ(kind(cube_of(triangles)), ComparedWith::closed_mesh) << "one triangle turned over";
  // A wall inside of two sheets that face opposite ways: edges of four triangles, no boundary.
  triangles.push_back({0, 1, 6});
  EXPECT_EQ(kind(cube_of(triangles)), ComparedWith::open_mesh) << "a wall of one sheet";
  triangles.push_back({0, 6, 1});
  EXPECT_EQ(kind(cube_of(triangles)), ComparedWith::closed_mesh);
  triangles.erase(triangles.begin());
  EXPECT_EQ(kind(cube_of(triangles)), ComparedWith::open_mesh);
}

TEST(compare, a_comparison_with_nothing_is_damaged) {
  Comparison c = compare(balls_of({{0, 0, 0}}, {1}), {}, cube(), {.spacing = 10});
  ASSERT_EQ(broken_invariant(c), "");
  c.compared_with = static_cast<std::uint8_t>(ComparedWith::open_mesh);
  EXPECT_NE(broken_invariant(c), "") << "an open mesh encloses nothing";
  c.compared_with = 0;
  EXPECT_NE(broken_invariant(c), "");
  c.compared_with = 4;
  EXPECT_NE(broken_invariant(c), "");
}

TEST(compare, sphere_and_its_own_sample_differ_by_the_gaps_of_the_sample) {
  std::vector<Vec3> points;
  std::mt19937 random(1);
  while (points.size() < 4000) {
    const Vec3 p{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    if (const double l = length(p); l > 0.1 && l < 1) points.push_back((1 / l) * p);
  }
  const Comparison c = compare(balls_of({{0, 0, 0}}, {1}), {points, {}}, {}, {.spacing = 1});
  EXPECT_EQ(c.surface_samples, 4000);
  EXPECT_LT(c.surface_to_union.at_least, 1e-12) << "every point is on the sphere";
  EXPECT_LT(c.surface_to_union.value, c.spacing);
  EXPECT_EQ(c.coverage, 1);
  EXPECT_EQ(c.uncovered, 0);
  EXPECT_EQ(c.surface_encloses, 0);
  // Brute force: the widest gap seen from many directions is not above the bound.
  double widest = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec3 p{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    p = (1 / length(p)) * p;
    double nearest = 4;
    for (const Vec3& q : points) nearest = std::min(nearest, distance(p, q));
    widest = std::max(widest, nearest);
  }
  EXPECT_LE(widest, c.union_to_surface.at_most);
  EXPECT_GE(c.union_to_surface.at_least, widest - c.spacing);
}

TEST(compare, bounds_hold_for_unions_tried_point_by_point) {
  std::mt19937 random(2);
  for (int round = 0; round < 5; ++round) {
    std::vector<Vec3> centers, points;
    std::vector<double> radii;
    for (int i = 0; i < 12; ++i) {
      centers.push_back({unit(random), unit(random), unit(random)});
      radii.push_back(0.15 + 0.3 * unit(random));
    }
    for (int j = 0; j < 200; ++j) points.push_back({unit(random), unit(random), unit(random)});
    const Comparison c = compare(balls_of(centers, radii), {points, {}}, {}, {.spacing = 3});
    ASSERT_EQ(broken_invariant(c), "");

    std::vector<Vec3> boundary;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      for (int k = 0; k < 3000; ++k) {
        Vec3 p{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
        if (length(p) > 1) continue;
        p = centers[i] + (radii[i] / length(p)) * p;
        bool inside = false;
        for (std::size_t j = 0; j < centers.size(); ++j) {
          inside = inside || (j != i && distance(p, centers[j]) < radii[j]);
        }
        if (!inside) boundary.push_back(p);
      }
    }
    double there = 0, back = 0, protrusion = 0;
    for (const Vec3& p : points) {
      double nearest = 9;
      for (const Vec3& q : boundary) nearest = std::min(nearest, distance(p, q));
      there = std::max(there, nearest);
    }
    const auto to_points = [&](Vec3 p) {
      double nearest = 9;
      for (const Vec3& q : points) nearest = std::min(nearest, distance(p, q));
      return nearest;
    };
    for (const Vec3& q : boundary) back = std::max(back, to_points(q));
    for (std::size_t i = 0; i < centers.size(); ++i) {
      protrusion = std::max(protrusion, radii[i] - to_points(centers[i]));
    }
    EXPECT_GE(there, c.surface_to_union.at_least - 1e-12);
    EXPECT_NEAR(there, c.surface_to_union.value, 2 * c.spacing);
    EXPECT_LE(back, c.union_to_surface.at_most);
    EXPECT_NEAR(back, c.union_to_surface.value, 2 * c.spacing);
    EXPECT_DOUBLE_EQ(c.protrusion, protrusion);
  }
}

TEST(compare, two_balls_have_the_volume_of_the_formula) {
  // Unit balls at distance 1: two caps of height 1/2 are counted once.
  const double truth = 2 * 4 * pi / 3 - 2 * (pi * 0.25 / 3 * (3 - 0.5));
  const PointSet points{{Vec3{0, 0, 0}, Vec3{1, 0, 0}}, {}};
  const Comparison c = compare(balls_of({{0, 0, 0}, {1, 0, 0}}, {1, 1}), points, {}, {.spacing = 2});
  EXPECT_NEAR(c.union_volume, truth, 1e-12) << "whatever the spacing";
  EXPECT_NEAR(c.surface_to_union.value, 1, c.spacing);
}

TEST(compare, equal_and_nested_balls_change_no_distance) {
  const TriangleMesh mesh = cube();
  const Comparison one = compare(balls_of({{0, 0, 0}}, {1.25}), {}, mesh, {.spacing = 2});
  const Comparison more =
      compare(balls_of({{0, 0, 0}, {0, 0, 0}, {0.1, 0, 0}}, {1.25, 1.25, 0.5}), {}, mesh, {.spacing = 2});
  EXPECT_EQ(more.surface_to_union.value, one.surface_to_union.value);
  EXPECT_EQ(more.union_to_surface.value, one.union_to_surface.value);
  EXPECT_EQ(more.coverage, one.coverage);
  EXPECT_EQ(more.union_volume, one.union_volume);
}

TEST(compare, accepts_points_flat_and_degenerate_input) {
  const Comparison point = compare(balls_of({{1, 2, 3}}, {0}), {{Vec3{1, 2, 3}}, {}}, {});
  EXPECT_EQ(point.hausdorff(), 0);
  EXPECT_EQ(point.union_volume, 0);
  EXPECT_EQ(point.coverage, 1);
  const TriangleMesh sliver{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 0, 0}}, {Triangle{0, 1, 2}}};
  const Comparison flat = compare(balls_of({{0.5, 0, 0}}, {0.75}), {}, sliver, {.spacing = 2});
  expect_within(flat.surface_to_union, 0.75);
  EXPECT_EQ(broken_invariant(flat), "");
}

TEST(compare, does_not_change_when_everything_is_scaled_by_a_power_of_two) {
  TriangleMesh large = cube();
  std::vector<Vec3> vertices;
  for (const Vec3& v : large.vertices) vertices.push_back(1024 * v);
  large.vertices = vertices;
  const Comparison a = compare(balls_of({{0.1, 0, 0}}, {1}), {}, cube(), {.spacing = 4});
  const Comparison b = compare(balls_of({{102.4, 0, 0}}, {1024}), {}, large, {.spacing = 4});
  EXPECT_NEAR(b.hausdorff(), 1024 * a.hausdorff(), 1e-9 * b.hausdorff());
  EXPECT_EQ(a.union_samples, b.union_samples);
  EXPECT_NEAR(a.coverage, b.coverage, 1e-9);
}

TEST(compare, gives_the_same_bits_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  std::mt19937 random(3);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < 300; ++i) {
    centers.push_back({unit(random), unit(random), unit(random)});
    radii.push_back(0.1 * unit(random));
  }
  const auto with_threads = [&](int threads) {
    return tbb::task_arena(threads).execute(
        [&] { return compare(balls_of(centers, radii), {}, cube(), {.spacing = 2}); });
  };
  const Comparison one = with_threads(1);
  for (const int threads : {2, 4}) {
    const Comparison many = with_threads(threads);
    EXPECT_EQ(many.surface_to_union.mean, one.surface_to_union.mean);
    EXPECT_EQ(many.union_to_surface.mean, one.union_to_surface.mean);
    EXPECT_EQ(many.union_volume, one.union_volume);
    EXPECT_EQ(many.coverage, one.coverage);
  }
}

/// The surface of [-1, 1]^3 and copies of it, scaled, moved, and turned inside out where `out` is false.
struct Copy {
  double scale = 1;
  Vec3 by;
  bool out = true;
};
TriangleMesh cubes(const std::vector<Copy>& copies) {
  const TriangleMesh one = cube();
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (const Copy& copy : copies) {
    const auto shift = static_cast<std::int32_t>(vertices.size());
    for (const Vec3& v : one.vertices) vertices.push_back(copy.scale * v + copy.by);
    for (const Triangle& t : one.triangles) {
      triangles.push_back({t[0] + shift, t[copy.out ? 1 : 2] + shift, t[copy.out ? 2 : 1] + shift});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(compare, surfaces_have_the_volume_of_the_inside_of_label_poles) {
  const auto volume = [](const TriangleMesh& mesh) {
    const Comparison c = compare(balls_of({{0, 0, 0}}, {1}), {}, mesh, {.spacing = 20});
    EXPECT_EQ(broken_invariant(c), "");
    EXPECT_EQ(c.surface_encloses, 1);
    return c.surface_volume;
  };
  EXPECT_NEAR(volume(cubes({{1, {}, false}})), 8, 1e-12);
  EXPECT_NEAR(volume(cubes({{1, {}, true}, {1, {3, 0, 0}, true}})), 16, 1e-12);
  EXPECT_NEAR(volume(cubes({{1, {}, true}, {1, {3, 0, 0}, false}})), 16, 1e-12) << "one of two is inside out";
  EXPECT_NEAR(volume(cubes({{1, {}, false}, {1, {3, 0, 0}, true}})), 16, 1e-12);
  EXPECT_NEAR(volume(cubes({{1, {}, true}, {0.5, {}, false}})), 7, 1e-12) << "a cavity";
  EXPECT_NEAR(volume(cubes({{1, {}, false}, {0.5, {}, true}})), 7, 1e-12);
  TriangleMesh mixed = cube();
  std::vector<Triangle> triangles(mixed.triangles.begin(), mixed.triangles.end());
  std::swap(triangles[5][0], triangles[5][1]);
  mixed.triangles = triangles;
  EXPECT_NEAR(volume(mixed), 8, 1e-12) << "one triangle is turned over";
  triangles.pop_back();
  mixed.triangles = triangles;
  const Comparison open = compare(balls_of({{0, 0, 0}}, {1}), {}, mixed, {.spacing = 20});
  EXPECT_EQ(open.surface_encloses, 0);
  EXPECT_EQ(open.surface_volume, 0);
}

TEST(compare, does_not_depend_on_the_order_of_balls_points_and_triangles) {
  std::mt19937 random(7);
  for (const bool cloud : {false, true}) {
    Balls balls, permuted;
    std::vector<Vec3> centers, points;
    std::vector<double> radii;
    for (int i = 0; i < 200; ++i) {
      centers.push_back({2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1});
      radii.push_back(0.1 + 0.5 * unit(random));
    }
    for (int i = 0; i < 500; ++i) points.push_back({unit(random), unit(random), unit(random)});
    const Comparison one =
        compare(balls_of(centers, radii), {points, {}}, cloud ? TriangleMesh{} : cube(), {.spacing = 1});
    std::vector<std::size_t> order(centers.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vec3> other_centers;
    std::vector<double> other_radii;
    for (const std::size_t i : order) {
      other_centers.push_back(centers[i]);
      other_radii.push_back(radii[i]);
    }
    std::shuffle(points.begin(), points.end(), random);
    TriangleMesh mesh = cloud ? TriangleMesh{} : cube();
    std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
    std::shuffle(triangles.begin(), triangles.end(), random);
    mesh.triangles = triangles;
    const Comparison other =
        compare(balls_of(other_centers, other_radii), {points, {}}, mesh, {.spacing = 1});
    const auto expect_same = [](const OneSidedDistance& a, const OneSidedDistance& b) {
      EXPECT_EQ(a.at_least, b.at_least);
      EXPECT_EQ(a.value, b.value);
      EXPECT_EQ(a.at_most, b.at_most);
      EXPECT_NEAR(a.mean, b.mean, 1e-13);
    };
    expect_same(one.surface_to_union, other.surface_to_union);
    expect_same(one.union_to_surface, other.union_to_surface);
    EXPECT_EQ(one.surface_samples, other.surface_samples);
    EXPECT_EQ(one.union_samples, other.union_samples);
    EXPECT_EQ(one.uncovered, other.uncovered);
    EXPECT_EQ(one.protrusion, other.protrusion);
    EXPECT_NEAR(one.coverage, other.coverage, 1e-13);
    EXPECT_NEAR(one.union_volume, other.union_volume, 1e-12);
  }
}

}  // namespace
}  // namespace ballflow::geometry
