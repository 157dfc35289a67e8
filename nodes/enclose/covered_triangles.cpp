#include "enclose/covered_triangles.hpp"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "search/nearest_on_triangle.hpp"

namespace ballflow::geometry {
namespace {

using Rational = CGAL::Exact_rational;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// (a A + b B + c C) / 2^bits of the corners A, B, C of a triangle; a + b + c = 2^bits.
struct Combination {
  std::array<std::int64_t, 3> of;
  int bits = 0;
};

/// The midpoint.
Combination middle(Combination p, Combination q) {
  while (p.bits < q.bits) {
    for (std::int64_t& k : p.of) k *= 2;
    ++p.bits;
  }
  while (q.bits < p.bits) {
    for (std::int64_t& k : q.of) k *= 2;
    ++q.bits;
  }
  return {{p.of[0] + q.of[0], p.of[1] + q.of[1], p.of[2] + q.of[2]}, p.bits + 1};
}

Vec3 rounded(const Combination& p, const Corners& triangle) {
  const double unit = std::ldexp(1.0, -p.bits);
  return unit * (static_cast<double>(p.of[0]) * triangle[0] + static_cast<double>(p.of[1]) * triangle[1] +
                 static_cast<double>(p.of[2]) * triangle[2]);
}

bool exactly_in(const Combination& p, const Corners& triangle, Vec3 center, double radius) {
  const Rational unit = std::ldexp(1.0, p.bits);  // as a double, so exact
  const auto difference = [&](double Vec3::*axis) {
    Rational sum = -unit * Rational(center.*axis);
    for (std::size_t k = 0; k < 3; ++k) {
      // Two halves that doubles hold.
      const std::int64_t high = p.of[k] >> 30, low = p.of[k] & ((std::int64_t{1} << 30) - 1);
      const Rational factor =
          Rational(static_cast<double>(high)) * Rational(0x1p30) + Rational(static_cast<double>(low));
      sum += factor * Rational(triangle[k].*axis);
    }
    return sum;
  };
  const Rational x = difference(&Vec3::x), y = difference(&Vec3::y), z = difference(&Vec3::z),
                 r = unit * Rational(radius);
  return x * x + y * y + z * z <= r * r;
}

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// A corner of a part: what it is, and where, rounded.
struct PartCorner {
  Combination exact;
  Vec3 rounded;
};
using Part = std::array<PartCorner, 3>;

bool in_ball(const PartCorner& corner, const Corners& triangle, double scale, Vec3 center, double radius) {
  // A rounded coordinate is off by less than 8 units in the last place of the largest one around.
  constexpr double unit = 0x1p-53;
  const Vec3 d = corner.rounded - center;
  const double off = 8 * unit * std::max(scale, largest_coordinate(center));
  const double squared = dot(d, d), limit = radius * radius;
  const double error = 2 * off * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)) + 3 * off * off +
                       8 * unit * (squared + limit) + std::numeric_limits<double>::min();
  if (squared + error < limit) return true;
  if (squared - error > limit) return false;
  return exactly_in(corner.exact, triangle, center, radius);
}

/// The longest edge is that opposite the result; the first of equal ones.
std::size_t opposite_longest(const Corners& p) {
  std::array<double, 3> squared{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
    squared[k] = dot(edge, edge);
  }
  return static_cast<std::size_t>(std::max_element(squared.begin(), squared.end()) - squared.begin());
}

struct Sphere {
  Vec3 center;
  double radius;
};

Sphere around(const Corners& p) {
  const Vec3 center = 1.0 / 3 * (p[0] + p[1] + p[2]);
  return {center, std::max({distance(center, p[0]), distance(center, p[1]), distance(center, p[2])})};
}

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Not below the distance of a ball from a point that is `apart` from one where it is `distance`, whatever
/// rounding does.
double a_little_more(double distance, double apart) {
  return distance + apart + 1e-9 * (std::abs(distance) + apart) + std::numeric_limits<double>::min();
}

}  // namespace

BallsForTriangles::BallsForTriangles(const Balls& balls)
    : centers_(balls.centers.span()), radii_(balls.radii.span()), tree_(centers_) {
  tree_.set_slacks(radii_);
}

