#include "planar/disc_poles.hpp"

#include <gtest/gtest.h>

#include "planar/read_polygon.hpp"
#include "planar_cases.hpp"

namespace ballflow::geometry {
namespace {

using test::inside;
using test::rings_of;

Polygon2 generated(const char* name) { return read_polygon({std::string("polygon:") + name}).polygon; }

/// What must hold of the discs of any polygon: tried by brute force.
void expect_discs(const Polygon2& polygon, const DiscPolesOptions& options) {
  const DiscPoles discs = disc_poles(polygon, options);
  ASSERT_EQ(broken_invariant(discs.points), "");
  ASSERT_EQ(broken_invariant(discs.inner), "");
  ASSERT_EQ(broken_invariant(discs.outer), "");
  const auto rings = rings_of(polygon);
  const double size = bounding_box(polygon).longest_edge(), spacing = options.spacing / 100 * size,
               tiny = 1e-10 * size;
  for (const Vec3 p : discs.points.points) {
    ASSERT_EQ(p.z, 0);
    ASSERT_LT(test::distance_to_boundary(polygon, {p.x, p.y}), tiny);
  }
  std::vector<std::uint8_t> touched(discs.points.points.size());
  for (const Balls* balls : {&discs.inner, &discs.outer}) {
    const bool inner = balls == &discs.inner;
    for (std::size_t i = 0; i < balls->size(); ++i) {
      const Vec2 c{balls->centers[i].x, balls->centers[i].y};
      ASSERT_EQ(balls->centers[i].z, 0);
      ASSERT_GE(balls->samples_of(i).size(), 3u);
      for (const std::int32_t s : balls->samples_of(i)) {
        touched[static_cast<std::size_t>(s)] |= inner;
        ASSERT_NEAR(distance(discs.points.points[static_cast<std::size_t>(s)], balls->centers[i]),
                    balls->radii[i], 1e-9 * (balls->radii[i] + size));
      }
      for (const Vec3 p : discs.points.points)  // empty of samples: Voronoi vertices
        ASSERT_GT(distance(p, balls->centers[i]), balls->radii[i] * (1 - 1e-9) - tiny);
      if (test::distance_to_boundary(polygon, c) > tiny) {
        ASSERT_EQ(inside(rings, c), inner);
      }
    }
  }
  for (const std::uint8_t covered : touched) ASSERT_TRUE(covered) << "every sample is on an inner disc";
  if (options.vertices != DiscVertices::all) return;
  // The union of the inner discs contains the polygon and reaches out by half the spacing at most.
  const Box box = bounding_box(polygon);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p{box.lower.x + random.unit() * (box.upper.x - box.lower.x),
                 box.lower.y + random.unit() * (box.upper.y - box.lower.y)};
    const bool covered = test::in_a_disc(discs.inner, p);
    if (inside(rings, p)) {
      ASSERT_TRUE(covered || test::distance_to_boundary(polygon, p) < tiny) << p.x << " " << p.y;
    } else if (covered) {
      ASSERT_LE(test::distance_to_boundary(polygon, p), spacing / 2 + tiny);
    }
  }
}

TEST(disc_poles, of_a_square_by_its_corners_are_one_disc) {
  const DiscPoles discs = disc_poles(generated("square"), {.spacing = 100});
  ASSERT_EQ(discs.inner.size(), 1u);
  EXPECT_EQ(discs.inner.centers[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(discs.inner.radii[0], std::sqrt(2.0));
  EXPECT_EQ(discs.inner.samples_of(0).size(), 4u);
  EXPECT_EQ(discs.outer.size(), 0u);
  EXPECT_EQ(discs.splits, 0);
}

TEST(disc_poles, of_generated_polygons_are_as_promised) {
  for (const char* name : {"square", "regular?n=20", "star?n=7", "star?n=20&r=0.1", "gear", "frames?n=5",
                           "comb", "sqroot", "euro"}) {
    SCOPED_TRACE(name);
    for (const double spacing : {20.0, 3.0}) {
      expect_discs(generated(name), {.spacing = spacing});
      expect_discs(generated(name), {.spacing = spacing, .vertices = DiscVertices::poles});
    }
  }
}

TEST(disc_poles, of_random_polygons_with_holes_are_as_promised) {
  Random random(3);
  for (int round = 0; round < 30; ++round) {
    SCOPED_TRACE(round);
    expect_discs(test::random_polygon(random), {.spacing = 10});
    if (HasFatalFailure()) return;
  }
}

TEST(disc_poles, end_at_sharp_corners_and_thin_walls) {
  // Edges that meet at a degree and less, and walls a thousandth of the spacing thick.
  expect_discs(test::polygon_of({test::ring({{0, 0}, {100, 0}, {100, 1}})}), {.spacing = 20});
  expect_discs(test::polygon_of({test::ring({{0, 0}, {100, 0}, {100, 0.3}})}), {.spacing = 20});
  const auto box = [](double low, double high) {
    return test::ring({{low, low}, {high, low}, {high, high}, {low, high}});
  };
  expect_discs(test::polygon_of({box(0, 1), box(0.01, 0.99), box(0.02, 0.98)}), {.spacing = 10});
}

TEST(disc_poles, do_not_depend_on_where_a_ring_begins_but_for_numbers) {
  const Polygon2 gear = generated("gear");
  const DiscPoles one = disc_poles(gear, {.spacing = 2});
  auto rings = rings_of(gear);
  for (auto& r : rings) std::rotate(r.begin(), r.begin() + 3, r.end());
  const DiscPoles other =
      disc_poles(test::polygon_of({test::ring(rings[0]), test::ring(rings[1])}), {.spacing = 2});
  const auto sorted = [](const Balls& balls) {
    std::vector<std::pair<double, double>> all;
    for (std::size_t i = 0; i < balls.size(); ++i)
      all.emplace_back(std::round(1e9 * balls.radii[i]), std::round(1e9 * std::abs(balls.centers[i].x)));
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(one.points.points.size(), other.points.points.size());
  EXPECT_EQ(sorted(one.inner).size(), sorted(other.inner).size());
}

TEST(disc_poles, refuse_what_has_no_inside) {
  EXPECT_THROW(disc_poles({{}, {0}, {0}}), InputError);
  EXPECT_THROW(disc_poles({}), InputError);
  EXPECT_THROW(disc_poles(generated("square"), {.spacing = 0}), InputError);
  EXPECT_THROW(disc_poles(generated("square"), {.spacing = NAN}), InputError);
  // 1e15 away from the origin coordinates are multiples of 1/8.
  EXPECT_THROW(
      disc_poles(test::polygon_of({test::ring({{1e15, 0}, {1e15 + 4, 0}, {1e15 + 4, 4}})}), {.spacing = 0.1}),
      InputError);
}

}  // namespace
}  // namespace ballflow::geometry
