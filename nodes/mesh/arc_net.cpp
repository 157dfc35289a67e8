#include "mesh/arc_net.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/arctangent.hpp"
#include "base/circle.hpp"
#include "power/union_arcs.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double angle_between(Vec3 a, Vec3 b) { return arctangent(length(cross(a, b)), dot(a, b)); }

/// A unit vector orthogonal to a unit vector; that of the mirror image is mirrored.
Vec3 orthogonal(Vec3 axis) {
  const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
  const Vec3 least = x <= y && x <= z ? Vec3{std::copysign(1.0, axis.x), 0, 0}
                     : y <= z         ? Vec3{0, std::copysign(1.0, axis.y), 0}
                                      : Vec3{0, 0, std::copysign(1.0, axis.z)};
  const Vec3 v = least - dot(least, axis) * axis;
  return 1 / length(v) * v;
}

/// How far an arc of a circle with that radius is from its chord.
double sagitta(double radius, double angle) { return radius * (1 - on_circle(angle / (4 * pi))[0]); }

}  // namespace

std::int32_t ArcNet::add_point(Vec3 position, std::array<std::int32_t, 3> balls) {
  points_.push_back(position);
  labels_.push_back(balls);
  return static_cast<std::int32_t>(points_.size() - 1);
}

Vec3 ArcNet::point_of(const Arc& arc, double angle) const {
  const auto [c, s] = on_circle(angle / (2 * pi));
  return arc.middle + (c * arc.start + s * arc.side);
}

void ArcNet::cut(Arc& arc, double error, bool whole) {
  const double q = std::min(1.0, error / arc.radius), total = arc.knots.back().angle;
  // The cosine of half the angle of a chord is 1 - q.
  const double step = std::min(pi / 3, 4 * arctangent(std::sqrt(q), std::sqrt(2 - q)));
  // A small surplus, so that rounding does not add a chord to an arc of so many steps exactly.
  auto pieces = static_cast<std::int64_t>(std::ceil(total / step * (1 - 1e-9)));
  pieces = std::max<std::int64_t>(pieces, whole ? 6 : 2);
  if (whole) pieces += pieces % 2;
  const Knot last = arc.knots.back();
  arc.knots.pop_back();
  for (std::int64_t k = 1; k < pieces; ++k) {
    const double angle = total * (static_cast<double>(k) / static_cast<double>(pieces));
    arc.knots.push_back({add_point(point_of(arc, angle), {arc.balls[0], arc.balls[1], -1}), angle});
  }
  arc.knots.push_back(last);
}

void ArcNet::bisect(std::int32_t index, std::int32_t knot) {
  Arc& arc = arcs_[at(index)];
  const double angle = (arc.knots[at(knot)].angle + arc.knots[at(knot + 1)].angle) / 2;
  const std::int32_t point = add_point(point_of(arc, angle), {arc.balls[0], arc.balls[1], -1});
  arc.knots.insert(arc.knots.begin() + knot + 1, Knot{point, angle});
}

void ArcNet::add_chords(std::int32_t ball, std::int32_t index, std::vector<Chord>& chords) const {
  const Arc& arc = arcs_[at(index)];
  const bool along = arc.forward == (ball == arc.balls[0]);
  for (std::size_t k = 0; k + 1 < arc.knots.size(); ++k) {
    const Knot &a = arc.knots[k], &b = arc.knots[k + 1];
    Chord chord{a.point, b.point, index, static_cast<std::int32_t>(k),
                sagitta(arc.radius, b.angle - a.angle)};
    if (!along) std::swap(chord.from, chord.to);
    chords.push_back(chord);
  }
}

