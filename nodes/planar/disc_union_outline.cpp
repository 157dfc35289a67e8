#include "planar/disc_union_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/arctangent.hpp"
#include "base/disjoint_sets.hpp"
#include "base/space_order.hpp"
#include "exact/ball_predicates.hpp"
#include "exact/double_double.hpp"
#include "power/contribution.hpp"
#include "power/regular_triangulation_2.hpp"

namespace ballflow::geometry {
namespace {

using Triangle2 = RegularTriangulation2::Triangle;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The first three vertices are points far outside of all discs: so every disc is inside the convex hull,
/// also where all are on one line. They meet no disc, and no point of a disc is in their cells.
constexpr std::int32_t far_points = 3;

void require_discs(const Balls& discs) {
  if (const std::string broken = broken_invariant(discs); !broken.empty())
    throw InputError("the discs: " + broken, "repair or remove it");
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Vec3 c = discs.centers[i];
    if (c.z != 0) {
      throw InputError("ball " + std::to_string(i) + " has its center at z = " + std::to_string(c.z) +
                           ", and discs have z = 0",
                       "BallMesh and PowerDiagram take balls in space");
    }
    for (const double x : {c.x, c.y, discs.radii[i]}) {
      if (x == 0 || (std::abs(x) >= 1e-150 && std::abs(x) <= 1e150)) continue;
      char text[32];
      std::snprintf(text, sizeof text, "%g", x);
      throw InputError("disc " + std::to_string(i) + " has the coordinate or radius " + text +
                           ", whose square leaves the range of doubles",
                       "scale the discs, or set tiny numbers to 0");
    }
  }
}

Vec2 center_of(const Balls& discs, std::int32_t i) {
  return {discs.centers[at(i)].x, discs.centers[at(i)].y};
}

/// The triangulation of some of the discs; vertex far_points + k is disc ids[k], as far as it is not hidden.
struct Triangulated {
  std::vector<std::int32_t> ids;
  std::vector<Vec3> centers;  // of the vertices, far points included
  std::vector<double> weights;
  std::vector<Triangle2> triangles;

  Triangulated(const Balls& discs, std::span<const std::int32_t> order, Monitor& monitor) {
    Box box;
    for (const std::int32_t i : order) {
      const double r = discs.radii[at(i)];
      box.add(discs.centers[at(i)] - Vec3{r, r, 0});
      box.add(discs.centers[at(i)] + Vec3{r, r, 0});
    }
    const Vec3 c = 0.5 * (box.lower + box.upper);
    // Far enough also where the box is small for its distance from the origin.
    const double far =
        16 * std::max({box.longest_edge(), 0x1p-30 * std::abs(c.x), 0x1p-30 * std::abs(c.y), 1e-140});
    std::vector<PlaneSite> sites{
        {{c.x - far, c.y - far}, 0}, {{c.x + far, c.y - far}, 0}, {{c.x, c.y + far}, 0}};
    RegularTriangulation2 triangulation(sites[0], sites[1], sites[2]);
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k % 4096 == 0) monitor.step(static_cast<double>(k) / static_cast<double>(order.size()));
      const double r = discs.radii[at(order[k])];
      const PlaneSite site{center_of(discs, order[k]), r * r};
      if (triangulation.insert(site) == RegularTriangulation2::hidden) continue;
      ids.push_back(order[k]);
      sites.push_back(site);
    }
    for (const PlaneSite& site : sites) {
      centers.push_back(in_space(site.center));
      weights.push_back(site.weight);
    }
    triangles = triangulation.take_triangles();
  }
};

