// The point next to the origin in an intersection of half-spaces, in three variables.
#pragma once

#include <array>
#include <cstddef>

namespace ballflow::geometry {

/// Seidel's incremental algorithm (1991) for the point of smallest norm: while it satisfies the half-spaces
/// seen so far it stays, else it moves onto the plane of the first that it violates, and so on in lower
/// dimension.
///
/// F is an ordered field, B an ordered vector space over it: bounds may have infinitesimal parts.
/// - normal(j) is a std::array<F, 3>, bound(j) a B; half-space j is { y : normal(j) . y <= bound(j) }.
/// - It ends early when enough(point) is true for the point next to the origin in some of the half-spaces.
/// - With floating-point numbers the result is what rounding makes of it.
template <class F, class B>
struct NearestPoint {
  using Normal = std::array<F, 3>;
  using Point = std::array<B, 3>;
  enum class Status { found, empty };

  Status status = Status::found;
  Point point{};
  std::array<std::size_t, 3> active{};  // half-spaces on whose planes it lies, `active_count` of them
  int active_count = 0;

  template <class NormalOf, class BoundOf, class Enough>
  NearestPoint(std::size_t count, const NormalOf& normal, const BoundOf& bound, const Enough& enough) {
    for (std::size_t j = 0; j < count && status == Status::found; ++j) {
      const Normal n = normal(j);
      if (!(bound(j) < dot(n, point))) continue;
      on_plane(j, n, normal, bound);
      if (enough(point)) return;
    }
  }

 private:
  template <class T>
  static T dot(const Normal& a, const std::array<T, 3>& b) {
    return b[0] * a[0] + b[1] * a[1] + b[2] * a[2];
  }
  static Normal cross(const Normal& a, const Normal& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Point along(const Normal& n, const B& t) { return {t * n[0], t * n[1], t * n[2]}; }
  static Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

  template <class NormalOf, class BoundOf>
  void on_plane(std::size_t j, const Normal& n, const NormalOf& normal, const BoundOf& bound) {
    const F nn = dot(n, n);
    if (!(F(0) < nn)) {
      status = Status::empty;
      return;
    }
    const Point foot = along(n, bound(j) / nn);
    point = foot;
    active = {j, 0, 0};
    active_count = 1;
    for (std::size_t k = 0; k < j && status == Status::found; ++k) {
      const Normal m = normal(k);
      if (!(bound(k) < dot(m, point))) continue;
      // The part of m in the plane; the half-space is { z in the plane : g . z <= rest }, y = foot + z.
      const F part = dot(m, n) / nn;
      const Normal g{m[0] - part * n[0], m[1] - part * n[1], m[2] - part * n[2]};
      on_line(j, n, k, g, bound(k) - dot(m, foot), foot, normal, bound);
    }
  }

  template <class NormalOf, class BoundOf>
  void on_line(std::size_t j, const Normal& n, std::size_t k, const Normal& g, const B& rest,
               const Point& foot, const NormalOf& normal, const BoundOf& bound) {
    const F gg = dot(g, g);
    if (!(F(0) < gg)) {
      status = Status::empty;  // parallel planes, and the second is violated
      return;
    }
    const Point origin = sum(foot, along(g, rest / gg));
    const Normal direction = cross(n, g);
    bool has_low = false, has_high = false;
    B low{}, high{};
    std::size_t low_at = 0, high_at = 0;
    for (std::size_t l = 0; l < k; ++l) {
      const Normal m = normal(l);
      const F slope = dot(m, direction);
      const B room = bound(l) - dot(m, origin);
      if (F(0) < slope) {
        const B s = room / slope;
        if (!has_high || s < high) high = s, high_at = l, has_high = true;
      } else if (slope < F(0)) {
        const B s = room / slope;
        if (!has_low || low < s) low = s, low_at = l, has_low = true;
      } else if (room < B{}) {
        status = Status::empty;
        return;
      }
    }
    if (has_low && has_high && high < low) {
      status = Status::empty;
      return;
    }
    active = {j, k, 0};
    active_count = 2;
    point = origin;
    if (has_low && B{} < low) {
      move_to(low_at, low, direction);
    } else if (has_high && high < B{}) {
      move_to(high_at, high, direction);
    }
  }

  void move_to(std::size_t l, const B& s, const Normal& direction) {
    point = sum(point, along(direction, s));
    active[2] = l;
    active_count = 3;
  }
};

}  // namespace ballflow::geometry