std::optional<ArcNet> ArcNet::of(const PowerDiagram& diagram, const SimplicialComplex& complex, double error,
                                 double extent, Monitor& monitor) {
  const double tiny = std::ldexp(extent, -44);
  std::vector<ExposedSide> sides = exposed_sides(complex, diagram, monitor);
  ArcNet net;
  net.points_.reserve(4 * sides.size());
  Lookout look(monitor);
  for (const ExposedSide& side : sides) {
    look(4096);
    net.add_point(boundary_vertex(complex, side), complex.triangles[at(side.triangle)]);
  }
  // The two vertices of one triangle in an order that does not depend on which side is which.
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].triangle != sides[s - 1].triangle || !before(net.points_[s], net.points_[s - 1])) continue;
    std::swap(sides[s], sides[s - 1]);
    std::swap(net.points_[s], net.points_[s - 1]);
  }
  const std::vector<UnionArc> found = union_arcs(complex, sides, monitor);
  const auto center = [&](std::int32_t ball) { return complex.centers[at(ball)]; };
  const auto weight = [&](std::int32_t ball) { return complex.weights[at(ball)]; };

  for (const UnionArc& arc : found) {
    look(256);
    const auto [i, j] = complex.edges[at(arc.edge)];
    const Vec3 ij = center(j) - center(i);
    const double d = length(ij);
    const Vec3 axis = 1 / d * ij;
    const double foot = (d + (weight(i) - weight(j)) / d) / 2;  // from c_i to the plane of the circle
    Arc made;
    made.balls = {i, j};
    made.middle = center(i) + foot * axis;
    const double rho2 = weight(i) - foot * foot;
    if (!(rho2 > tiny * tiny)) return {};
    made.radius = std::sqrt(rho2);
    if (arc.whole()) {
      made.start = orthogonal(axis);
      made.side = cross(axis, made.start);
      made.start = made.radius * made.start;
      made.side = made.radius * made.side;
      // Turned so that a mirrored circle has the same knots in the same order.
      if (before(made.middle - made.side, made.middle + made.side)) {
        made.side = -made.side;
        made.forward = false;
      }
      made.knots = {{-1, 0}, {-1, 2 * pi}};
    } else {
      const auto radial = [&](Vec3 p) {
        const Vec3 v = p - center(i), u = v - dot(v, axis) * axis;
        return 1 / length(u) * u;
      };
      const Vec3 from = net.points_[at(arc.from)], to = net.points_[at(arc.to)];
      if (!(distance(from, to) > tiny)) return {};
      const Vec3 start = radial(from), end = radial(to);
      // The angle itself from the ends, which is precise where the arc is short; that it is short and not all
      // but a whole turn from the apices, whose turn is decided exactly.
      double turn = 2 * pi;
      const Vec3 da = radial(center(arc.from_apex)), db = radial(center(arc.to_apex));
      if (arc.from_apex != arc.to_apex) {
        turn = arc.turn == 0 ? pi : angle_between(da, db);
        if (arc.turn < 0) turn = 2 * pi - turn;
      }
      const double rough = turn - angle_between(da, start) - angle_between(end, db);
      made.forward = arc.from < arc.to;
      const Vec3 begin = made.forward ? start : end, finish = made.forward ? end : start;
      const double sine = dot(cross(axis, begin), finish);
      double angle = arctangent(made.forward ? sine : -sine, dot(start, end));
      while (angle < rough - pi) angle += 2 * pi;
      while (angle > rough + pi) angle -= 2 * pi;
      if (!(angle > 0 && angle < 2 * pi)) return {};
      made.start = made.radius * begin;
      made.side = (made.forward ? made.radius : -made.radius) * cross(axis, begin);
      made.knots = {{std::min(arc.from, arc.to), 0}, {std::max(arc.from, arc.to), angle}};
    }
    net.arcs_.push_back(std::move(made));
  }
  // Arcs of an edge in an order that does not depend on the sense of turning.
  std::sort(net.arcs_.begin(), net.arcs_.end(), [&look](const Arc& a, const Arc& b) {
    look(16);
    return std::tuple(a.balls, a.knots.front().point, a.knots.back().point) <
           std::tuple(b.balls, b.knots.front().point, b.knots.back().point);
  });
  for (Arc& arc : net.arcs_) {
    look(256);
    const bool whole = arc.knots.front().point < 0;
    if (whole)
      arc.knots.front().point = arc.knots.back().point =
          net.add_point(arc.middle + arc.start, {arc.balls[0], arc.balls[1], -1});
    net.cut(arc, error, whole);
  }
  net.arcs_of_ = lists_of<std::int32_t>(complex.centers.size(), [&](auto&& put) {
    for (std::size_t a = 0; a < net.arcs_.size(); ++a) {
      for (const std::int32_t ball : net.arcs_[a].balls) put(at(ball), static_cast<std::int32_t>(a));
    }
  });
  return net;
}

}  // namespace ballflow::geometry