/// One disc of those with one center and the largest radius, along a curve through the plane.
std::vector<std::int32_t> in_order(const Balls& discs) {
  std::vector<std::int32_t> ids(discs.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::sort(ids.begin(), ids.end(), [&](std::int32_t i, std::int32_t j) {
    const Vec2 a = center_of(discs, i), b = center_of(discs, j);
    const double r = discs.radii[at(i)], s = discs.radii[at(j)];
    return a != b ? a < b : r != s ? r > s : i < j;
  });
  const auto last = std::unique(ids.begin(), ids.end(), [&](std::int32_t i, std::int32_t j) {
    return center_of(discs, i) == center_of(discs, j);
  });
  ids.erase(last, ids.end());
  const SpaceOrder place(bounding_box(discs.centers.span()));
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;
  for (const std::int32_t i : ids) keys.emplace_back(place(discs.centers[at(i)]), i);
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = keys[k].second;
  return ids;
}

/// Those of the discs, in their order, that contribute: a triangulation of these alone has no cell without an
/// area, so that it says the same whatever the order.
std::vector<std::int32_t> contributing(const Balls& discs, std::span<const std::int32_t> order,
                                       Monitor& monitor) {
  const Triangulated all(discs, order, monitor);
  const PlaneLinks links(all.triangles, all.centers.size());
  ContributionTest test;
  std::vector<Site> link;
  std::vector<std::int32_t> kept;
  Lookout look(monitor);
  for (std::size_t k = 0; k < all.ids.size(); ++k) {
    look(256);
    const std::size_t v = k + far_points;
    if (links.of(v).empty()) continue;
    link.clear();
    for (const std::int32_t other : links.of(v))
      link.push_back({all.centers[at(other)], all.weights[at(other)]});
    if (test.contributes({all.centers[v], all.weights[v]}, link)) kept.push_back(all.ids[k]);
  }
  return kept;
}

/// The dual complex, and the arcs that it leaves open.
class Arcs {
 public:
  Arcs(const Balls& discs, const Triangulated& t, Monitor& monitor)
      : discs_(discs),
        t_(t),
        predicates_(t.centers, t.weights),
        components_(t.centers.size()),
        filled_(t.triangles.size()),
        triangle_of_(t.centers.size(), -1) {
    Lookout look(monitor);
    for (std::size_t i = 0; i < t.triangles.size(); ++i) {
      look(64);
      const auto& v = t.triangles[i].vertices;
      for (const std::int32_t x : v) {
        if (x >= 0) triangle_of_[at(x)] = static_cast<std::int32_t>(i);
      }
      filled_[i] = v[0] >= far_points && v[1] >= far_points && v[2] >= far_points && predicates_.meets(v);
    }
    for (std::int32_t v = far_points; at(v) < t.centers.size(); ++v) {
      look(256);
      around(v);
    }
  }

  /// From the crossing of disc and `from`, to the left of the way from its center to that of `from`,
  /// counter-clockwise to the crossing with `to`, right of the way to that; no other disc for a whole circle.
  /// Vertices.
  struct Arc {
    std::int32_t disc, from = -1, to = -1;
  };
  std::vector<Arc> arcs;

  std::int32_t component(std::int32_t vertex) { return components_.root(vertex); }

 private:
  /// Whether the edge from v to the corner `next` of the triangle belongs to the complex; `other` is the
  /// triangle on its other side.
  bool in_complex(std::int32_t v, std::int32_t next, std::int32_t triangle, std::int32_t other) const {
    if (next < far_points) return false;
    if (filled_[at(triangle)] != 0 || filled_[at(other)] != 0) return true;
    const std::array<std::int32_t, 2> edge{v, next};
    if (!predicates_.meets(edge)) return false;
    for (const std::int32_t i : {triangle, other}) {
      for (const std::int32_t apex : t_.triangles[at(i)].vertices) {
        if (apex != v && apex != next && predicates_.attaches(edge, apex)) return false;
      }
    }
    return true;
  }

  void around(std::int32_t v) {
    // Its neighbours counter-clockwise; between neighbour k and the next is triangle k.
    neighbours_.clear();
    between_.clear();
    const std::int32_t first = triangle_of_[at(v)];
    std::int32_t triangle = first;
    do {
      const Triangle2& t = t_.triangles[at(triangle)];
      const std::size_t here = t.vertices[0] == v ? 0 : t.vertices[1] == v ? 1 : 2;
      neighbours_.push_back(t.vertices[(here + 1) % 3]);
      between_.push_back(triangle);
      triangle = t.neighbours[(here + 1) % 3];
    } while (triangle != first);
    const std::size_t n = neighbours_.size();
    members_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      if (!in_complex(v, neighbours_[k], between_[k], between_[(k + n - 1) % n])) continue;
      members_.push_back(k);
      components_.join(v, neighbours_[k]);
    }
    if (members_.empty()) {
      if (t_.weights[at(v)] > 0) arcs.push_back({v});
      return;
    }
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const std::size_t k = members_[m], next = members_[(m + 1) % members_.size()];
      if (next == (k + 1) % n && members_.size() > 1 && filled_[at(between_[k])] != 0) continue;
      arcs.push_back({v, neighbours_[k], neighbours_[next]});
    }
  }

  const Balls& discs_;
  const Triangulated& t_;
  BallPredicates predicates_;
  DisjointSets components_;
  std::vector<std::uint8_t> filled_;
  std::vector<std::int32_t> triangle_of_;  // of a vertex, one
  std::vector<std::int32_t> neighbours_, between_;
  std::vector<std::size_t> members_;
};

