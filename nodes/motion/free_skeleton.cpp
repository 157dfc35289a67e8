#include "motion/free_skeleton.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <tuple>

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }
Vec3 unit(Vec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return {1, 0, 0};
  v = {v.x / largest, v.y / largest, v.z / largest};
  return (1 / length(v)) * v;
}
/// A unit vector at a right angle to a unit vector.
Vec3 across(Vec3 u) {
  const Vec3 axis = std::abs(u.x) <= std::abs(u.y) && std::abs(u.x) <= std::abs(u.z) ? Vec3{1, 0, 0}
                    : std::abs(u.y) <= std::abs(u.z)                                 ? Vec3{0, 1, 0}
                                                                                     : Vec3{0, 0, 1};
  return unit(cross(u, axis));
}

bool is_infinite(const std::array<std::int32_t, 4>& cell) {
  return std::any_of(cell.begin(), cell.end(), [](std::int32_t v) { return v < 0; });
}

/// The point of equal power to four balls. Where doubles lose it, because the cell is flat, by exact numbers.
Vec3 equal_power(const PowerDiagram& diagram, const std::array<std::int32_t, 4>& cell) {
  const Vec3 origin = diagram.centers[at(cell[0])];
  const double weight = diagram.weights[at(cell[0])];
  std::array<Vec3, 3> a;
  std::array<double, 3> b;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = diagram.centers[at(cell[k + 1])] - origin;
    b[k] = 0.5 * (dot(a[k], a[k]) - diagram.weights[at(cell[k + 1])] + weight);
  }
  const double volume = dot(a[0], cross(a[1], a[2]));
  const Vec3 x =
      (1 / volume) * (b[0] * cross(a[1], a[2]) + b[1] * cross(a[2], a[0]) + b[2] * cross(a[0], a[1]));
  const double size = length(a[0]) * length(a[1]) * length(a[2]);
  if (std::abs(volume) > 1e-7 * size && is_finite(x)) return origin + x;
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto ball = [&](std::size_t k) {
    const Vec3 c = diagram.centers[at(cell[k])];
    return Exact::Weighted_point_3(Exact::Point_3(c.x, c.y, c.z), diagram.weights[at(cell[k])]);
  };
  const Exact::Point_3 p =
      Exact().construct_weighted_circumcenter_3_object()(ball(0), ball(1), ball(2), ball(3));
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

}  // namespace

FreeSkeleton::FreeSkeleton(const PowerDiagram& diagram, const Voids& voids, Monitor& monitor)
    : diagram_(diagram), voids_(voids), monitor_(monitor) {
  Box box;
  for (std::size_t i = 0; i < diagram.centers.size(); ++i) {
    const double r = std::sqrt(std::max(0.0, diagram.weights[i]));
    box.add(diagram.centers[i] - Vec3{r, r, r});
    box.add(diagram.centers[i] + Vec3{r, r, r});
  }
  middle_ = 0.5 * (box.lower + box.upper);
  const double reach = 0.5 * distance(box.lower, box.upper);
  far_ = reach > 0 ? 1.25 * reach : 1;
  if (diagram.dimension < 3) return;
  vertices_.resize(diagram.size());
  Lookout look(monitor);
  for (std::size_t c = 0; c < diagram.size(); ++c) {
    look(256);
    if (!is_infinite(diagram.cells[c])) vertices_[c] = equal_power(diagram, diagram.cells[c]);
  }
}

/// Where something leaves a point of the complement along which the power to all balls grows, until it is at
/// a vertex of the diagram, or beyond the sphere.
struct FreeSkeleton::Landing {
  std::vector<Vec3> points;  // the first is where it began
  std::int32_t cell = -1;    // of the vertex; -1: it is outside, at the last point
};

Vec3 FreeSkeleton::at_sphere(Vec3 from, Vec3 direction) const {
  const Vec3 arm = from - middle_;
  const double along = dot(arm, direction), rest = far_ * far_ - squared_length(arm);
  if (rest <= 0) return from;
  return from + (std::sqrt(along * along + rest) - along) * direction;
}

