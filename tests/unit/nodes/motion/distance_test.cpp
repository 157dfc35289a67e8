#include "motion/distance.hpp"

#include <CGAL/CORE_Expr.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "exact/separation.hpp"

namespace ballflow::geometry {
namespace {

Balls balls_of(const std::vector<std::array<double, 4>>& numbers) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const auto& [x, y, z, r] : numbers) {
    centers.push_back({x, y, z});
    radii.push_back(r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

/// All pairs in order, by the exact signs of CORE.
struct Pair {
  CORE::Expr separation;
  std::int32_t a, b;
};
std::vector<Pair> all_pairs(const Balls& a, const Balls& b) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const auto square = [](double u, double v) {
        const CORE::Expr edge = CORE::Expr(u) - CORE::Expr(v);
        return edge * edge;
      };
      const Vec3 p = a.centers[i], q = b.centers[j];
      pairs.push_back({sqrt(square(p.x, q.x) + square(p.y, q.y) + square(p.z, q.z)) - CORE::Expr(a.radii[i]) -
                           CORE::Expr(b.radii[j]),
                       static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    const int sign = (p.separation - q.separation).sign();
    return sign != 0 ? sign < 0 : p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  return pairs;
}

/// The distance is what looking at all pairs says.
void expect_as_all_pairs(const Balls& a, const Balls& b, double threshold, std::int64_t most) {
  const BallDistance d =
      ball_distance(a, b, {.threshold = threshold, .most_pairs = most, .every_ball = true}, no_monitor());
  ASSERT_EQ(broken_invariant(d), "");
  const std::vector<Pair> all = all_pairs(a, b);
  EXPECT_EQ(d.a, all.front().a);
  EXPECT_EQ(d.b, all.front().b);
  EXPECT_EQ(d.separation > 0, all.front().separation.sign() > 0);
  EXPECT_EQ(d.separation < 0, all.front().separation.sign() < 0);
  EXPECT_NEAR(d.separation, all.front().separation.doubleValue(), 1e-15 * (1 + std::abs(d.separation)));

  std::vector<Pair> below;
  for (const Pair& pair : all) {
    if ((pair.separation - CORE::Expr(threshold)).sign() <= 0) below.push_back(pair);
  }
  EXPECT_EQ(d.cut != 0, below.size() > static_cast<std::size_t>(most));
  ASSERT_EQ(d.pairs.size(), std::min(below.size(), static_cast<std::size_t>(most)));
  for (std::size_t i = 0; i < d.pairs.size(); ++i) {
    EXPECT_EQ(d.pairs[i][0], below[i].a) << i;
    EXPECT_EQ(d.pairs[i][1], below[i].b) << i;
    const double gap = distance(d.pair_points_a[i], d.pair_points_b[i]);
    EXPECT_NEAR(gap, std::abs(d.separations[i]), 1e-13) << i;
  }

  // The first pair of every ball, in this order, is its nearest.
  std::vector<bool> seen_a(a.size()), seen_b(b.size());
  for (const Pair& pair : all) {
    const auto i = static_cast<std::size_t>(pair.a), j = static_cast<std::size_t>(pair.b);
    if (!seen_a[i]) {
      EXPECT_EQ(d.nearest_a[i], pair.b) << "ball " << i << " of a";
      EXPECT_NEAR(d.clearances_a[i], pair.separation.doubleValue(), 1e-14);
    }
    if (!seen_b[j]) {
      EXPECT_EQ(d.nearest_b[j], pair.a) << "ball " << j << " of b";
      EXPECT_NEAR(d.clearances_b[j], pair.separation.doubleValue(), 1e-14);
    }
    seen_a[i] = seen_b[j] = true;
  }
}

std::array<double, 4> lattice_ball(std::mt19937& random) {
  std::uniform_int_distribution<int> coordinate(-1, 2), radius(0, 2);
  return {1.0 * coordinate(random), 1.0 * coordinate(random), 1.0 * coordinate(random), 0.5 * radius(random)};
}
std::array<double, 4> free_ball(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0, 1);
  return {4 * u(random), 4 * u(random), 4 * u(random), 0.4 * u(random)};
}

template <class MakeBall>
Balls some(std::mt19937& random, std::size_t n, MakeBall make) {
  std::vector<std::array<double, 4>> numbers;
  for (std::size_t i = 0; i < n; ++i) numbers.push_back(make(random));
  return balls_of(numbers);
}

TEST(distance, of_free_balls_is_the_smallest_of_all_pairs) {
  std::mt19937 random(5);
  for (std::size_t n = 1; n <= 30; ++n) {
    const Balls a = some(random, n, free_ball), b = some(random, 31 - n, free_ball);
    expect_as_all_pairs(a, b, 0.5, 20);
    expect_as_all_pairs(a, b, -0.1, 1000);
  }
}

TEST(distance, of_balls_on_a_lattice_takes_the_lowest_of_many_equal_pairs) {
  std::mt19937 random(9);
  for (std::size_t n = 1; n <= 40; n += 3) {
    const Balls a = some(random, n, lattice_ball), b = some(random, 42 - n, lattice_ball);
    for (const std::int64_t most : {0, 1, 7, 2000}) {
      for (const double threshold : {-0.5, 0.0, 1.0}) expect_as_all_pairs(a, b, threshold, most);
    }
  }
}

TEST(distance, of_equal_and_concentric_balls_is_that_of_the_first) {
  std::vector<std::array<double, 4>> equal(60, {1, 2, 3, 0.5}), concentric;
  for (int i = 0; i < 40; ++i) concentric.push_back({1, 2, 3, 0.125 * (i % 7)});
  expect_as_all_pairs(balls_of(equal), balls_of(equal), 0, 5);
  expect_as_all_pairs(balls_of(equal), balls_of(equal), 0, 3000);
  expect_as_all_pairs(balls_of(concentric), balls_of(equal), 0, 50);
  expect_as_all_pairs(balls_of(concentric), balls_of(concentric), 0, 11);
}

TEST(distance, of_a_million_equal_balls_does_not_look_at_all_pairs) {
  const std::size_t n = 1000000;
  const Balls equal{std::vector<Vec3>(n, {1, 2, 3}), std::vector<double>(n, 0.5), {}, {}};
  const BallDistance d = ball_distance(equal, equal, {.every_ball = true}, no_monitor());
  EXPECT_EQ(d.separation, -1);
  EXPECT_EQ(d.a, 0);
  EXPECT_EQ(d.b, 0);
  ASSERT_EQ(d.pairs.size(), 1000u);
  for (std::int32_t i = 0; i < 1000; ++i)
    EXPECT_EQ(d.pairs[static_cast<std::size_t>(i)], (std::array<std::int32_t, 2>{0, i}));
  EXPECT_EQ(d.cut, 1);
  EXPECT_EQ(d.nearest_a[n - 1], 0);
}

TEST(distance, is_zero_where_balls_touch_exactly_and_of_the_right_sign_beside_it) {
  const auto separation = [](double r) {
    return ball_distance(balls_of({{0, 0, 0, 2}}), balls_of({{3, 4, 0, r}}), {}, no_monitor()).separation;
  };
  EXPECT_EQ(separation(3), 0);
  EXPECT_GT(separation(std::nextafter(3, 0)), 0);
  EXPECT_LT(separation(std::nextafter(3, 4)), 0);
  const BallDistance d = ball_distance(balls_of({{0, 0, 0, 2}}), balls_of({{3, 4, 0, 3}}), {}, no_monitor());
  EXPECT_EQ(describe(d), "touching (ball 0 of a, ball 0 of b)");
  ASSERT_EQ(d.pairs.size(), 1u);
  EXPECT_NEAR(d.point_a.x, 1.2, 1e-15);
  EXPECT_NEAR(d.point_a.y, 1.6, 1e-15);
}

TEST(distance, of_concentric_balls_has_points_as_far_apart_as_they_overlap) {
  const BallDistance d =
      ball_distance(balls_of({{1, 1, 1, 2}}), balls_of({{1, 1, 1, 0.5}}), {}, no_monitor());
  EXPECT_EQ(d.separation, -2.5);
  EXPECT_EQ(distance(d.point_a, d.point_b), 2.5);
}

TEST(distance, of_points_is_the_distance_of_the_nearest) {
  std::mt19937 random(2);
  std::vector<std::array<double, 4>> a, b;
  for (int i = 0; i < 300; ++i) a.push_back(free_ball(random)), b.push_back(free_ball(random));
  double least = std::numeric_limits<double>::infinity();
  for (auto& p : a) p[3] = 0;
  for (auto& q : b) q[3] = 0;
  for (const auto& p : a) {
    for (const auto& q : b) least = std::min(least, distance({p[0], p[1], p[2]}, {q[0], q[1], q[2]}));
  }
  EXPECT_NEAR(ball_distance(balls_of(a), balls_of(b), {}, no_monitor()).separation, least, 1e-15);
}

TEST(distance, is_the_same_for_any_number_of_threads) {
  std::mt19937 random(4);
  const Balls a = some(random, 5000, free_ball), b = some(random, 7000, free_ball);
  const DistanceOptions options{.threshold = 0.1, .most_pairs = 500, .every_ball = true};
  const BallDistance many = ball_distance(a, b, options, no_monitor());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BallDistance single = ball_distance(a, b, options, no_monitor());
  EXPECT_EQ(many.pairs, single.pairs);
  EXPECT_EQ(many.separations, single.separations);
  EXPECT_EQ(many.pair_points_a, single.pair_points_a);
  EXPECT_EQ(many.nearest_a, single.nearest_a);
  EXPECT_EQ(many.nearest_b, single.nearest_b);
  EXPECT_EQ(many.clearances_a, single.clearances_a);
  EXPECT_EQ(many.a, single.a);
  EXPECT_EQ(many.b, single.b);
}

TEST(distance, finds_a_far_ball_among_balls_that_the_space_order_cannot_tell_apart) {
  std::mt19937 random(6);
  std::vector<std::array<double, 4>> a, b;
  for (int i = 0; i < 2000; ++i) a.push_back(free_ball(random)), b.push_back(free_ball(random));
  for (auto& q : b) q[0] += 5;
  const BallDistance near = ball_distance(balls_of(a), balls_of(b), {.threshold = 0.8}, no_monitor());
  a.push_back({1e9, 0, 0, 1});
  b.push_back({0, -1e9, 0, 1});
  const BallDistance far = ball_distance(balls_of(a), balls_of(b), {.threshold = 0.8}, no_monitor());
  EXPECT_EQ(near.a, far.a);
  EXPECT_EQ(near.b, far.b);
  EXPECT_EQ(near.separation, far.separation);
  EXPECT_EQ(near.pairs, far.pairs);
  EXPECT_GT(near.pairs.size(), 0u);
}

std::string refusal(const Balls& a, const Balls& b, const DistanceOptions& options = {},
                    const SolidsOfBalls& s = {}) {
  try {
    ball_distance(a, b, options, no_monitor(), s);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(distance, of_no_balls_is_refused_by_name) {
  const Balls none, one = balls_of({{0, 0, 0, 1}});
  EXPECT_NE(refusal(none, one).find("a has no balls"), std::string::npos);
  EXPECT_NE(refusal(one, none).find("b has no balls"), std::string::npos);
}

TEST(distance, of_numbers_that_are_none_or_too_large_is_refused_with_the_ball) {
  const Balls one = balls_of({{0, 0, 0, 1}});
  EXPECT_NE(refusal(one, balls_of({{0, 0, 0, 1}, {0, NAN, 0, 1}})).find("ball 1"), std::string::npos);
  EXPECT_NE(refusal(one, balls_of({{0, 0, 0, 1}, {0, 2e140, 0, 1}})).find("ball 1 of b"), std::string::npos);
  EXPECT_NE(refusal(balls_of({{0, 0, 0, -1}}), one).find("radius"), std::string::npos);
  EXPECT_NE(refusal(one, one, {.threshold = NAN}).find("threshold"), std::string::npos);
}

/// A proof of its two numbers.
Enclosure proof(std::int64_t balls, double protrusion, bool encloses = true) {
  Enclosure e;
  e.balls = balls;
  e.triangles = 2;
  e.protrusion = protrusion;
  if (!encloses) {
    e.open_triangles = {1};
    e.open_points = {Vec3{}};
    e.open_why = {0};
  }
  return e;
}

TEST(distance, of_solids_is_between_that_of_their_balls_and_what_these_stand_out) {
  const Balls a = balls_of({{0, 0, 0, 1}}), b = balls_of({{3, 0, 0, 1}}), near = balls_of({{1.5, 0, 0, 1}});
  const Enclosure both = proof(1, 0.25), inside = proof(1, 0, false);
  const BallDistance outer = ball_distance(a, b, {}, no_monitor(), {&both, &both});
  EXPECT_EQ(outer.solids_at_least, 1);
  EXPECT_GE(outer.solids_at_most, 1.5);
  EXPECT_LT(outer.solids_at_most, 1.5 + 1e-14);
  const BallDistance overlap = ball_distance(a, near, {}, no_monitor(), {&both, &both});
  EXPECT_EQ(overlap.solids_at_least, 0);
  EXPECT_NE(describe_solids(overlap).find("may meet"), std::string::npos);
  // Balls inside overlap: so do the solids. Apart, they prove nothing from below.
  EXPECT_EQ(describe_solids(ball_distance(a, near, {}, no_monitor(), {&inside, &inside})),
            "the solids meet: proven");
  const BallDistance inner = ball_distance(a, b, {}, no_monitor(), {&inside, &inside});
  EXPECT_EQ(inner.solids_at_least, 0);
  EXPECT_EQ(inner.solids_at_most, 1);
  EXPECT_EQ(describe_solids(ball_distance(a, b, {}, no_monitor())), "");
  // One side is a solid by itself.
  EXPECT_EQ(ball_distance(a, b, {}, no_monitor(), {&both, nullptr}).solids_at_least, 1);
}

TEST(distance, of_what_has_no_triangles_says_nothing_about_solids) {
  const Balls a = balls_of({{0, 0, 0, 1}}), b = balls_of({{3, 0, 0, 1}});
  Enclosure nothing = proof(1, 0);
  nothing.triangles = 0;
  const BallDistance d = ball_distance(a, b, {}, no_monitor(), {&nothing, nullptr});
  EXPECT_EQ(broken_invariant(d), "");
  EXPECT_EQ(d.separation, 1);
  EXPECT_EQ(d.solids_at_least, 0);
  EXPECT_LT(d.solids_at_most, 0);
  EXPECT_NE(describe_solids(d).find("nothing is known"), std::string::npos);
}

TEST(distance, with_a_proof_of_other_balls_is_refused) {
  const Balls one = balls_of({{0, 0, 0, 1}});
  const Enclosure other = proof(2, 0);
  EXPECT_NE(refusal(one, one, {}, {&other, nullptr}).find("about 2 balls"), std::string::npos);
}

/// Cancels at the n-th question.
class CancelAfter final : public Monitor {
 public:
  explicit CancelAfter(int n) : left_(n) {}
  bool cancelled() override { return --left_ < 0; }

 private:
  std::atomic<int> left_;
};

TEST(distance, ends_when_it_is_cancelled) {
  std::mt19937 random(8);
  const Balls a = some(random, 20000, free_ball), b = some(random, 20000, free_ball);
  for (const int n : {0, 3, 100}) {
    CancelAfter monitor(n);
    EXPECT_THROW(ball_distance(a, b, {.every_ball = true}, monitor), Cancelled) << n;
  }
}

}  // namespace
}  // namespace ballflow::geometry
