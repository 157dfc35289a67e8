// The filtered predicates against rational arithmetic, on balls in general position, on grids where most
// signs are zero, and on balls moved off a grid by single roundings.
#include "exact/ball_predicates.hpp"

#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace ballflow::geometry {
namespace {

using Number = CGAL::Gmpq;
using Row = std::vector<Number>;

// The orthogonal sphere from the definition: the centre is p_0 + sum x_k a_k with 2 a_i . c = lift_i, a
// linear system in x, solved by elimination.
struct Sphere {
  std::array<Number, 3> center;  // relative to the first ball
  Number squared_radius;
};

class Oracle {
 public:
  Oracle(const std::vector<Vec3>& centers, const std::vector<double>& weights)
      : centers_(centers), weights_(weights) {}

  Sphere sphere(const std::vector<std::int32_t>& balls) const {
    const std::size_t n = balls.size() - 1;
    std::vector<std::array<Number, 3>> a;
    for (std::size_t k = 1; k <= n; ++k) a.push_back(relative(balls[0], balls[k]));
    std::vector<Row> rows(n, Row(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) rows[i][k] = Number(2) * dot(a[i], a[k]);
      rows[i][n] = lift(balls[0], balls[i + 1]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t pivot = i;
      while (rows[pivot][i] == 0) ++pivot;
      std::swap(rows[i], rows[pivot]);
      for (std::size_t k = 0; k < n; ++k) {
        if (k == i) continue;
        const Number factor = rows[k][i] / rows[i][i];
        for (std::size_t j = i; j <= n; ++j) rows[k][j] -= factor * rows[i][j];
      }
    }
    Sphere sphere{{0, 0, 0}, 0};
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t d = 0; d < 3; ++d) sphere.center[d] += rows[k][n] / rows[k][k] * a[k][d];
    }
    sphere.squared_radius = dot(sphere.center, sphere.center) - weight(balls[0]);
    return sphere;
  }
  bool meets(const std::vector<std::int32_t>& balls) const { return sphere(balls).squared_radius <= 0; }
  bool attaches(const std::vector<std::int32_t>& balls, std::int32_t other) const {
    const Sphere s = sphere(balls);
    const auto q = relative(balls[0], other);
    Number power = -weight(other);
    for (std::size_t d = 0; d < 3; ++d) power += (s.center[d] - q[d]) * (s.center[d] - q[d]);
    return power < s.squared_radius;
  }
  /// The sign of the power of a ball to the orthogonal sphere of four, negated for negatively oriented
  /// centres.
  int side(const std::array<std::int32_t, 4>& b, std::int32_t other) const {
    const Sphere s = sphere({b[0], b[1], b[2], b[3]});
    const auto q = relative(b[0], other), x = relative(b[0], b[1]), y = relative(b[0], b[2]),
               z = relative(b[0], b[3]);
    Number power = -weight(other) - s.squared_radius;
    for (std::size_t d = 0; d < 3; ++d) power += (s.center[d] - q[d]) * (s.center[d] - q[d]);
    const std::array<Number, 3> n{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                                  x[0] * y[1] - x[1] * y[0]};
    const int sign = power > 0 ? 1 : power < 0 ? -1 : 0;
    return dot(n, z) > 0 ? sign : -sign;
  }
  bool independent(const std::vector<std::int32_t>& balls) const {
    std::vector<std::array<Number, 3>> a;
    for (std::size_t k = 1; k < balls.size(); ++k) a.push_back(relative(balls[0], balls[k]));
    if (a.size() == 1) return dot(a[0], a[0]) != 0;
    const std::array<Number, 3> n{a[0][1] * a[1][2] - a[0][2] * a[1][1],
                                  a[0][2] * a[1][0] - a[0][0] * a[1][2],
                                  a[0][0] * a[1][1] - a[0][1] * a[1][0]};
    return a.size() == 2 ? dot(n, n) != 0 : dot(n, a[2]) != 0;
  }

 private:
  static Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  Number weight(std::int32_t i) const { return weights_[static_cast<std::size_t>(i)]; }
  std::array<Number, 3> relative(std::int32_t from, std::int32_t to) const {
    const Vec3 p = centers_[static_cast<std::size_t>(from)], q = centers_[static_cast<std::size_t>(to)];
    return {Number(q.x) - Number(p.x), Number(q.y) - Number(p.y), Number(q.z) - Number(p.z)};
  }
  Number lift(std::int32_t from, std::int32_t to) const {
    const auto a = relative(from, to);
    return dot(a, a) - weight(to) + weight(from);
  }

  const std::vector<Vec3>& centers_;
  const std::vector<double>& weights_;
};

struct Answers {
  int asked = 0, yes = 0;
  int sides = 0, quick = 0;  // power sides that are not 0, and those that were found without rational numbers
  void count(bool answer) {
    ++asked;
    yes += answer ? 1 : 0;
  }
};