FreeSkeleton::Landing FreeSkeleton::land(Vec3 from, std::int32_t component) const {
  Landing landing{{from}, -1};
  const std::size_t n = diagram_.centers.size();
  const auto power = [&](std::size_t i, Vec3 x) {
    return squared_distance(x, diagram_.centers[i]) - diagram_.weights[i];
  };
  std::array<std::size_t, 4> balls{};
  std::size_t count = 0;
  double least = infinity;
  for (std::size_t i = 0; i < n; ++i) {
    if (const double p = power(i, from); p < least) least = p, balls[0] = i;
  }
  count = 1;
  Vec3 x = from;
  // Away from the ball, then, on the face between two cells, away from the point of its plane next to their
  // centers, then along an edge: the squared distance from that point is what the power grows with.
  while (count < 4) {
    const Vec3 base = diagram_.centers[balls[0]];
    std::array<Vec3, 2> axes;  // orthonormal, of the span of the differences of centers
    std::size_t spanned = 0;
    Vec3 nearest = base;  // of the face, to the first center
    for (std::size_t k = 1; k < count; ++k) {
      const Vec3 way = diagram_.centers[balls[k]] - base;
      Vec3 normal = way;
      for (std::size_t s = 0; s < spanned; ++s) normal = normal - dot(normal, axes[s]) * axes[s];
      normal = unit(normal);
      axes[spanned++] = normal;
      // The plane of equal power: 2 way . y = |way|^2 - w_k + w_0 for y = point - base.
      const double wanted =
          0.5 * (squared_length(way) - diagram_.weights[balls[k]] + diagram_.weights[balls[0]]);
      nearest = nearest + ((wanted - dot(way, nearest - base)) / dot(way, normal)) * normal;
    }
    Vec3 direction = x - nearest;
    for (std::size_t s = 0; s < spanned; ++s) direction = direction - dot(direction, axes[s]) * axes[s];
    if (!(length(direction) > 1e-9 * far_)) {  // at its least: any direction in the face will do
      direction = spanned == 0 ? Vec3{1, 0, 0} : spanned == 1 ? across(axes[0]) : cross(axes[0], axes[1]);
    }
    direction = unit(direction);
    // The power to another ball is less from the t on where a linear function is 0.
    double first = infinity;
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::find(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(count), i) !=
          balls.begin() + static_cast<std::ptrdiff_t>(count))
        continue;
      const double slope = 2 * dot(direction, base - diagram_.centers[i]);
      if (!(slope < 0)) continue;
      const double t = std::max(0.0, (power(i, x) - power(balls[0], x)) / -slope);
      if (t < first) first = t, next = i;
    }
    const Vec3 to = next == n ? at_sphere(x, direction) : x + first * direction;
    if (next == n || beyond(to)) {
      landing.points.push_back(at_sphere(x, direction));
      return landing;
    }
    landing.points.push_back(to);
    x = to;
    balls[count++] = next;
  }
  // The vertex, of many in one place any.
  double nearest = infinity;
  for (std::size_t c = 0; c < diagram_.size(); ++c) {
    if (is_infinite(diagram_.cells[c]) || voids_.number_of(c) != component) continue;
    if (const double d = squared_distance(vertices_[c], x); d < nearest) {
      nearest = d;
      landing.cell = static_cast<std::int32_t>(c);
    }
  }
  return landing;
}

/// The direction in which the edge that is dual to a facet of the hull leaves the vertex of its finite cell.
Vec3 FreeSkeleton::outward(std::size_t cell, std::size_t facet) const {
  std::array<Vec3, 3> corners;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != facet) corners[k++] = diagram_.centers[at(diagram_.cells[cell][i])];
  }
  Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (dot(normal, diagram_.centers[at(diagram_.cells[cell][facet])] - corners[0]) > 0) normal = -normal;
  return unit(normal);
}

Vec3 FreeSkeleton::on_sphere(Vec3 p) const { return middle_ + far_ * unit(p - middle_); }

