#include "covering_oracle.hpp"

#include <cmath>
#include <vector>

#include "exact_points.hpp"

namespace ballflow::geometry::test {
namespace {

Point plus(const Point& a, const Q& s, const Point& b) {
  return {Q(a[0] + s * b[0]), Q(a[1] + s * b[1]), Q(a[2] + s * b[2])};
}

struct Exact {
  Point center;  // from that of the ball
  Q weight;
};

/// a + b sqrt(d) > 0.
bool positive(const Q& a, const Q& b, const Q& d) {
  if (b == 0 || d == 0) return a > 0;
  if (a >= 0 && b >= 0) return a > 0 || b > 0;
  if (a <= 0 && b <= 0) return false;
  const Q aa = a * a, bb = b * b * d;
  return a > 0 ? aa > bb : bb > aa;
}

class Search {
 public:
  Search(const Site& ball, std::span<const Site> others, int dimensions)
      : weight_(ball.weight), dimensions_(dimensions) {
    for (const Site& o : others) {
      others_.push_back({{Q(Q(o.center.x) - Q(ball.center.x)), Q(Q(o.center.y) - Q(ball.center.y)),
                          Q(Q(o.center.z) - Q(ball.center.z))},
                         Q(o.weight)});
      rounded_.push_back({o.center - ball.center, o.weight});
    }
  }

  bool finds_a_place_outside() {
    if (others_.empty()) return true;
    chosen_.clear();
    return from(0);
  }

 private:
  /// All sets of up to dimensions + 1 others, whose bisectors with each other are looked at.
  bool from(std::size_t first) {
    if (!chosen_.empty() && outside_near_chosen()) return true;
    if (chosen_.size() == static_cast<std::size_t>(dimensions_) + 1) return false;
    for (std::size_t i = first; i < others_.size(); ++i) {
      chosen_.push_back(i);
      const bool found = from(i + 1);
      chosen_.pop_back();
      if (found) return true;
    }
    return false;
  }

  bool outside_near_chosen() const {
    // The flat that all bisectors of the chosen have in common: its point next to the center of the ball, and
    // orthogonal normals.
    std::vector<Point> normals;
    if (dimensions_ == 2) normals.push_back({Q(0), Q(0), Q(1)});
    Point foot{Q(0), Q(0), Q(0)};
    const Exact& first = others_[chosen_[0]];
    for (std::size_t k = 1; k < chosen_.size(); ++k) {
      const Exact& other = others_[chosen_[k]];
      Point n = plus(other.center, Q(-1), first.center);
      const Q b =
          (dot(other.center, other.center) - other.weight - dot(first.center, first.center) + first.weight) /
          2;
      Q rest = b - dot(n, foot);
      for (const Point& m : normals) n = plus(n, Q(-(dot(n, m) / dot(m, m))), m);
      if (is_zero(n)) return false;  // no bisector more: smaller sets, or none, meet here
      foot = plus(foot, Q(rest / dot(n, n)), n);
      normals.push_back(n);
    }
    const Point zero{Q(0), Q(0), Q(0)};
    const Q left = weight_ - dot(foot, foot);  // squared radius of the sphere cut by the flat
    if (left < 0) return false;
    if (normals.size() == 3) return outside(foot, zero, Q(0));
    // On that sphere the power to the chosen is largest in one direction, or nowhere more than elsewhere.
    const auto in_flat = [&normals](Point p) {
      for (const Point& m : normals) p = plus(p, Q(-(dot(p, m) / dot(m, m))), m);
      return p;
    };
    std::vector<Point> directions{in_flat(first.center)};
    if (is_zero(directions[0])) {
      directions.clear();
      for (std::size_t k = 0; k < 3; ++k) {
        Point axis = zero;
        axis[k] = 1;
        if (const Point in = in_flat(axis); !is_zero(in)) directions.push_back(in);
      }
    }
    for (const Point& u : directions) {
      const Q d = left / dot(u, u);
      if (outside(foot, u, d) || outside(foot, {Q(-u[0]), Q(-u[1]), Q(-u[2])}, d)) return true;
    }
    return false;
  }

  /// The point p + q sqrt(d) is outside all others.
  bool outside(const Point& p, const Point& q, const Q& d) const {
    // Most points are well inside one of the others, which doubles tell: numbers here are small.
    const double root = std::sqrt(CGAL::to_double(d));
    const auto rounded = [&](std::size_t k) { return CGAL::to_double(p[k]) + root * CGAL::to_double(q[k]); };
    const Vec3 x{rounded(0), rounded(1), rounded(2)};
    for (const Site& o : rounded_) {
      if (squared_distance(x, o.center) - o.weight <
          -1e-6 * (1 + squared_length(x) + squared_length(o.center)))
        return false;
    }
    for (const Exact& o : others_) {
      const Point from = plus(p, Q(-1), o.center);
      // |from + q s|^2 - weight, s * s = d
      if (!positive(Q(dot(from, from) + dot(q, q) * d - o.weight), Q(2 * dot(from, q)), d)) return false;
    }
    return true;
  }

  Q weight_;
  int dimensions_;
  std::vector<Exact> others_;
  std::vector<Site> rounded_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

bool covered_by_enumeration(const Site& ball, std::span<const Site> others, int dimensions) {
  return !Search(ball, others, dimensions).finds_a_place_outside();
}

}  // namespace ballflow::geometry::test
