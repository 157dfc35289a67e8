#include "exact/separation.hpp"

#include <CGAL/CORE_Expr.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

/// Real numbers with roots whose signs CORE decides by its own bounds.
CORE::Expr exact(const BallPair& p) {
  const auto square = [](double u, double v) {
    const CORE::Expr edge = CORE::Expr(u) - CORE::Expr(v);
    return edge * edge;
  };
  return sqrt(square(p.a.x, p.b.x) + square(p.a.y, p.b.y) + square(p.a.z, p.b.z)) - CORE::Expr(p.radius_a) -
         CORE::Expr(p.radius_b);
}

void expect_as_exact(const BallPair& p, const BallPair& q) {
  const int sign = (exact(p) - exact(q)).sign();
  EXPECT_EQ(compare_separations(p, q), sign);
  EXPECT_EQ(compare_separations(q, p), -sign);
}

double step(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  for (; steps < 0; ++steps) x = std::nextafter(x, -std::numeric_limits<double>::infinity());
  return x;
}

TEST(separation, of_pairs_on_a_small_lattice_is_compared_as_real_numbers_are) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-1, 1), radius(0, 3);
  const auto pair = [&] {
    const auto c = [&] {
      return Vec3{1.0 * coordinate(random), 1.0 * coordinate(random), 1.0 * coordinate(random)};
    };
    return BallPair{c(), c(), 0.5 * radius(random), 0.5 * radius(random)};
  };
  int ties = 0;
  for (int i = 0; i < 3000; ++i) {
    const BallPair p = pair(), q = pair();
    expect_as_exact(p, q);
    if (compare_separations(p, q) == 0) ++ties;
    EXPECT_EQ(compare_separation(p, 0), exact(p).sign());
  }
  EXPECT_GT(ties, 50);
}

TEST(separation, of_pairs_that_differ_by_roundings_is_compared_as_real_numbers_are) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> ulps(-2, 2);
  for (int i = 0; i < 2000; ++i) {
    // Both at a distance of about r from the origin, so that their separations differ in the last places.
    const Vec3 u{uniform(random), uniform(random), uniform(random)},
        v{uniform(random), uniform(random), uniform(random)};
    const double r = 1 + uniform(random) * 0.5;
    const Vec3 at = (r / length(u)) * u, other = (r / length(v)) * v;
    BallPair p{{0, 0, 0}, at, 0.25, 0.1}, q{{0, 0, 0}, other, 0.25, step(0.1, ulps(random))};
    expect_as_exact(p, q);
    // Permuted and mirrored: equal, though doubles see other roundings.
    expect_as_exact(p, {{0, 0, 0}, {-at.z, at.x, -at.y}, 0.25, 0.1});
    expect_as_exact(p, {{0, 0, 0}, {-at.z, at.x, -at.y}, 0.25, step(0.1, ulps(random))});
  }
}

TEST(separation, of_roots_that_cancel_exactly_is_equal) {
  // sqrt(8) - sqrt(2) = sqrt(2): |(2, 2, 0)| - 1 against 2 |(1, 1, 0)| - 1 has no shape in common.
  const BallPair far{{0, 0, 0}, {2, 2, 0}, 1, 0}, same{{1, 1, 1}, {3, 1, 3}, 0.5, 0.5};
  EXPECT_EQ(compare_separations(far, same), 0);
  // 5 - 2 = 13 - 10: from 3, 4, 5 and 5, 12, 13.
  EXPECT_EQ(compare_separations({{0, 0, 0}, {3, 4, 0}, 1, 1}, {{0, 0, 0}, {0, 5, 12}, 4, 6}), 0);
  EXPECT_EQ(compare_separations({{0, 0, 0}, {3, 4, 0}, 1, 1}, {{0, 0, 0}, {0, 5, 12}, 4, step(6, 1)}), 1);
  EXPECT_EQ(compare_separations({{0, 0, 0}, {3, 4, 0}, 1, step(1, 1)}, {{0, 0, 0}, {0, 5, 12}, 4, 6}), -1);
}

/// With 8192 bits, where CORE fails for want of exponents. The lengths below are multiples of 2^-620 and less
/// than 2^470, so that a sum of two roots and a number is 0 or, by its conjugates, above 2^-4000.
class Wide {
 public:
  Wide() { mpfr_init2(number_, 8192); }
  Wide(const Wide&) = delete;
  Wide& operator=(const Wide&) = delete;
  ~Wide() { mpfr_clear(number_); }