std::vector<std::int32_t> BallsForTriangles::meeting(const Corners& triangle) const {
  const auto [center, radius] = around(triangle);
  const double scale = std::max(
      {largest_coordinate(triangle[0]), largest_coordinate(triangle[1]), largest_coordinate(triangle[2])});
  const double reach = radius * (1 + 1e-9) + 1e-12 * scale + std::numeric_limits<double>::min();
  std::vector<std::int32_t> balls;
  tree_.below(center, reach, [&](std::size_t i) {
    if (distance(center, centers_[i]) <= (radii_[i] + reach) * (1 + 1e-9))
      balls.push_back(static_cast<std::int32_t>(i));
  });
  // Deep ones first: they are most likely to hold all of it.
  std::vector<std::pair<double, std::int32_t>> order;
  for (const std::int32_t i : balls) order.emplace_back(distance(center, centers_[at(i)]) - radii_[at(i)], i);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) balls[i] = order[i].second;
  return balls;
}

TriangleCover BallsForTriangles::cover(const Corners& triangle) const {
  constexpr int most_bits = 60;  // so that combinations fit 64 bits
  constexpr std::int64_t most_parts = std::int64_t{1} << 20;
  const double scale = std::max(
      {largest_coordinate(triangle[0]), largest_coordinate(triangle[1]), largest_coordinate(triangle[2])});
  struct Waiting {
    Part part;
    std::vector<std::int32_t> balls;  // all that meet it, and perhaps others
  };
  TriangleCover result;
  std::vector<Waiting> waiting;
  {
    Part whole;
    for (std::size_t k = 0; k < 3; ++k) {
      whole[k].exact.of = {0, 0, 0};
      whole[k].exact.of[k] = 1;
      whole[k].rounded = triangle[k];
    }
    waiting.push_back({whole, meeting(triangle)});
  }
  std::int64_t parts = 0;
  while (!waiting.empty()) {
    auto [part, balls] = std::move(waiting.back());
    waiting.pop_back();
    ++parts;
    std::array<bool, 3> held{};
    bool in_one = false;
    for (const std::int32_t b : balls) {
      bool all = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool in = in_ball(part[k], triangle, scale, centers_[at(b)], radii_[at(b)]);
        held[k] = held[k] || in;
        all = all && in;
      }
      if (all) {
        in_one = true;
        break;
      }
    }
    if (in_one) {
      ++result.pieces;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (held[k]) continue;
      result.open = OpenTriangle::point_outside;
      result.point = part[k].rounded;
      return result;
    }
    const Corners corners{part[0].rounded, part[1].rounded, part[2].rounded};
    const std::size_t k = opposite_longest(corners);
    const PartCorner &a = part[(k + 1) % 3], &b = part[(k + 2) % 3];
    if (std::max(a.exact.bits, b.exact.bits) >= most_bits || parts >= most_parts) {
      result.open = OpenTriangle::undecided;
      result.point = around(corners).center;
      return result;
    }
    PartCorner half{middle(a.exact, b.exact), {}};
    half.rounded = rounded(half.exact, triangle);
    for (const bool first : {false, true}) {
      Part child = part;
      child[(k + (first ? 2 : 1)) % 3] = half;
      const auto [center, radius] = around({child[0].rounded, child[1].rounded, child[2].rounded});
      const double reach = radius * (1 + 1e-9) + 1e-12 * scale + std::numeric_limits<double>::min();
      std::vector<std::int32_t> near;
      for (const std::int32_t i : balls) {
        if (distance(center, centers_[at(i)]) <= (radii_[at(i)] + reach) * (1 + 1e-9)) near.push_back(i);
      }
      waiting.push_back({child, std::move(near)});
    }
  }
  return result;
}

double BallsForTriangles::distance_from_union(Vec3 p, double at_most, double enough) const {
  return tree_.smallest(p, at_most, enough,
                        [&](std::size_t i) { return distance(p, centers_[i]) - radii_[i]; });
}

double BallsForTriangles::gap_of_corners(const Corners& triangle) const {
  double gap = 0;
  for (const Vec3 corner : triangle) gap = std::max(gap, distance_from_union(corner, unbounded, gap));
  return gap;
}

