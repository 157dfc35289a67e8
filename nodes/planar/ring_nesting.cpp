#include "planar/ring_nesting.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>
#include <utility>

#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

constexpr std::int32_t none = -1;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::string place(Vec2 p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.9g, %.9g)", p.x, p.y);
  return text;
}

Point exact(Vec2 p) { return {p.x, p.y}; }

int side(Vec2 a, Vec2 b, Vec2 c) { return CGAL::orientation(exact(a), exact(b), exact(c)); }

/// The rings without repeated points, as one list of points.
struct Chain {
  const std::vector<RawRing>& rings;
  std::vector<Vec2> points;
  std::vector<std::int32_t> begins{0};  // of the rings
  std::vector<std::int32_t> ring_of;

  std::size_t count() const { return begins.size() - 1; }
  std::int32_t next(std::int32_t i) const {
    return i + 1 == begins[at(ring_of[at(i)]) + 1] ? begins[at(ring_of[at(i)])] : i + 1;
  }
  std::int32_t previous(std::int32_t i) const {
    return i == begins[at(ring_of[at(i)])] ? begins[at(ring_of[at(i)]) + 1] - 1 : i - 1;
  }
  Vec2 operator[](std::int32_t i) const { return points[at(i)]; }
  const std::string& name(std::int32_t i) const { return rings[at(ring_of[at(i)])].name; }
  std::string edge_name(std::int32_t i) const {
    return "edge " + std::to_string(i - begins[at(ring_of[at(i)])]) + " of " + name(i);
  }
};

/// A point that two edges have in common, but for rounding.
Vec2 common_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 u = b - a, v = d - c;
  const double determinant = cross(u, v);
  for (const Vec2 p : {c, d}) {
    if (side(a, b, p) == 0) return p;
  }
  return determinant == 0 ? a : a + (cross(c - a, v) / determinant) * u;
}

[[noreturn]] void refuse_common_point(const Chain& chain, std::int32_t e, std::int32_t f) {
  if (f < e) std::swap(e, f);
  const Vec2 a = chain[e], b = chain[chain.next(e)], c = chain[f], d = chain[chain.next(f)];
  const bool crossing = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  throw InputError(chain.edge_name(e) + " and " + chain.edge_name(f) + (crossing ? " cross" : " touch") +
                       " at " + place(common_point(a, b, c, d)),
                   crossing ? "remove the crossing, or make the union of the overlapping parts first"
                            : "move the rings apart, or join them: rings have no point in common");
}

