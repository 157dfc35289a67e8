#include "planar/disc_union_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "planar_cases.hpp"
#include "power/union_betti.hpp"

namespace ballflow::geometry {
namespace {

constexpr double full = 6.283185307179586;
using Discs = std::vector<std::array<double, 3>>;

Balls in_plane(const Discs& discs) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const auto& [x, y, r] : discs) {
    centers.push_back({x, y, 0});
    radii.push_back(r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

DiscOutline outline_of(const Discs& discs) {
  DiscOutline outline = disc_union_outline(in_plane(discs));
  EXPECT_EQ(broken_invariant(outline), "");
  return outline;
}

struct Measures {
  double area = 0, perimeter = 0;
};

/// From the angles of every circle that no other disc covers, compared one by one.
Measures by_angles(Discs discs) {
  std::sort(discs.begin(), discs.end());
  discs.erase(std::unique(discs.begin(), discs.end()), discs.end());
  Measures sum;
  for (const auto& [x, y, r] : discs) {
    std::vector<std::pair<double, double>> covered;
    bool whole = r == 0;
    for (const auto& [u, v, s] : discs) {
      const double d = std::hypot(u - x, v - y);
      if ((d == 0 && r == s) || d >= r + s) continue;
      if (d + r <= s) whole = true;
      if (d + r <= s || d + s <= r) continue;
      const double toward = std::atan2(v - y, u - x),
                   half = std::acos(std::clamp((d * d + r * r - s * s) / (2 * d * r), -1.0, 1.0));
      const double low = toward - half, high = toward + half;
      for (const double shift : {-full, 0.0, full}) covered.emplace_back(low + shift, high + shift);
    }
    if (whole) continue;
    std::sort(covered.begin(), covered.end());
    const auto add = [&, x = x, y = y, r = r](double from, double to) {
      if (to <= from) return;
      sum.perimeter += r * (to - from);
      sum.area +=
          0.5 * r *
          (r * (to - from) + x * (std::sin(to) - std::sin(from)) - y * (std::cos(to) - std::cos(from)));
    };
    double at = 0;
    for (const auto& [low, high] : covered) {
      add(at, std::min(low, full));
      at = std::max(at, high);
      if (at >= full) break;
    }
    add(at, full);
  }
  return sum;
}

/// Independent facts about any set: area, perimeter, components and holes.
void expect_outline(const Discs& discs, double tolerance = 1e-9) {
  const DiscOutline outline = outline_of(discs);
  const Measures expected = by_angles(discs);
  ASSERT_NEAR(area(outline), expected.area, tolerance);
  ASSERT_NEAR(perimeter(outline), expected.perimeter, tolerance);
  for (std::size_t k = 0; k < outline.components(); ++k) {
    for (std::int64_t i = outline.component_offsets[k]; i < outline.component_offsets[k + 1]; ++i) {
      const double size = signed_area(outline, static_cast<std::size_t>(i));
      ASSERT_TRUE(i == outline.component_offsets[k] ? size > 0 : size < tolerance) << size;
    }
  }
}

TEST(disc_union_outline, of_one_disc_is_its_circle) {
  const DiscOutline outline = outline_of({{1, 2, 3}});
  ASSERT_EQ(outline.rings(), 1u);
  EXPECT_EQ(outline.arc_angles[0], full);
  EXPECT_EQ(outline.arc_begins[0], (Vec2{4, 2}));
  EXPECT_NEAR(area(outline), full / 2 * 9, 1e-12);
  EXPECT_NEAR(perimeter(outline), full * 3, 1e-12);
}

TEST(disc_union_outline, leaves_out_points_and_what_is_inside) {
  EXPECT_EQ(outline_of({}).rings(), 0u);
  EXPECT_EQ(outline_of({{1, 1, 0}}).rings(), 0u);
  EXPECT_EQ(outline_of({{0, 0, 2}, {0, 0, 2}, {0.5, 0, 1}, {1, 0, 1}, {0, 0, 1}, {5, 5, 0}}).arc_discs.size(),
            1u);
}

TEST(disc_union_outline, of_two_discs_has_two_arcs_that_share_their_ends) {
  const DiscOutline outline = outline_of({{0, 0, 1}, {1, 0, 1}});
  ASSERT_EQ(outline.arc_discs.size(), 2u);
  EXPECT_NEAR(outline.arc_angles[0], full * 2 / 3, 1e-14);
  EXPECT_NEAR(area(outline), full - (full / 3 - std::sqrt(0.75)), 1e-13);
  EXPECT_NEAR(outline.arc_begins[0].x, 0.5, 1e-15);
  EXPECT_NEAR(outline.arc_begins[0].y, std::sqrt(0.75), 1e-15);
}

TEST(disc_union_outline, joins_discs_that_touch) {
  const DiscOutline outline = outline_of({{0, 0, 1}, {2, 0, 1}});
  EXPECT_EQ(outline.components(), 1u);
  EXPECT_EQ(outline.rings(), 1u);
  EXPECT_NEAR(area(outline), full, 1e-13);
  EXPECT_EQ(outline_of({{0, 0, 1}, {std::nextafter(2, 3), 0, 1}}).components(), 2u);
}

TEST(disc_union_outline, knows_holes_and_what_lies_in_them) {
  Discs ring;
  for (int k = 0; k < 12; ++k)
    ring.push_back({5 * std::cos(k * full / 12), 5 * std::sin(k * full / 12), 1.5});
  DiscOutline outline = outline_of(ring);
  EXPECT_EQ(outline.components(), 1u);
  EXPECT_EQ(outline.rings(), 2u);
  expect_outline(ring);
  ring.insert(ring.begin(), {0, 0, 1});
  outline = outline_of(ring);
  EXPECT_EQ(outline.components(), 2u);
  EXPECT_EQ(outline.rings(), 3u);
  EXPECT_NEAR(signed_area(outline, 0), full / 2, 1e-13) << "the first disc comes first";
}

TEST(disc_union_outline, of_discs_on_a_line_and_on_a_grid) {
  Discs line;
  for (int k = 0; k < 9; ++k) line.push_back({3.0 * k, 1.0 * k, 1.0 + k % 3});
  expect_outline(line);
  // Four circles through one point: with r = sqrt(1/2) of whole weight nothing is open between them.
  Discs grid;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) grid.push_back({1.0 * x, 1.0 * y, 0.5});
  }
  EXPECT_EQ(outline_of(grid).components(), 1u) << "they touch";
  EXPECT_EQ(outline_of(grid).rings(), 17u) << "a hole between each four";
  expect_outline(grid);
  for (auto& disc : grid) disc[2] = 0.625;
  EXPECT_EQ(outline_of(grid).rings(), 17u);
  expect_outline(grid);
  for (auto& disc : grid) disc[2] = 0.75;
  EXPECT_EQ(outline_of(grid).rings(), 1u);
  expect_outline(grid);
}

TEST(disc_union_outline, has_the_area_and_topology_of_random_unions) {
  Random random(5);
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE(round);
    const bool grid = round % 3 == 0;
    Discs discs(1 + random.bits() % 40);
    for (auto& [x, y, r] : discs) {
      const auto whole = [&](unsigned n) { return static_cast<double>(random.bits() % n); };
      x = grid ? whole(6) : 6 * random.unit();
      y = grid ? whole(6) : 6 * random.unit();
      r = grid ? 0.5 * whole(4) : random.unit();
    }
    expect_outline(discs, 1e-7);  // by angles a touching circle is wrong by the root of a rounding error
    if (HasFatalFailure()) return;
    const DiscOutline outline = outline_of(discs);
    // Points are components without an outline: lifted out, so that Betti numbers are of what has one.
    Discs round_ones;
    for (const auto& disc : discs) {
      if (disc[2] > 0) round_ones.push_back(disc);
    }
    const auto betti = round_ones.empty()
                           ? std::array<std::int64_t, 3>{}
                           : union_betti(in_plane(round_ones), AlphaTolerance::none, no_monitor());
    ASSERT_EQ(static_cast<std::int64_t>(outline.components()), betti[0]);
    ASSERT_EQ(static_cast<std::int64_t>(outline.rings() - outline.components()), betti[1]);
  }
}