  void add_separation(const BallPair& p, int sign) {
    Wide sum, edge;
    mpfr_set_zero(sum.number_, 1);
    for (const auto& [u, v] : {std::pair{p.a.x, p.b.x}, std::pair{p.a.y, p.b.y}, std::pair{p.a.z, p.b.z}}) {
      mpfr_set_d(edge.number_, u, MPFR_RNDN);
      mpfr_sub_d(edge.number_, edge.number_, v, MPFR_RNDN);
      mpfr_sqr(edge.number_, edge.number_, MPFR_RNDN);
      mpfr_add(sum.number_, sum.number_, edge.number_, MPFR_RNDN);
    }
    mpfr_sqrt(sum.number_, sum.number_, MPFR_RNDN);
    mpfr_sub_d(sum.number_, sum.number_, p.radius_a, MPFR_RNDN);
    mpfr_sub_d(sum.number_, sum.number_, p.radius_b, MPFR_RNDN);
    mpfr_mul_si(sum.number_, sum.number_, sign, MPFR_RNDN);
    mpfr_add(number_, number_, sum.number_, MPFR_RNDN);
  }
  void clear() { mpfr_set_zero(number_, 1); }
  int sign() const {
    return mpfr_zero_p(number_) || mpfr_get_exp(number_) < -5000 ? 0 : mpfr_sgn(number_) > 0 ? 1 : -1;
  }

 private:
  mpfr_t number_;
};

TEST(separation, of_very_large_and_very_small_balls_is_exact) {
  const std::vector<double> sizes{0, 1e-170, 1e-100, 1, 3e100, 1e140};
  for (const double s : sizes) {
    for (const double t : sizes) {
      const BallPair p{{0, 0, 0}, {3 * s / 4, s, 0}, s / 2, t}, q{{t, 0, 0}, {0, s, s / 3}, t, s / 7};
      Wide difference, single;
      difference.clear();
      difference.add_separation(p, 1);
      difference.add_separation(q, -1);
      EXPECT_EQ(compare_separations(p, q), difference.sign()) << s << ' ' << t;
      EXPECT_EQ(compare_separations(q, p), -difference.sign()) << s << ' ' << t;
      single.clear();
      single.add_separation(p, 1);
      EXPECT_EQ(compare_separation(p, 0), single.sign()) << s << ' ' << t;
    }
  }
}

TEST(separation, of_the_smallest_doubles_is_exact) {
  const double least = std::numeric_limits<double>::denorm_min();
  const BallPair touching{{0, 0, 0}, {3 * least, 4 * least, 0}, 2 * least, 3 * least};
  EXPECT_EQ(nearest_separation(touching), 0);
  EXPECT_EQ(compare_separations(touching, {{0, 0, 0}, {0, 4 * least, 3 * least}, 2 * least, 2 * least}), -1);
  EXPECT_EQ(nearest_separation({{0, 0, 0}, {least, least, 0}, 0, least}), least);  // 0.41 of it, but not 0
  EXPECT_EQ(compare_separation(touching, least), -1);
  EXPECT_EQ(compare_separation(touching, -least), 1);
}

TEST(separation, is_zero_for_balls_that_touch_and_for_no_others) {
  EXPECT_EQ(nearest_separation({{0, 0, 0}, {3, 4, 0}, 2, 3}), 0);
  EXPECT_LT(nearest_separation({{0, 0, 0}, {3, 4, 0}, 2, step(3, 1)}), 0);
  EXPECT_GT(nearest_separation({{0, 0, 0}, {3, 4, 0}, 2, step(3, -1)}), 0);
  // 0.1 + 0.2 is less than 0.3 rounded is: nearly touching, apart by less than a unit in the last place.
  const BallPair p{{0, 0, 0}, {0.3, 0, 0}, 0.1, 0.2};
  EXPECT_EQ(compare_separation(p, 0), exact(p).sign());
  EXPECT_EQ(nearest_separation(p) < 0, exact(p).sign() < 0);
  EXPECT_EQ(nearest_separation({{1, 2, 3}, {1, 2, 3}, 0.5, 0.25}), -0.75);
  EXPECT_EQ(nearest_separation({{1, 2, 3}, {1, 2, 3}, 0, 0}), 0);
}

TEST(separation, is_rounded_to_the_nearest_and_bounded_from_both_sides) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 500; ++i) {
    BallPair p{{uniform(random), uniform(random), uniform(random)},
               {uniform(random), uniform(random), uniform(random)},
               std::abs(uniform(random)),
               std::abs(uniform(random))};
    // Half of them nearly touch.
    if (i % 2 == 0) p.radius_b = std::max(0.0, step(distance(p.a, p.b) - p.radius_a, i % 5 - 2));
    const double value = nearest_separation(p), low = separation_at_least(p), high = separation_at_most(p);
    const CORE::Expr truth = exact(p);
    EXPECT_LE((CORE::Expr(low) - truth).sign(), 0);
    EXPECT_GE((CORE::Expr(high) - truth).sign(), 0);
    EXPECT_GE(high, step(low, 0));
    EXPECT_LE(high, step(low, 1));
    // Not farther from the truth than the other bound.
    const double other = value == low ? high : low;
    EXPECT_LE((abs(CORE::Expr(value) - truth) - abs(CORE::Expr(other) - truth)).sign(), 0) << i;
    EXPECT_TRUE(value == low || value == high);
  }
}

}  // namespace
}  // namespace ballflow::geometry
