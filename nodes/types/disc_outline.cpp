#include "types/disc_outline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/arctangent.hpp"
#include "base/circle.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Arc {
  Vec2 center, begin, end;
  double radius, angle;
};

template <class Visit>
void for_each_arc(const DiscOutline& o, std::size_t ring, const Visit& visit) {
  const std::int64_t first = o.ring_offsets[ring], last = o.ring_offsets[ring + 1];
  for (std::int64_t i = first; i < last; ++i) {
    const auto disc = static_cast<std::size_t>(o.arc_discs[at(i)]);
    visit(Arc{o.centers[disc], o.arc_begins[at(i)], o.arc_begins[at(i + 1 < last ? i + 1 : first)],
              o.radii[disc], o.arc_angles[at(i)]});
  }
}

std::string broken_offsets(const Array<std::int64_t>& offsets, const char* name, std::size_t total) {
  if (offsets.empty() || offsets[0] != 0) return std::string(name) + " does not begin with 0";
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    if (offsets[i + 1] <= offsets[i])
      return std::string(name) + " does not grow after entry " + std::to_string(i);
  }
  if (offsets.back() != static_cast<std::int64_t>(total)) {
    return std::string(name) + " ends with " + std::to_string(offsets.back()) + ", not with " +
           std::to_string(total);
  }
  return {};
}

}  // namespace

double signed_area(const DiscOutline& outline, std::size_t ring) {
  double twice = 0;
  const Vec2 origin = outline.arc_begins[at(outline.ring_offsets[ring])];
  for_each_arc(outline, ring, [&](const Arc& arc) {
    twice += arc.radius * arc.radius * arc.angle + cross(arc.center - origin, arc.end - arc.begin);
  });
  return twice / 2;
}

double area(const DiscOutline& outline) {
  double sum = 0;
  for (std::size_t ring = 0; ring < outline.rings(); ++ring) sum += signed_area(outline, ring);
  return sum;
}

double perimeter(const DiscOutline& outline) {
  double sum = 0;
  for (std::size_t ring = 0; ring < outline.rings(); ++ring)
    for_each_arc(outline, ring, [&sum](const Arc& arc) { sum += arc.radius * arc.angle; });
  return sum;
}

Box bounding_box(const DiscOutline& outline) {
  Box box;  // a disc without an arc reaches no farther than those that have one
  for (std::size_t i = 0; i < outline.radii.size(); ++i) {
    const Vec3 r{outline.radii[i], outline.radii[i], 0}, c = in_space(outline.centers[i]);
    box.add(c - r);
    box.add(c + r);
  }
  return box;
}

std::vector<Vec2> points_on_ring(const DiscOutline& outline, std::size_t ring, double error) {
  std::vector<Vec2> points;
  for_each_arc(outline, ring, [&](const Arc& arc) {
    // The middle of a chord over the angle t is r (1 - cos(t / 2)), at most r t^2 / 8, from its arc.
    const double by_error = arc.angle * std::sqrt(arc.radius / (8 * error)), by_turn = arc.angle * (2 / pi);
    const double pieces = std::max(1.0, std::ceil(std::max(by_error, by_turn)));
    points.push_back(arc.begin);
    if (pieces == 1) return;
    const double from = arctangent(arc.begin.y - arc.center.y, arc.begin.x - arc.center.x);
    for (double k = 1; k < pieces; ++k) {
      const auto [c, s] = on_circle((from + arc.angle * (k / pieces)) / (2 * pi));
      points.push_back(arc.center + arc.radius * Vec2{c, s});
    }
  });
  const auto end = std::unique(points.begin(), points.end());
  points.erase(end, points.end());
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

Polygon2 polygon_in(const DiscOutline& outline, double error) {
  std::vector<Vec2> vertices;
  std::vector<std::int64_t> ring_offsets{0}, component_offsets{0};
  for (std::size_t k = 0; k < outline.components(); ++k) {
    for (std::int64_t i = outline.component_offsets[k]; i < outline.component_offsets[k + 1]; ++i) {
      const std::vector<Vec2> ring = points_on_ring(outline, at(i), error);
      const bool outer = i == outline.component_offsets[k];
      if (ring.size() < 3 || (outer ? signed_area(ring) <= 0 : signed_area(ring) >= 0)) {
        if (outer) break;
        continue;
      }
      vertices.insert(vertices.end(), ring.begin(), ring.end());
      ring_offsets.push_back(static_cast<std::int64_t>(vertices.size()));
    }
    const auto rings = static_cast<std::int64_t>(ring_offsets.size() - 1);
    if (rings > component_offsets.back()) component_offsets.push_back(rings);
  }
  return {std::move(vertices), std::move(ring_offsets), std::move(component_offsets)};
}

std::string broken_invariant(const DiscOutline& o) {
  const std::size_t n = o.radii.size(), arcs = o.arc_discs.size();
  if (o.centers.size() != n || o.discs.size() != n) return "centers, radii and discs differ in length";
  if (o.arc_begins.size() != arcs || o.arc_angles.size() != arcs)
    return "arc_discs, arc_begins and arc_angles differ in length";
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(o.centers[i]) || !(std::isfinite(o.radii[i]) && o.radii[i] > 0))
      return "disc " + std::to_string(i) + " is not finite, or has no radius";
    if (o.discs[i] < 0 || (i > 0 && o.discs[i] <= o.discs[i - 1])) return "discs do not ascend";
  }
  for (std::size_t i = 0; i < arcs; ++i) {
    if (o.arc_discs[i] < 0 || static_cast<std::size_t>(o.arc_discs[i]) >= n)
      return "arc " + std::to_string(i) + " is of disc " + std::to_string(o.arc_discs[i]) + " of " +
             std::to_string(n);
    if (!is_finite(o.arc_begins[i])) return "arc " + std::to_string(i) + " begins nowhere";
    if (!(o.arc_angles[i] >= 0 && o.arc_angles[i] <= 2 * pi))
      return "arc " + std::to_string(i) + " has the angle " + std::to_string(o.arc_angles[i]);
  }
  if (std::string broken = broken_offsets(o.ring_offsets, "ring_offsets", arcs); !broken.empty())
    return broken;
  return broken_offsets(o.component_offsets, "component_offsets", o.rings());
}

}  // namespace ballflow::geometry
