// What is proven of the sum of two solids that balls stand for.
#include "minkowski/sum_of_solids.hpp"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "minkowski/sums.hpp"
#include "minkowski_cases.hpp"

namespace ballflow::geometry {
namespace {

using Rational = CGAL::Exact_rational;

/// Whether the ball `in` lies in the ball `around`, both of rational numbers.
struct RationalBall {
  Rational x, y, z, r;
};
bool lies_in(const RationalBall& in, const RationalBall& around) {
  const Rational x = in.x - around.x, y = in.y - around.y, z = in.z - around.z, room = around.r - in.r;
  return room >= 0 && x * x + y * y + z * z <= room * room;
}
RationalBall exact_sum(const Balls& a, std::size_t i, const Balls& b, std::size_t j) {
  const Vec3 p = a.centers[i], q = b.centers[j];
  return {Rational(p.x) + Rational(q.x), Rational(p.y) + Rational(q.y), Rational(p.z) + Rational(q.z),
          Rational(a.radii[i]) + Rational(b.radii[j])};
}
RationalBall rational(const Ball& ball) { return {ball.center.x, ball.center.y, ball.center.z, ball.radius}; }

Enclosure enclosing(double protrusion) {
  Enclosure e;
  e.balls = 1;
  e.triangles = 4;
  e.closed = 1;
  e.gap_at_most = 0;
  e.protrusion = protrusion;
  return e;
}

Enclosure inside(double gap) {
  Enclosure e = enclosing(0);
  e.open_triangles = {0};
  e.open_points = {{0, 0, 0}};
  e.open_why = {0};
  e.gap = 0.9 * gap;
  e.gap_at_most = gap;
  return e;
}

TEST(sum_of_solids, rounds_so_that_the_exact_sums_lie_in_the_balls_or_contain_them) {
  RandomBalls random(1);
  int moved = 0;
  for (int round = 0; round < 200; ++round) {
    // Of very different sizes and places, so that sums round much.
    Numbers a = random(6), b = random(6);
    const double far = random.below(2) == 0 ? 1 : 1e6;
    for (auto& ball : b) ball[0] += far / 3;
    const Balls of_a = balls_of(a), of_b = balls_of(b);
    const double by = rounding_of_sums(of_a, of_b);
    for (const SumMode mode : {SumMode::inner, SumMode::outer}) {
      const Balls moved_a = moved_radii(of_a, mode, by), moved_b = moved_radii(of_b, mode, by);
      if (moved_a.size() != of_a.size() || moved_b.size() != of_b.size()) continue;  // points, inwards
      for (std::size_t i = 0; i < of_a.size(); ++i) {
        for (std::size_t j = 0; j < of_b.size(); ++j) {
          const RationalBall exact = exact_sum(of_a, i, of_b, j);
          const RationalBall found = rational(Ball{moved_a.centers[i], moved_a.radii[i]} +
                                              Ball{moved_b.centers[j], moved_b.radii[j]});
          EXPECT_TRUE(mode == SumMode::outer ? lies_in(exact, found) : lies_in(found, exact));
          ++moved;
        }
      }
    }
  }
  EXPECT_GT(moved, 1000);
}

TEST(sum_of_solids, leaves_points_out_of_an_inner_sum_only) {
  const Balls points = balls_of({{0, 0, 0, 0}, {1, 0, 0, 0}}), ball = balls_of({{0, 0, 0, 1}});
  EXPECT_EQ(sum_of_solids(points, ball, SumMode::inner, {}, {}).balls.size(), 0u);
  EXPECT_EQ(sum_of_solids(points, ball, SumMode::outer, {}, {}).balls.size(), 2u);
  EXPECT_EQ(numbers_of(sum_of_solids(points, ball, SumMode::balanced, {}, {}).balls),
            numbers_of(minkowski_sum(points, ball).balls));
}

TEST(sum_of_solids, says_what_is_proven) {
  const Balls ball = balls_of({{0, 0, 0, 1}});
  const auto report = [&](SumMode mode, const Enclosure* a, const Enclosure* b) {
    const MinkowskiReport found = sum_of_solids(ball, ball, mode, {}, {.a = a, .b = b}).report;
    EXPECT_EQ(broken_invariant(found), "");
    return found;
  };
  const Enclosure around = enclosing(0.25), within = inside(0.5);

  const MinkowskiReport outer = report(SumMode::outer, &around, &around);
  EXPECT_TRUE(outer.contains());
  EXPECT_FALSE(outer.inside());
  EXPECT_EQ(outer.error_bound, 0);
  EXPECT_GE(outer.excess_bound, 0.5);
  EXPECT_LE(outer.excess_bound, 0.5 + 1e-12);
  EXPECT_EQ(proven_statement(outer).substr(0, 14), "contains A + B");
  EXPECT_EQ(why_not_one_sided(outer), "");

  const MinkowskiReport inner = report(SumMode::inner, &within, &within);
  EXPECT_TRUE(inner.inside());
  EXPECT_FALSE(inner.contains());
  EXPECT_EQ(inner.excess_bound, 0);
  EXPECT_GE(inner.error_bound, 1);
  EXPECT_LE(inner.error_bound, 1 + 1e-12);

  // An offset: the ball is exact.
  EXPECT_TRUE(report(SumMode::outer, &around, nullptr).contains());
  EXPECT_EQ(report(SumMode::outer, &around, nullptr).excess_bound,
            report(SumMode::outer, nullptr, &around).excess_bound);
  EXPECT_TRUE(report(SumMode::inner, nullptr, &within).inside());

  // Where it is not so.
  EXPECT_EQ(why_not_one_sided(report(SumMode::outer, &around, &within)), "balls do not enclose b");
  EXPECT_EQ(why_not_one_sided(report(SumMode::inner, &around, &within)), "balls reach out of a");
  EXPECT_EQ(why_not_one_sided(report(SumMode::balanced, &around, &around)),
            "mode balanced leaves either side open");
  EXPECT_EQ(why_not_one_sided(report(SumMode::outer, nullptr, nullptr)),
            "neither a nor b was compared with a solid");
  EXPECT_EQ(proven_statement(report(SumMode::outer, &around, &within)), "");
  EXPECT_EQ(report(SumMode::balanced, &within, &around).error_bound, 0.5);
  EXPECT_EQ(report(SumMode::balanced, &within, &around).excess_bound, 0.25);
}

TEST(sum_of_solids, claims_no_bound_for_points_and_open_meshes) {
  const Balls ball = balls_of({{0, 0, 0, 1}});
  const Enclosure around = enclosing(0.25);
  Enclosure sheet = around, cloud;
  sheet.closed = 0;
  cloud.balls = 1;
  for (const SumMode mode : {SumMode::balanced, SumMode::inner, SumMode::outer}) {
    for (const Enclosure* other : {&sheet, &cloud}) {
      const MinkowskiReport r = sum_of_solids(ball, ball, mode, {}, {.a = &around, .b = other}).report;
      EXPECT_EQ(broken_invariant(r), "");
      EXPECT_EQ(r.error_bound, -1);
      EXPECT_EQ(r.excess_bound, -1);
      // Balls that enclose an open mesh hold all it separates from infinity.
      EXPECT_EQ(r.contains(), mode == SumMode::outer && other == &sheet);
      EXPECT_FALSE(r.inside());
    }
  }
  const MinkowskiReport r = sum_of_solids(ball, ball, SumMode::inner, {}, {.a = &sheet, .b = &cloud}).report;
  EXPECT_EQ(why_not_one_sided(r), "there is no closed surface for balls to be inside of: a and b");
  EXPECT_EQ(why_not_one_sided(sum_of_solids(ball, ball, SumMode::outer, {}, {.a = &cloud}).report),
            "there is no proof that balls enclose a");
}

TEST(sum_of_solids, refuses_a_solid_without_balls_and_damage) {
  const Balls ball = balls_of({{0, 0, 0, 1}});
  Enclosure none = enclosing(0), damaged = enclosing(0);
  none.balls = 0;
  none.gap_at_most = -1;
  damaged.protrusion = -1;
  EXPECT_THROW(sum_of_solids({}, ball, SumMode::balanced, {}, {.a = &none}), InputError);
  EXPECT_THROW(sum_of_solids(ball, ball, SumMode::balanced, {}, {.b = &damaged}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