TEST(disc_union_outline, does_not_depend_on_the_order_of_the_discs) {
  Random random(6);
  for (int round = 0; round < 100; ++round) {
    Discs discs(30);
    for (auto& [x, y, r] : discs) {
      x = round % 2 == 0 ? static_cast<double>(random.bits() % 5) : 5 * random.unit();
      y = round % 2 == 0 ? static_cast<double>(random.bits() % 5) : 5 * random.unit();
      r = round % 2 == 0 ? 0.5 * static_cast<double>(1 + random.bits() % 2) : random.unit();
    }
    const DiscOutline one = outline_of(discs);
    Discs turned = discs;
    std::reverse(turned.begin(), turned.end());
    const DiscOutline other = outline_of(turned);
    const auto arcs = [](const DiscOutline& o) {
      std::vector<std::tuple<Vec2, double, double>> all;
      for (std::size_t i = 0; i < o.arc_discs.size(); ++i) {
        const Vec2 c = o.centers[static_cast<std::size_t>(o.arc_discs[i])], p = o.arc_begins[i];
        all.emplace_back(c, std::round(1e9 * p.x), std::round(1e7 * o.arc_angles[i]));
      }
      std::sort(all.begin(), all.end());
      return all;
    };
    ASSERT_EQ(one.components(), other.components());
    ASSERT_EQ(one.rings(), other.rings());
    ASSERT_EQ(arcs(one).size(), arcs(other).size());
  }
}