/// Goes through the vertices from left to right (and upwards where they are on one vertical line) and keeps
/// the edges above the current place in their order (Shamos and Hoey 1976): as long as only neighbours in
/// this order have been found without a common point, no edges to the left have one.
class Sweep {
 public:
  Sweep(const Chain& chain, Monitor& monitor) : chain_(chain), active_(Below{this}), look_(monitor) {
    const std::size_t n = chain.points.size();
    where_.resize(n, active_.end());
    parent.assign(chain.count(), none);
    depth.assign(chain.count(), 0);
    left_most_.assign(chain.count(), none);
    std::vector<std::int32_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
      look_(1);
      return std::pair(chain[i], i) < std::pair(chain[j], j);
    });
    for (std::size_t k = 1; k < n; ++k) {
      if (chain[order[k - 1]] == chain[order[k]]) refuse_equal(order[k - 1], order[k]);
    }
    for (const std::int32_t i : order) {
      std::int32_t& first = left_most_[at(chain.ring_of[at(i)])];
      if (first == none) first = i;
    }
    for (std::size_t r = 0; r < chain.count(); ++r) counter_clockwise.push_back(turns_left(left_most_[r]));
    for (const std::int32_t i : order) visit(i);
  }

  std::vector<std::int32_t> parent, depth;      // of every ring: the one around it, and how many are
  std::vector<std::uint8_t> counter_clockwise;  // of every ring

 private:
  /// Edge i runs from vertex i to the next; its ends from left to right.
  std::pair<Vec2, Vec2> ends(std::int32_t i) const {
    return std::minmax({chain_[i], chain_[chain_.next(i)]});
  }
  bool runs_right(std::int32_t i) const { return chain_[i] < chain_[chain_.next(i)]; }

  /// Of two edges that are both above or below one place and have no point in common.
  struct Below {
    const Sweep* sweep;
    bool operator()(std::int32_t i, std::int32_t j) const {
      if (i == j) return false;
      const auto [a, b] = sweep->ends(i);
      const auto [c, d] = sweep->ends(j);
      if (a < c || a == c) {
        const int begin = side(a, b, c);
        return begin != 0 ? begin > 0 : side(a, b, d) > 0;
      }
      const int begin = side(c, d, a);
      return begin != 0 ? begin < 0 : side(c, d, b) < 0;
    }
  };
  using Active = std::set<std::int32_t, Below>;

  [[noreturn]] void refuse_equal(std::int32_t i, std::int32_t j) const {
    const bool one = chain_.ring_of[at(i)] == chain_.ring_of[at(j)];
    throw InputError((one ? chain_.name(i) + " touches itself"
                          : chain_.name(std::min(i, j)) + " and " + chain_.name(std::max(i, j)) + " touch") +
                         " at " + place(chain_[i]),
                     "move the rings apart, or join them: rings have no point in common");
  }

  /// At the left-most point of a ring: refuses a spike, which has no area.
  bool turns_left(std::int32_t i) const {
    const std::int32_t before = chain_.previous(i);
    const int turn = side(chain_[before], chain_[i], chain_[chain_.next(i)]);
    if (turn == 0) refuse_common_point(chain_, before, i);
    return turn > 0;
  }

  void require_apart(std::int32_t i, std::int32_t j) const {
    const Vec2 a = chain_[i], b = chain_[chain_.next(i)], c = chain_[j], d = chain_[chain_.next(j)];
    if (chain_.next(i) == j || chain_.next(j) == i) {
      // A common end. Folded onto each other they have more in common.
      const Vec2 middle = chain_.next(i) == j ? b : a, p = chain_.next(i) == j ? a : b,
                 q = chain_.next(i) == j ? d : c;
      if (side(p, middle, q) != 0) return;
      // On one line: apart if the common end is between the others.
      if ((p < middle) != (q < middle)) return;
      refuse_common_point(chain_, i, j);
    }
    if (CGAL::do_intersect(Kernel::Segment_2(exact(a), exact(b)), Kernel::Segment_2(exact(c), exact(d))))
      refuse_common_point(chain_, i, j);
  }

  void visit(std::int32_t i) {
    look_(64);
    const std::int32_t before = chain_.previous(i);
    std::array<std::int32_t, 2> begin{}, end{};  // edges that begin and end here
    std::size_t begins = 0, ends = 0;
    (runs_right(i) ? begin[begins++] : end[ends++]) = i;
    (runs_right(before) ? end[ends++] : begin[begins++]) = before;
    for (std::size_t k = 0; k < ends; ++k) remove(end[k]);
    for (std::size_t k = 0; k < begins; ++k) insert(begin[k]);
    if (left_most_[at(chain_.ring_of[at(i)])] == i) {
      auto lower = where_[at(begin[0])];
      if (active_.key_comp()(begin[1], begin[0])) lower = where_[at(begin[1])];
      nest_ring(chain_.ring_of[at(i)], lower);
    }
  }

  /// The ring whose lowest edge at its left-most point is `lower`.
  void nest_ring(std::int32_t ring, Active::const_iterator lower) {
    if (lower == active_.begin()) return;
    const std::int32_t edge = *std::prev(lower), other = chain_.ring_of[at(edge)];
    const bool inside_above = runs_right(edge) == (counter_clockwise[at(other)] != 0);
    parent[at(ring)] = inside_above ? other : parent[at(other)];
    depth[at(ring)] = parent[at(ring)] == none ? 0 : depth[at(parent[at(ring)])] + 1;
  }

  void insert(std::int32_t edge) {
    const auto [here, fresh] = active_.insert(edge);
    if (!fresh) refuse_common_point(chain_, *here, edge);
    where_[at(edge)] = here;
    if (here != active_.begin()) require_apart(*std::prev(here), edge);
    if (std::next(here) != active_.end()) require_apart(edge, *std::next(here));
  }

  void remove(std::int32_t edge) {
    const auto here = where_[at(edge)];
    if (here != active_.begin() && std::next(here) != active_.end())
      require_apart(*std::prev(here), *std::next(here));
    active_.erase(here);
    where_[at(edge)] = active_.end();
  }

  const Chain& chain_;
  Active active_;
  std::vector<Active::const_iterator> where_;
  std::vector<std::int32_t> left_most_;  // vertex of every ring
  Lookout look_;
};