/// The circles of two discs that meet: how far from the center of the first their common chord is, along the
/// way to the second, negative beyond the center, and half its length.
struct Chord {
  double along, half, distance;
};
Chord chord_of(Vec2 a, double a_weight, Vec2 b, double b_weight) {
  using Real = DoubleDouble;
  // In units of a power of two about as large as they are: squares of squares are needed.
  int exponent = 0;
  std::frexp(std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), std::sqrt(a_weight), std::sqrt(b_weight)}),
             &exponent);
  const double unit = std::ldexp(1.0, exponent), inverse = std::ldexp(1.0, -exponent);
  a_weight *= inverse * inverse;
  b_weight *= inverse * inverse;
  const auto difference = [inverse](double to, double from) {
    const Real d = Real::sum(to, -from);
    return Real{inverse * d.high, inverse * d.low};
  };
  const Real x = difference(b.x, a.x), y = difference(b.y, a.y), dd = x * x + y * y;
  const double distance = std::sqrt(dd.high);
  const Real twice = dd + Real::sum(a_weight, -b_weight);  // 2 distance * along
  const Real half_squared = Real{a_weight, 0} - (twice * twice) / (dd * Real{4, 0});
  return {unit * (twice.high / (2 * distance)), unit * std::sqrt(std::max(half_squared.high, 0.0)),
          unit * distance};
}

/// Left of the way from the center of a to that of b; the same point for (a, b, left) and (b, a, right).
Vec2 crossing(const Triangulated& t, std::int32_t a, std::int32_t b, bool left) {
  if (a > b) return crossing(t, b, a, !left);
  const auto plane = [&t](std::int32_t v) { return Vec2{t.centers[at(v)].x, t.centers[at(v)].y}; };
  const Chord chord = chord_of(plane(a), t.weights[at(a)], plane(b), t.weights[at(b)]);
  const Vec2 u = (1 / chord.distance) * (plane(b) - plane(a));
  const double side = left ? chord.half : -chord.half;
  return plane(a) + chord.along * u + side * Vec2{-u.y, u.x};
}

double angle_of(const Triangulated& t, const Arcs::Arc& arc) {
  if (arc.from < 0) return 2 * pi;
  const auto plane = [&t](std::int32_t v) { return Vec2{t.centers[at(v)].x, t.centers[at(v)].y}; };
  const Vec2 c = plane(arc.disc), p = plane(arc.from) - c, q = plane(arc.to) - c;
  // From the one neighbour to the other: which half of the circle is decided exactly.
  double turn = 2 * pi;
  if (arc.from != arc.to) {
    const int side = orientation(c, plane(arc.from), plane(arc.to));
    const double angle = arctangent(std::abs(cross(p, q)), dot(p, q));
    turn = side > 0 ? angle : side < 0 ? 2 * pi - angle : pi;
  }
  const auto part = [&](std::int32_t other) {
    const Chord chord = chord_of(c, t.weights[at(arc.disc)], plane(other), t.weights[at(other)]);
    return arctangent(chord.half, chord.along);
  };
  return std::clamp(turn - part(arc.from) - part(arc.to), 0.0, 2 * pi);
}

}  // namespace