TEST(disc_union_outline, polygons_are_inside_and_as_near_as_they_say) {
  Random random(7);
  for (int round = 0; round < 6; ++round) {
    Discs discs(40);
    for (auto& [x, y, r] : discs) x = 6 * random.unit(), y = 6 * random.unit(), r = 0.2 + random.unit() / 2;
    const DiscOutline outline = outline_of(discs);
    const Balls balls = in_plane(discs);
    for (const double error : {0.1, 0.001}) {
      const Polygon2 polygon = polygon_in(outline, error);
      ASSERT_EQ(broken_invariant(polygon), "");
      // Simple, and holes are holes: else this throws.
      std::vector<RawRing> raw;
      for (const test::Points& points : test::rings_of(polygon)) raw.push_back(test::ring(points));
      const Polygon2 nested = test::polygon_of(raw);
      ASSERT_EQ(nested.components(), polygon.components());
      ASSERT_EQ(polygon.rings(), outline.rings());
      ASSERT_LE(area(polygon), area(outline) + 1e-12);
      ASSERT_GE(area(polygon), area(outline) - error * perimeter(outline));
      for (const test::Points& points : test::rings_of(polygon)) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          const Vec2 a = points[i], b = points[(i + 1) % points.size()];
          for (const double part : {0.001, 0.5, 0.999})
            ASSERT_TRUE(test::in_a_disc(balls, a + part * (b - a)));
        }
      }
      for (std::size_t ring = 0; ring < outline.rings(); ++ring) {
        for (const Vec2 p : points_on_ring(outline, ring, error / 10))
          ASSERT_LE(test::distance_to_boundary(polygon, p), error * (1 + 1e-9));
      }
    }
  }
}

TEST(disc_union_outline, decides_exactly_what_rounding_hides) {
  // Three circles that leave a hole between them, or not, by the last bit of a radius.
  const double r = 1 / std::sqrt(3.0);
  for (const double radius : {std::nextafter(r, 0), r, std::nextafter(r, 1)}) {
    const Discs three{{0, 0, radius}, {1, 0, radius}, {0.5, std::sqrt(0.75), radius}};
    const auto betti = union_betti(in_plane(three), AlphaTolerance::none, no_monitor());
    EXPECT_EQ(static_cast<std::int64_t>(outline_of(three).rings()), 1 + betti[1]);
  }
  // Far from the origin, and of any size.
  for (const double scale : {1e-140, 1.0, 1e140}) {
    EXPECT_EQ(outline_of({{0, 0, scale}, {scale, 0, scale}, {0, scale, scale}}).arc_discs.size(), 3u);
  }
  EXPECT_EQ(outline_of({{1e9, 1e9, 1e-3}, {1e9 + 1e-3, 1e9, 1e-3}}).arc_discs.size(), 2u);
}

TEST(disc_union_outline, refuses_balls_in_space) {
  Balls balls = in_plane({{0, 0, 1}});
  balls.centers = {{0, 0, 1}};
  EXPECT_THROW(disc_union_outline(balls), InputError);
  EXPECT_THROW(disc_union_outline(in_plane({{0, 0, 1e-200}})), InputError);
  EXPECT_THROW(disc_union_outline(in_plane({{0, 0, -1}})), InputError);
  EXPECT_THROW(disc_union_outline(in_plane({{NAN, 0, 1}})), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