/// Points on a sphere so large that chords between them stay free.
std::vector<Vec3> FreeSkeleton::around(Vec3 from, Vec3 to) const {
  // Points of a circle come by halving: chords of more than 30 degrees are too long.
  Vec3 u = unit(from - middle_), v = unit(to - middle_);
  if (distance(u, v) <= 0.5) return {middle_ + far_ * u, middle_ + far_ * v};
  Vec3 half = u + v;
  half = length(half) > 1e-6 ? unit(half) : across(u);
  std::vector<Vec3> first = around(from, middle_ + far_ * half), second = around(middle_ + far_ * half, to);
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

std::vector<Vec3> FreeSkeleton::way(Vec3 start, Vec3 goal, std::int32_t component) const {
  const auto leave = [&](Vec3 p) {
    return component == Voids::outer && beyond(p) ? Landing{{p, on_sphere(p)}, -1} : land(p, component);
  };
  const Landing begin = leave(start), end = leave(goal);
  std::vector<Vec3> way = begin.points;
  const auto append = [&](const std::vector<Vec3>& more) { way.insert(way.end(), more.begin(), more.end()); };
  if (begin.cell < 0 && end.cell < 0) {
    append(around(begin.points.back(), end.points.back()));
  } else {
    // Dijkstra's algorithm over vertices, and one place that is outside of everything. Vertices beyond the
    // sphere are in that place. Ties go to the lower number.
    const std::size_t cells = diagram_.size(), outside = cells;
    std::vector<double> lengths(cells + 1, infinity);
    std::vector<std::size_t> before(cells + 1, cells + 1);
    std::vector<Vec3> exits(cells +
                            1);  // of the step into or out of what is outside, where it is on the sphere
    const auto place_of = [&](std::size_t c) {
      return is_infinite(diagram_.cells[c]) || beyond(vertices_[c]) ? outside : c;
    };
    using Entry = std::tuple<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const std::size_t source = begin.cell < 0 ? outside : place_of(at(begin.cell)),
                      target = end.cell < 0 ? outside : place_of(at(end.cell));
    // Where the edges lie that join a vertex with the outside.
    std::vector<std::pair<std::size_t, Vec3>> outside_edges;
    std::vector<bool> done(cells + 1);
    const auto reach = [&](std::size_t to, double value, std::size_t from, Vec3 exit) {
      if (done[to])
        return;  // vertices in one place are at no distance: nothing goes back to the one it came from
      if (value < lengths[to] || (value == lengths[to] && from < before[to])) {
        lengths[to] = value;
        before[to] = from;
        exits[to] = exit;
        open.push({value, to});
      }
    };
    const auto exit_of = [&](std::size_t c, std::size_t k) {
      const std::size_t next = at(diagram_.neighbors[c][k]);
      const Vec3 direction =
          is_infinite(diagram_.cells[next]) ? outward(c, k) : unit(vertices_[next] - vertices_[c]);
      return at_sphere(vertices_[c], direction);
    };
    if (component == Voids::outer) {
      for (std::size_t c = 0; c < cells; ++c) {
        if (voids_.number_of(c) != component || place_of(c) == outside) continue;
        for (std::size_t k = 0; k < 4; ++k) {
          if (voids_.open(c, k) && place_of(at(diagram_.neighbors[c][k])) == outside)
            outside_edges.push_back({c, exit_of(c, k)});
        }
      }
    }
    lengths[source] = 0;
    before[source] = source;
    open.push({0, source});
    Lookout look(monitor_);
    while (!open.empty()) {
      const auto [value, c] = open.top();
      open.pop();
      if (done[c] || value != lengths[c]) continue;
      done[c] = true;
      look(64);
      if (c == target) break;
      if (c == outside) {
        for (const auto& [to, exit] : outside_edges)
          reach(to, value + far_ + distance(exit, vertices_[to]), outside, exit);
        continue;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        if (!voids_.open(c, k)) continue;
        const std::size_t to = place_of(at(diagram_.neighbors[c][k]));
        if (to == c) continue;
        if (to == outside) {
          const Vec3 exit = exit_of(c, k);
          reach(outside, value + far_ + distance(vertices_[c], exit), c, exit);
        } else {
          reach(to, value + distance(vertices_[c], vertices_[to]), c, {});
        }
      }
    }
    if (lengths[target] == infinity) return {};
    std::vector<std::size_t> steps{target};
    while (steps.back() != source) steps.push_back(before[steps.back()]);
    std::reverse(steps.begin(), steps.end());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i] != outside) {
        way.push_back(vertices_[steps[i]]);
        continue;
      }
      const Vec3 in =
          i == 0 ? (begin.cell < 0 ? begin.points.back() : on_sphere(begin.points.back())) : exits[outside];
      const Vec3 out = i + 1 == steps.size()
                           ? (end.cell < 0 ? end.points.back() : on_sphere(end.points.back()))
                           : exits[steps[i + 1]];
      append(around(in, out));
    }
  }
  for (std::size_t i = end.points.size(); i-- > 0;) way.push_back(end.points[i]);
  way.erase(std::unique(way.begin(), way.end()), way.end());
  return way;
}

}  // namespace ballflow::geometry
