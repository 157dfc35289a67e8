#include "planar/simplify_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planar/ring_nesting.hpp"

namespace ballflow::geometry {
namespace {

/// The directions from a point in which all of some discs with one radius are met.
class Sleeve {
 public:
  Sleeve(Vec2 from, double radius) : from_(from), radius_(radius) {}

  /// Whether the segment to `end` passes all discs no farther than their radius, and reaches beyond none.
  bool allows(Vec2 end) const {
    const Vec2 way = end - from_;
    if (dot(way, way) < farthest_) return false;
    return free_ || (cross(right_, way) >= 0 && cross(way, left_) >= 0 && dot(way, right_ + left_) > 0);
  }
  /// False where no direction is left.
  bool add(Vec2 center) {
    const Vec2 way = center - from_;
    const double squared = dot(way, way);
    farthest_ = std::max(farthest_, squared);
    if (squared <= radius_ * radius_) return true;  // every direction will do
    const double across = radius_, along = std::sqrt(squared - radius_ * radius_);
    const Vec2 right{along * way.x + across * way.y, along * way.y - across * way.x},
        left{along * way.x - across * way.y, along * way.y + across * way.x};
    if (free_) {
      right_ = right;
      left_ = left;
      free_ = false;
      return true;
    }
    if (!(dot(way, right_ + left_) > 0)) return false;
    if (cross(right_, right) > 0) right_ = right;
    if (cross(left_, left) < 0) left_ = left;
    return cross(right_, left_) >= 0;
  }

 private:
  Vec2 from_;
  double radius_, farthest_ = 0;
  bool free_ = true;
  Vec2 right_, left_;
};

std::size_t farthest_from(std::span<const Vec2> ring, Vec2 a, Vec2 b) {
  const Vec2 way = b - a;
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 p = ring[i] - a;
    const double far = a == b ? dot(p, p) : std::abs(cross(way, p));
    if (far > most) {
      most = far;
      best = i;
    }
  }
  return best;
}

/// The corners that are kept, ascending; three of them are extreme ones.
std::vector<std::size_t> kept_corners(std::span<const Vec2> ring, double tolerance, Lookout& look) {
  constexpr std::size_t farthest_look = 256;  // beyond the last end that was possible
  const std::size_t first = farthest_from(ring, ring[0], ring[0]),
                    second = farthest_from(ring, ring[first], ring[first]),
                    third = farthest_from(ring, ring[first], ring[second]);
  std::array<std::size_t, 3> fixed{first, second, third};
  std::sort(fixed.begin(), fixed.end());
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? fixed[k + 1] : fixed[0] + ring.size();
    const auto corner = [&](std::size_t i) { return ring[i % ring.size()]; };
    for (std::size_t at = fixed[k]; at < end;) {
      kept.push_back(at % ring.size());
      Sleeve sleeve(corner(at), tolerance);
      std::size_t next = at + 1;
      for (std::size_t i = at + 1; i <= end && i - next <= farthest_look; ++i) {
        look(4);
        if (sleeve.allows(corner(i))) next = i;
        if (!sleeve.add(corner(i))) break;
      }
      at = next;
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

std::vector<RawRing> with_fewer_corners(const Polygon2& polygon, double tolerance, Monitor& monitor) {
  Lookout look(monitor);
  std::vector<RawRing> rings;
  for (std::size_t c = 0; c < polygon.components(); ++c) {
    for (auto r = polygon.component_offsets[c]; r < polygon.component_offsets[c + 1]; ++r) {
      const auto ring = polygon.ring(static_cast<std::size_t>(r));
      RawRing raw;
      raw.role = r == polygon.component_offsets[c] ? RingRole::outer : RingRole::hole;
      raw.name = "ring " + std::to_string(r);
      for (const std::size_t i : kept_corners(ring, tolerance, look)) raw.points.push_back(ring[i]);
      rings.push_back(std::move(raw));
    }
  }
  return rings;
}

/// Rings of one polygon stand for those of the other, in their order.
bool same_nesting(const Polygon2& polygon, const Polygon2& other, const std::vector<RawRing>& rings) {
  const auto a = polygon.component_offsets.span(), b = other.component_offsets.span();
  if (!std::equal(a.begin(), a.end(), b.begin(), b.end())) return false;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (other.ring(r)[0] != rings[r].points[0]) return false;
  }
  return true;
}

}  // namespace

SimplifiedPolygon simplify_polygon(const Polygon2& polygon, const SimplifyPolygonOptions& options,
                                   Monitor& monitor) {
  if (const std::string broken = broken_invariant(polygon); !broken.empty())
    throw InputError("the polygon is damaged: " + broken, "repair it, or read it again");
  if (polygon.components() == 0) throw InputError("the polygon has no components", "give one with an inside");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw InputError("tolerance is negative or not finite", "0 keeps the polygon");
  double tolerance = options.tolerance / 100 * bounding_box(polygon).longest_edge();
  bool lowered = false;
  for (int trial = 0; trial < 40 && tolerance > 0; ++trial, tolerance /= 2, lowered = true) {
    const std::vector<RawRing> rings = with_fewer_corners(polygon, tolerance, monitor);
    std::size_t corners = 0;
    for (const RawRing& ring : rings) corners += ring.points.size();
    if (corners == polygon.vertices.size()) break;
    try {
      NestedRings nested = nest(rings, monitor);
      if (same_nesting(polygon, nested.polygon, rings))
        return {std::move(nested.polygon), tolerance, lowered};
    } catch (const InputError&) {
      // They cross or touch, or one has passed another.
    }
  }
  return {polygon, 0, lowered};
}

}  // namespace ballflow::geometry
