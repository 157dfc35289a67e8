// Oracles in the plane: brute force with rational-free arithmetic on small integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "planar/ring_nesting.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry::test {

using Points = std::vector<Vec2>;

inline RawRing ring(Points points, RingRole role = RingRole::open) {
  static int number = 0;
  return {std::move(points), role, "ring " + std::to_string(number++)};
}

inline Polygon2 polygon_of(std::vector<RawRing> rings) { return nest(std::move(rings)).polygon; }

/// Coordinates are small integers: the sign is exact.
inline int turn(Vec2 a, Vec2 b, Vec2 c) {
  const double area = cross(b - a, c - a);
  return (area > 0) - (area < 0);
}

inline bool on_segment(Vec2 a, Vec2 b, Vec2 p) { return turn(a, b, p) == 0 && dot(a - p, b - p) <= 0; }

inline bool share_a_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b)) return true;
  return turn(a, b, c) != turn(a, b, d) && turn(c, d, a) != turn(c, d, b);
}

/// By the number of edges that a ray to the right crosses.
inline bool inside(const std::vector<Points>& rings, Vec2 p) {
  bool in = false;
  for (const Points& r : rings) {
    for (std::size_t i = 0; i < r.size(); ++i) {
      const Vec2 a = r[i], b = r[(i + 1) % r.size()];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      in ^= (turn(a, b, p) > 0) == (b.y > a.y);
    }
  }
  return in;
}

inline std::vector<Points> rings_of(const Polygon2& polygon) {
  std::vector<Points> rings;
  for (std::size_t r = 0; r < polygon.rings(); ++r)
    rings.emplace_back(polygon.ring(r).begin(), polygon.ring(r).end());
  return rings;
}

inline double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double t = std::min(1.0, std::max(0.0, dot(p - a, d) / dot(d, d)));
  return distance(p, a + t * d);
}

inline double distance_to_boundary(const Polygon2& polygon, Vec2 p) {
  double least = INFINITY;
  for (const Points& r : rings_of(polygon)) {
    for (std::size_t i = 0; i < r.size(); ++i)
      least = std::min(least, distance_to_segment(p, r[i], r[(i + 1) % r.size()]));
  }
  return least;
}

inline bool in_a_disc(const Balls& discs, Vec2 p) {
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (distance({discs.centers[i].x, discs.centers[i].y}, p) <= discs.radii[i]) return true;
  }
  return false;
}

/// A polygon with holes, or several, with corners at whole numbers: rings drawn at random that happen to have
/// no point in common.
inline Polygon2 random_polygon(Random& random, int tries = 40, int size = 30) {
  const auto whole = [&](int n) {
    return static_cast<double>(random.bits() % static_cast<std::uint64_t>(n));
  };
  std::vector<RawRing> kept;
  for (int i = 0; i < tries || kept.empty(); ++i) {
    // A star-shaped ring around a center: directions in order around it.
    const Vec2 c{whole(size), whole(size)};
    const double reach = 1 + whole(size / 2);
    Points points;
    for (const Vec2 d : {Vec2{4, 0},
                         {3, 2},
                         {2, 3},
                         {0, 4},
                         {-2, 3},
                         {-3, 2},
                         {-4, 0},
                         {-3, -2},
                         {-2, -3},
                         {0, -4},
                         {2, -3},
                         {3, -2}}) {
      if (random.bits() % 3 == 0) continue;
      const double far = 1 + whole(static_cast<int>(reach));
      points.push_back(c + far * d);
    }
    if (points.size() < 3) continue;
    std::vector<RawRing> all = kept;
    all.push_back(ring(points));
    try {
      nest(all);
      kept = std::move(all);
    } catch (const InputError&) {
    }
  }
  return polygon_of(std::move(kept));
}

}  // namespace ballflow::geometry::test