bool BallsForTriangles::none_meets(const Corners& part, Vec3 center, double radius) const {
  const double reach = a_little_more(radius, 0);
  return tree_.smallest(center, reach, reach, [&](std::size_t i) {
    // A ball that reaches out by less than a billionth covers nothing to speak of.
    const bool meets = distance(nearest_on_triangle(centers_[i], part), centers_[i]) < radii_[i] * (1 - 1e-9);
    return meets ? distance(center, centers_[i]) - radii_[i] : unbounded;
  }) >= reach;
}

UncoveredPart BallsForTriangles::uncovered(const Corners& triangle, double size, double settled) const {
  UncoveredPart result{.area = 0, .gap = settled};
  struct Waiting {
    Corners part;
    double at_most;  // of its center
    bool outside;    // no ball meets it
  };
  std::vector<Waiting> waiting{{triangle, unbounded, false}};
  while (!waiting.empty()) {
    auto [part, at_most, outside] = waiting.back();
    waiting.pop_back();
    const auto [center, radius] = around(part);
    // From radius on all of it is outside, and down to -radius all in one ball. What is outside is of
    // interest where it may be farther away than what was met.
    const double from_union = distance_from_union(center, at_most, 0);
    const std::size_t k = opposite_longest(part);
    const Vec3 a = part[(k + 1) % 3], b = part[(k + 2) % 3];
    const bool may_split = distance(a, b) > size, farther = a_little_more(from_union, radius) > result.gap;
    outside =
        outside || from_union >= radius || (from_union > 0 && may_split && none_meets(part, center, radius));
    const bool mixed = !outside && from_union > -radius;
    if ((mixed || (outside && farther)) && may_split) {
      const Vec3 half = 0.5 * (a + b);
      for (const std::size_t moved : {(k + 1) % 3, (k + 2) % 3}) {
        Corners child = part;
        child[moved] = half;
        waiting.push_back(
            {child, a_little_more(from_union, distance(center, around(child).center)), outside});
      }
      continue;
    }
    if (!(from_union > 0)) continue;  // most of it is covered
    result.area += 0.5 * length(cross(part[1] - part[0], part[2] - part[0]));
    result.gap = std::max(result.gap, from_union);
    if (!farther) continue;
    for (const Vec3 corner : part) {
      const double limit = a_little_more(from_union, distance(center, corner));
      result.gap = std::max(result.gap, distance_from_union(corner, limit, result.gap));
    }
  }
  return result;
}

double BallsForTriangles::gap_at_most(const Corners& triangle, double settled, double tolerance) const {
  constexpr std::int64_t most_parts = std::int64_t{1} << 20;
  // The distance from a ball is convex, so that no point of a part is farther from it than a corner.
  const auto of_corners = [&](const Corners& part, Vec3 center, double at_most) {
    return tree_.smallest(center, at_most, -unbounded, [&](std::size_t i) {
      double farthest = distance(center, centers_[i]);
      for (const Vec3 corner : part) farthest = std::max(farthest, distance(corner, centers_[i]));
      return farthest - radii_[i];
    });
  };
  double least = settled, most = settled;
  std::int64_t parts = 0;
  struct Waiting {
    Corners part;
    double at_most;  // a ball is no farther from any of its points
  };
  std::vector<Waiting> waiting{{triangle, unbounded}};
  while (!waiting.empty()) {
    const auto [part, at_most] = waiting.back();
    waiting.pop_back();
    ++parts;
    const Vec3 center = around(part).center;
    const double upper = of_corners(part, center, at_most);
    if (upper <= most) continue;
    least = std::max(least, distance_from_union(center, a_little_more(upper, 0), least));
    if (upper <= least + tolerance || parts >= most_parts) {
      most = upper;
      continue;
    }
    const std::size_t k = opposite_longest(part);
    const Vec3 half = 0.5 * (part[(k + 1) % 3] + part[(k + 2) % 3]);
    for (const std::size_t moved : {(k + 1) % 3, (k + 2) % 3}) {
      Corners child = part;
      child[moved] = half;
      waiting.push_back({child, a_little_more(upper, 0)});
    }
  }
  return most;
}

}  // namespace ballflow::geometry