DiscOutline disc_union_outline(const Balls& discs, Monitor& monitor) {
  require_discs(discs);
  DiscOutline outline;
  outline.ring_offsets = {0};
  outline.component_offsets = {0};
  if (discs.size() == 0) return outline;
  PartMonitor first(monitor, 0, 0.4), second(monitor, 0.4, 0.7);
  std::vector<std::int32_t> kept = contributing(discs, in_order(discs), first);
  const Triangulated t(discs, kept, second);
  Arcs arcs(discs, t, monitor);

  // The arc that follows: it is of the disc where this one ends, and begins at the same crossing.
  std::vector<std::size_t> order(arcs.arcs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto id = [&t](std::int32_t vertex) { return vertex < 0 ? -1 : t.ids[at(vertex - far_points)]; };
  const auto key = [&](std::size_t i) { return std::pair(id(arcs.arcs[i].disc), id(arcs.arcs[i].from)); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
  const auto follower = [&](const Arcs::Arc& arc) {
    if (arc.to < 0) return std::size_t{0};
    const std::pair wanted(id(arc.to), id(arc.disc));
    const auto found = std::lower_bound(order.begin(), order.end(), wanted,
                                        [&](std::size_t i, const auto& value) { return key(i) < value; });
    return static_cast<std::size_t>(found - order.begin());
  };

  struct Ring {
    std::vector<std::size_t> arcs;  // places in `order`
    std::int32_t component = 0;
    double area = 0;
  };
  std::vector<Ring> rings;
  std::vector<std::uint8_t> used(order.size());
  Lookout look(monitor);
  for (std::size_t begin = 0; begin < order.size(); ++begin) {
    if (used[begin] != 0) continue;
    Ring ring;
    ring.component = arcs.component(arcs.arcs[order[begin]].disc);
    for (std::size_t i = begin; used[i] == 0;) {
      look(512);
      used[i] = 1;
      ring.arcs.push_back(i);
      const Arcs::Arc& arc = arcs.arcs[order[i]];
      if (arc.to < 0) break;
      i = follower(arc);
    }
    rings.push_back(std::move(ring));
  }

  // Arrays: the discs that have arcs, then rings one by one, which are then put into the order of components.
  std::vector<std::int32_t> with_arcs;
  for (const std::size_t i : order) with_arcs.push_back(id(arcs.arcs[i].disc));
  with_arcs.erase(std::unique(with_arcs.begin(), with_arcs.end()), with_arcs.end());
  std::vector<Vec2> centers;
  std::vector<double> radii;
  for (const std::int32_t i : with_arcs) {
    centers.push_back(center_of(discs, i));
    radii.push_back(discs.radii[at(i)]);
  }
  const auto outline_of = [&](std::span<const Ring* const> list) {
    std::vector<std::int32_t> arc_discs;
    std::vector<Vec2> begins;
    std::vector<double> angles;
    std::vector<std::int64_t> offsets{0};
    for (const Ring* ring : list) {
      for (const std::size_t i : ring->arcs) {
        const Arcs::Arc& arc = arcs.arcs[order[i]];
        const auto disc =
            std::lower_bound(with_arcs.begin(), with_arcs.end(), id(arc.disc)) - with_arcs.begin();
        arc_discs.push_back(static_cast<std::int32_t>(disc));
        const Vec2 right =
            centers[static_cast<std::size_t>(disc)] + Vec2{radii[static_cast<std::size_t>(disc)], 0};
        begins.push_back(arc.from < 0 ? right : crossing(t, arc.disc, arc.from, true));
        angles.push_back(angle_of(t, arc));
      }
      offsets.push_back(static_cast<std::int64_t>(begins.size()));
    }
    return DiscOutline{centers,
                       radii,
                       with_arcs,
                       std::move(arc_discs),
                       std::move(begins),
                       std::move(angles),
                       std::move(offsets),
                       {}};
  };
  std::vector<const Ring*> list;
  for (const Ring& ring : rings) list.push_back(&ring);
  {
    const DiscOutline in_any_order = outline_of(list);
    for (std::size_t r = 0; r < rings.size(); ++r) rings[r].area = signed_area(in_any_order, r);
  }
  // Of a component the ring with the largest area is the outer one: holes have negative areas.
  std::vector<std::size_t> by_component(rings.size());
  std::iota(by_component.begin(), by_component.end(), std::size_t{0});
  std::vector<std::size_t> first_ring(t.centers.size(), rings.size()), outer(t.centers.size(), rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t c = at(rings[r].component);
    if (first_ring[c] == rings.size()) first_ring[c] = r;
    if (outer[c] == rings.size() || rings[r].area > rings[outer[c]].area) outer[c] = r;
  }
  std::sort(by_component.begin(), by_component.end(), [&](std::size_t r, std::size_t s) {
    const std::size_t c = at(rings[r].component), d = at(rings[s].component);
    if (c != d) return first_ring[c] < first_ring[d];
    if ((outer[c] == r) != (outer[c] == s)) return outer[c] == r;
    return r < s;
  });
  list.clear();
  std::vector<std::int64_t> component_offsets{0};
  for (std::size_t k = 0; k < by_component.size(); ++k) {
    list.push_back(&rings[by_component[k]]);
    const bool last = k + 1 == by_component.size() ||
                      rings[by_component[k]].component != rings[by_component[k + 1]].component;
    if (last) component_offsets.push_back(static_cast<std::int64_t>(list.size()));
  }
  outline = outline_of(list);
  outline.component_offsets = std::move(component_offsets);
  return outline;
}

}  // namespace ballflow::geometry