Chain chain_of(const std::vector<RawRing>& rings, std::int64_t& repeated) {
  Chain chain{rings, {}, {0}, {}};
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<Vec2>& points = rings[r].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 p{points[i].x + 0.0, points[i].y + 0.0};  // -0 becomes 0
      // Written so that nan fails.
      if (!(std::abs(p.x) <= 1e100 && std::abs(p.y) <= 1e100)) {
        throw InputError("point " + std::to_string(i) + " of " + rings[r].name + " is " + place(p),
                         "coordinates are finite and at most 1e100 in size");
      }
      const bool first = static_cast<std::int32_t>(chain.points.size()) == chain.begins.back();
      if (!first && chain.points.back() == p) {
        ++repeated;
        continue;
      }
      chain.points.push_back(p);
      chain.ring_of.push_back(static_cast<std::int32_t>(r));
    }
    const auto begin = at(chain.begins.back());
    bool closed = false;
    while (chain.points.size() > begin + 1 && chain.points.back() == chain.points[begin]) {
      chain.points.pop_back();
      chain.ring_of.pop_back();
      repeated += closed;
      closed = true;
    }
    const std::size_t left = chain.points.size() - begin;
    if (left < 3) {
      throw InputError(rings[r].name + " has " + std::to_string(left) + " distinct point" +
                           (left == 1 ? "" : "s") + ", a ring needs three",
                       "remove it, or add its other points");
    }
    chain.begins.push_back(index_of(chain.points.size(), "points of polygons"));
  }
  return chain;
}

void require_roles(const std::vector<RawRing>& rings, const Sweep& sweep) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const bool hole = sweep.depth[r] % 2 == 1;
    if (rings[r].role == RingRole::open || (rings[r].role == RingRole::hole) == hole) continue;
    throw InputError(
        hole ? rings[r].name + " is an outer ring, and lies inside " + rings[at(sweep.parent[r])].name
             : rings[r].name + " is a hole, and lies in no ring that it could be a hole of",
        hole ? "overlapping polygons are one: make their union first"
             : "correct the order of the rings, or remove it");
  }
}

}  // namespace

NestedRings nest(std::vector<RawRing> rings, Monitor& monitor) {
  NestedRings result;
  const Chain chain = chain_of(rings, result.repeated_points);
  const Sweep sweep(chain, monitor);
  require_roles(rings, sweep);
  std::vector<std::vector<std::int32_t>> holes(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (sweep.depth[r] % 2 == 1) holes[at(sweep.parent[r])].push_back(static_cast<std::int32_t>(r));
  }
  std::vector<Vec2> vertices;
  std::vector<std::int64_t> ring_offsets{0}, component_offsets{0};
  vertices.reserve(chain.points.size());
  const auto add = [&](std::int32_t ring, bool counter_clockwise) {
    const auto first = chain.points.begin() + chain.begins[at(ring)],
               last = chain.points.begin() + chain.begins[at(ring) + 1];
    vertices.insert(vertices.end(), first, last);
    if ((sweep.counter_clockwise[at(ring)] != 0) != counter_clockwise) {
      ++result.turned_rings;
      std::reverse(vertices.end() - (last - first) + 1, vertices.end());  // the first point stays
    }
    ring_offsets.push_back(static_cast<std::int64_t>(vertices.size()));
  };
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (sweep.depth[r] % 2 == 1) continue;
    add(static_cast<std::int32_t>(r), true);
    for (const std::int32_t hole : holes[r]) add(hole, false);
    component_offsets.push_back(static_cast<std::int64_t>(ring_offsets.size() - 1));
  }
  result.polygon = {std::move(vertices), std::move(ring_offsets), std::move(component_offsets)};
  return result;
}

}  // namespace ballflow::geometry