// Compares all predicates on `tuples` random tuples of five balls; returns how often the answer was yes.
Answers compare(const std::vector<Vec3>& centers, const std::vector<double>& weights, int tuples,
                std::mt19937& random) {
  const BallPredicates predicates(centers, weights);
  const Oracle oracle(centers, weights);
  Answers answers;
  for (int t = 0; t < tuples; ++t) {
    std::array<std::int32_t, 5> b{};
    for (std::int32_t& i : b) i = static_cast<std::int32_t>(random() % centers.size());
    const std::int32_t other = b[4];
    const std::array<std::int32_t, 2> edge{b[0], b[1]};
    const std::array<std::int32_t, 3> triangle{b[0], b[1], b[2]};
    const std::array<std::int32_t, 4> tetrahedron{b[0], b[1], b[2], b[3]};
    const auto check = [&](bool found, bool expected, const char* what) {
      EXPECT_EQ(found, expected) << what << " of balls " << b[0] << " " << b[1] << " " << b[2] << " " << b[3]
                                 << " and " << other;
      answers.count(expected);
    };
    check(predicates.attaches(b[0], other), oracle.attaches({b[0]}, other), "a vertex");
    if (!oracle.independent({b[0], b[1]})) continue;
    check(predicates.meets(edge), oracle.meets({b[0], b[1]}), "an edge");
    check(predicates.attaches(edge, other), oracle.attaches({b[0], b[1]}, other), "an edge");
    if (!oracle.independent({b[0], b[1], b[2]})) continue;
    check(predicates.meets(triangle), oracle.meets({b[0], b[1], b[2]}), "a triangle");
    check(predicates.attaches(triangle, other), oracle.attaches({b[0], b[1], b[2]}, other), "a triangle");
    if (!oracle.independent({b[0], b[1], b[2], b[3]})) continue;
    check(predicates.meets(tetrahedron), oracle.meets({b[0], b[1], b[2], b[3]}), "a tetrahedron");
    const auto ball = [&](std::int32_t i) {
      return WeightedPoint{centers[static_cast<std::size_t>(i)], weights[static_cast<std::size_t>(i)]};
    };
    if (std::abs(ball(other).center.x) > 1e20) continue;  // beyond what the quick test takes
    const int expected = -oracle.side(tetrahedron, other);
    const int side = quick_power_side(ball(b[0]), ball(b[1]), ball(b[2]), ball(b[3]), ball(other));
    if (side != 0) {
      EXPECT_EQ(side, expected);
    }
    answers.sides += expected != 0 ? 1 : 0;
    answers.quick += side != 0 ? 1 : 0;
  }
  return answers;
}

// Both answers must occur, or the test says nothing.
void expect_both(const Answers& answers) {
  EXPECT_GT(answers.yes, answers.asked / 20);
  EXPECT_LT(answers.yes, answers.asked * 19 / 20);
}

TEST(ball_predicates, agree_with_rational_arithmetic_on_random_balls) {
  std::mt19937 random(1);
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Vec3> centers;
  std::vector<double> weights;
  for (int i = 0; i < 60; ++i) {
    centers.push_back({uniform(), uniform(), uniform()});
    weights.push_back(0.6 * uniform());
  }
  const Answers answers = compare(centers, weights, 1500, random);
  expect_both(answers);
  EXPECT_GT(answers.sides, 800);
  EXPECT_EQ(answers.quick, answers.sides);
}

TEST(ball_predicates, agree_with_rational_arithmetic_where_most_signs_are_zero) {
  std::mt19937 random(2);
  std::vector<Vec3> centers;
  std::vector<double> weights;
  for (int i = 0; i < 27; ++i) {
    centers.push_back({double(i % 3), double(i / 3 % 3), double(i / 9)});
    weights.push_back(0.25 * (1 + i % 3));
  }
  expect_both(compare(centers, weights, 1500, random));
}

TEST(ball_predicates, agree_with_rational_arithmetic_one_rounding_off_a_grid_and_far_from_the_origin) {
  std::mt19937 random(3);
  std::vector<Vec3> centers;
  std::vector<double> weights;
  const auto moved = [&random](double x) {
    const unsigned way = random() % 3;
    return way == 0 ? x : std::nextafter(x, way == 1 ? 1e9 : -1e9);
  };
  for (int i = 0; i < 27; ++i) {
    centers.push_back({1000 + moved(i % 3), 1000 + moved(i / 3 % 3), moved(i / 9)});
    weights.push_back(moved(0.25 * (1 + i % 3)));
  }
  const Answers answers = compare(centers, weights, 1500, random);
  expect_both(answers);
  EXPECT_GT(answers.quick, 300);  // one rounding apart: pairs of doubles tell
}

TEST(ball_predicates, agree_with_rational_arithmetic_from_tiny_to_huge_balls) {
  std::mt19937 random(4);
  const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  for (const double unit : {1e-60, 1e-12, 1e18, 1e25}) {
    std::vector<Vec3> centers;
    std::vector<double> weights;
    for (int i = 0; i < 30; ++i) {
      const double size = std::ldexp(unit, -static_cast<int>(random() % 40));
      centers.push_back({size * uniform(), size * uniform(), size * uniform()});
      weights.push_back(size * size * uniform());
    }
    expect_both(compare(centers, weights, 300, random));
  }
}

}  // namespace
}  // namespace ballflow::geometry
