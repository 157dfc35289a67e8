#include "planar/ring_nesting.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "planar_cases.hpp"

namespace ballflow::geometry {
namespace {

using test::Points;
using test::ring;

const Points square{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole{{1, 1}, {1, 5}, {5, 5}, {5, 1}},
    island{{2, 2}, {3, 2}, {3, 3}}, aside{{20, 0}, {21, 0}, {20, 1}};

std::string refusal(std::vector<RawRing> rings) {
  try {
    nest(std::move(rings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ring_nesting, turns_outer_rings_to_the_left_and_holes_to_the_right) {
  for (const bool forward : {true, false}) {
    Points outer = square, inner = hole;
    if (!forward) {
      std::reverse(outer.begin(), outer.end());
      std::reverse(inner.begin(), inner.end());
    }
    const NestedRings nested = nest({ring(outer), ring(inner)});
    ASSERT_EQ(broken_invariant(nested.polygon), "");
    ASSERT_EQ(nested.polygon.components(), 1u);
    ASSERT_EQ(nested.polygon.rings(), 2u);
    EXPECT_EQ(signed_area(nested.polygon.ring(0)), 81);
    EXPECT_EQ(signed_area(nested.polygon.ring(1)), -16);
    EXPECT_EQ(area(nested.polygon), 65);
    EXPECT_EQ(perimeter(nested.polygon), 52);
    EXPECT_EQ(nested.polygon.ring(0)[0], outer[0]) << "the first point stays";
    EXPECT_EQ(nested.turned_rings, forward ? 0 : 2);
  }
}

TEST(ring_nesting, makes_what_lies_in_a_hole_a_component) {
  const Polygon2 polygon = test::polygon_of({ring(island), ring(aside), ring(hole), ring(square)});
  ASSERT_EQ(polygon.components(), 3u);
  EXPECT_EQ(polygon.ring(0)[0], island[0]);
  EXPECT_EQ(polygon.ring(1)[0], aside[0]);
  EXPECT_EQ(polygon.ring(2)[0], square[0]);
  EXPECT_EQ(polygon.ring(3)[0], hole[0]);
}

TEST(ring_nesting, leaves_repeated_and_closing_points_out) {
  const NestedRings nested = nest({ring({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 0}})});
  EXPECT_EQ(nested.polygon.vertices.size(), 3u);
  EXPECT_EQ(nested.repeated_points, 4);
  EXPECT_EQ(nest({ring({{-0.0, 0}, {1, 0}, {0, 1}, {0, -0.0}})}).polygon.vertices.size(), 3u);
}

TEST(ring_nesting, keeps_points_on_straight_edges) {
  EXPECT_EQ(nest({ring({{0, 0}, {1, 0}, {2, 0}, {2, 2}})}).polygon.vertices.size(), 4u);
}

TEST(ring_nesting, names_what_is_wrong_and_where) {
  const auto has = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  has(refusal({ring({{0, 0}, {2, 2}, {2, 0}, {0, 2}})}), "cross at (1, 1)");
  has(refusal({ring(square), ring({{4, 4}, {12, 5}, {12, 4}})}), "cross at (9,");
  has(refusal({ring(square), ring({{9, 4}, {12, 5}, {12, 4}})}), "touch at (9, 4)");
  has(refusal({ring(square), ring({{9, 9}, {12, 10}, {12, 9}})}), "touch at (9, 9)");
  has(refusal({ring({{0, 0}, {4, 0}, {2, 0}, {2, 3}})}), "touch at");
  has(refusal({ring({{0, 0}, {4, 0}, {2, 0}})}), "touch at");
  has(refusal({ring({{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}})}), "touches itself at (2, 2)");
  has(refusal({ring(square), ring(square)}), "touch at");
  has(refusal({ring({{0, 0}, {1, 0}, {1, 0}})}), "2 distinct points");
  has(refusal({ring({})}), "0 distinct points");
  has(refusal({ring({{0, 0}, {1, 0}, {1, NAN}})}), "point 2 of");
  has(refusal({ring({{0, 0}, {1, 0}, {1, INFINITY}})}), "finite");
  has(refusal({ring(square, RingRole::outer), ring(aside, RingRole::hole)}),
      "is a hole, and lies in no ring");
  has(refusal({ring(square, RingRole::outer), ring(hole, RingRole::outer)}),
      "is an outer ring, and lies inside");
}

TEST(ring_nesting, decides_where_doubles_do_not) {
  // The line through (0, 0) and far is a third of an ulp of 1 above 1/3 at 1, between the first and the
  // second double above the one next to 1/3.
  const double third = 1.0 / 3, between = std::nextafter(third, 1);
  const Vec2 far{3, std::nextafter(1.0, 2)};
  const Points low{{0, 0}, far, {3, -1}};
  EXPECT_EQ(refusal({ring(low), ring({{1, std::nextafter(between, 1)}, {2, 2}, {1, 2}})}), "");
  EXPECT_NE(refusal({ring(low), ring({{1, between}, {2, 2}, {1, 2}})}), "");
}

TEST(ring_nesting, finds_every_common_point_that_comparing_all_edges_finds) {
  Random random(5);
  int refused = 0, nested_inside = 0;
  for (int round = 0; round < 30'000; ++round) {
    std::vector<Points> rings(1 + random.bits() % 3);
    const std::uint64_t size = 3 + random.bits() % 8;
    const auto far = static_cast<double>(size);
    if (random.bits() % 2 == 0) rings[0] = {{-1, -1}, {far, -1}, {far, far}, {-1, far}};
    for (Points& points : rings) {
      const std::size_t n = 3 + random.bits() % 4;
      while (points.size() < n && (points.empty() || points[0].x >= 0)) {
        const Vec2 p{static_cast<double>(random.bits() % size), static_cast<double>(random.bits() % size)};
        if (points.empty() || (points.back() != p && (points.size() + 1 < n || points.front() != p)))
          points.push_back(p);
      }
    }
    struct Edge {
      Vec2 a, b;
      std::size_t ring, number, count;
    };
    std::vector<Edge> edges;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t i = 0; i < rings[r].size(); ++i)
        edges.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], r, i, rings[r].size()});
    }
    bool common = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Edge &e = edges[i], &f = edges[j];
        const bool after = e.ring == f.ring && (f.number + 1) % f.count == e.number,
                   before = e.ring == f.ring && (e.number + 1) % e.count == f.number;
        if (after || before) {
          const Edge &first = after ? f : e, &second = after ? e : f;
          common = common || (test::turn(first.a, first.b, second.b) == 0 &&
                              dot(first.a - first.b, second.b - first.b) > 0);
        } else {
          common = common || test::share_a_point(e.a, e.b, f.a, f.b);
        }
      }
    }
    std::vector<RawRing> raw;
    for (const Points& points : rings) raw.push_back(ring(points));
    std::optional<Polygon2> polygon;
    try {
      polygon = test::polygon_of(raw);
    } catch (const InputError&) {
    }
    ASSERT_EQ(!polygon, common) << "round " << round;
    if (!polygon) {
      ++refused;
      continue;
    }
    ASSERT_EQ(broken_invariant(*polygon), "");
    // Each ring's depth, by rays from a point of it.
    std::size_t holes = 0;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      std::vector<Points> others;
      for (std::size_t s = 0; s < rings.size(); ++s) {
        if (s != r) others.push_back(rings[s]);
      }
      holes += test::inside(others, rings[r][0]);
    }
    ASSERT_EQ(polygon->rings() - polygon->components(), holes) << "round " << round;
    nested_inside += holes != 0;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 29'000);
  EXPECT_GT(nested_inside, 20);
}

TEST(ring_nesting, takes_a_million_points) {
  Points points;
  for (int i = 0; i < 500'000; ++i) points.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 1.0});
  for (int i = 500'000; i-- > 0;) points.push_back({static_cast<double>(i), i % 2 == 0 ? 2.0 : 3.0});
  const NestedRings nested = nest({ring(points)});
  EXPECT_EQ(nested.polygon.vertices.size(), 1'000'000u);
  EXPECT_EQ(area(nested.polygon), 2 * 499'999.0);
}

}  // namespace
}  // namespace ballflow::geometry
