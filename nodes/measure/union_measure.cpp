#include "measure/union_measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/arctangent.hpp"
#include "power/power_diagram.hpp"
#include "power/union_arcs.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Vec3 unit_or_zero(Vec3 v) {
  const double l = length(v);
  return l > 0 ? 1 / l * v : Vec3{};
}

std::array<double, 3> components(Vec3 v) { return {v.x, v.y, v.z}; }

/// The integrals over the edges of the patch of one sphere, see the header.
struct Patch {
  std::int64_t link = 0;          // Euler characteristic of the link
  double curvature = 0;           // sum of h * angle: minus the integral of the geodesic curvature
  double turning = 0;             // sum of exterior angles
  std::array<double, 3> first{};  // of v_a
  std::array<std::array<double, 3>, 3> second{};                // [a][b] of n_b v_a
  std::array<std::array<std::array<double, 3>, 3>, 3> third{};  // [a][b][c] of n_b n_c v_a
};

/// An arc of the circle { n : n.axis = h } of the unit sphere, run through around `axis`; the patch lies
/// where n.axis < h. Cosine and sine of its angle are given beside the angle: they come from coordinates.
struct Arc {
  Vec3 axis, start;  // unit vectors; `start` points from the axis to the beginning of the arc
  double h = 0, angle = 0, cosine = 1, sine = 0;
};

void add(Patch& patch, const Arc& arc) {
  const double h = arc.h, rho = std::sqrt(std::max(0.0, 1 - h * h));
  patch.curvature += h * arc.angle;
  // moment[p][q]: integral of cos^p sin^q over the arc, p + q <= 3.
  const double t = arc.angle, c = arc.cosine, s = arc.sine, c3 = c * c * c, s3 = s * s * s;
  const double moment[4][4] = {{t, 1 - c, (t - s * c) / 2, (1 - c) - (1 - c3) / 3},
                               {s, s * s / 2, s3 / 3, 0},
                               {(t + s * c) / 2, (1 - c3) / 3, 0, 0},
                               {s - s3 / 3, 0, 0, 0}};
  // In the frame (axis, start, axis x start): n = (h, rho cos, rho sin), v = (rho, -h cos, -h sin).
  const std::array<double, 3> n = {h, rho, rho}, v = {rho, -h, -h};
  const std::array<std::array<double, 3>, 3> frame = {components(arc.axis), components(arc.start),
                                                      components(cross(arc.axis, arc.start))};
  const auto integral = [&](std::initializer_list<std::size_t> indices) {
    std::size_t cosines = 0, sines = 0;
    for (const std::size_t i : indices) {
      cosines += i == 1;
      sines += i == 2;
    }
    return rho * moment[cosines][sines];  // the arc length is rho times the angle
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = v[i] * integral({i});
    std::array<double, 3> pairs{};                   // over b, for this i
    std::array<std::array<double, 3>, 3> triples{};  // over b and c
    for (std::size_t j = 0; j < 3; ++j) {
      const double two = v[i] * n[j] * integral({i, j});
      for (std::size_t b = 0; b < 3; ++b) pairs[b] += two * frame[j][b];
      for (std::size_t k = 0; k < 3; ++k) {
        const double three = v[i] * n[j] * n[k] * integral({i, j, k});
        for (std::size_t b = 0; b < 3; ++b) {
          for (std::size_t d = 0; d < 3; ++d) triples[b][d] += three * frame[j][b] * frame[k][d];
        }
      }
    }
    for (std::size_t a = 0; a < 3; ++a) {
      patch.first[a] += one * frame[i][a];
      for (std::size_t b = 0; b < 3; ++b) {
        patch.second[a][b] += pairs[b] * frame[i][a];
        for (std::size_t d = 0; d < 3; ++d) patch.third[a][b][d] += triples[b][d] * frame[i][a];
      }
    }
  }
}

class Measure {
 public:
  Measure(const SimplicialComplex& complex, Monitor& monitor)
      : complex_(complex), monitor_(monitor), patches_(complex.centers.size()) {
    // Coordinates relative to the middle of the balls: moments about a far origin would cancel.
    Box box;
    for (const std::int32_t v : complex_.vertices) box.add(complex_.centers[at(v)]);
    if (!box.empty()) origin_ = 0.5 * (box.lower + box.upper);
  }

  /// `diagram` may be null.
  MassProperties run(const PowerDiagram* diagram) {
    count_links();
    find_corners(diagram);
    find_arcs();
    return sum();
  }

 private:
  Vec3 center(std::int32_t ball) const { return complex_.centers[at(ball)]; }
  double weight(std::int32_t ball) const { return complex_.weights[at(ball)]; }

  void count_links() {
    for (const auto& e : complex_.edges) {
      for (const std::int32_t ball : e) patches_[at(ball)].link += 1;
    }
    for (const auto& t : complex_.triangles) {
      for (const std::int32_t ball : t) patches_[at(ball)].link -= 1;
    }
    for (const auto& t : complex_.tetrahedra) {
      for (const std::int32_t ball : t) patches_[at(ball)].link += 1;
    }
  }

  /// The corners of the patches, and the exterior angles there: a patch lies outside of two circles, so the
  /// angle is that between their normals.
  void find_corners(const PowerDiagram* diagram) {
    PartMonitor part(monitor_, 0, 0.4);
    sides_ = diagram != nullptr ? exposed_sides(complex_, *diagram, part) : exposed_sides(complex_, part);
    corners_.reserve(sides_.size());
    Lookout look(monitor_);
    for (const ExposedSide& side : sides_) {
      look(1000);
      const Vec3 w = boundary_vertex(complex_, side);
      corners_.push_back(w);
      const auto& t = complex_.triangles[at(side.triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 n = unit_or_zero(w - center(t[k]));
        const Vec3 a = outward(n, t[k], t[(k + 1) % 3]), b = outward(n, t[k], t[(k + 2) % 3]);
        patches_[at(t[k])].turning += arctangent(length(cross(a, b)), dot(a, b));
      }
    }
  }
  /// At the point n of the unit sphere around ball i: the direction along the sphere, into ball j, that is
  /// orthogonal to the circle of the two.
  Vec3 outward(Vec3 n, std::int32_t i, std::int32_t j) const {
    const Vec3 axis = center(j) - center(i);
    return axis - dot(axis, n) * n;
  }

  void find_arcs() {
    PartMonitor part(monitor_, 0.5, 0.9);
    for (const UnionArc& arc : union_arcs(complex_, sides_, part)) add_arc(arc);
  }

  void add_arc(const UnionArc& arc) {
    const auto [i, j] = complex_.edges[at(arc.edge)];
    const Vec3 ij = center(j) - center(i);
    const double d = length(ij);
    const Vec3 axis = 1 / d * ij;
    const double foot = (d + (weight(i) - weight(j)) / d) / 2;  // from c_i to the plane of the circle
    const auto add_to_both = [&](Vec3 start, Vec3 end, double angle) {
      const double cosine = dot(start, end), sine = dot(cross(axis, start), end);
      const double ri = std::sqrt(weight(i)), rj = std::sqrt(weight(j));
      const auto part = [](double of, double whole) {
        return whole > 0 ? std::clamp(of / whole, -1.0, 1.0) : 1.0;
      };
      add(patches_[at(i)], {axis, start, part(foot, ri), angle, cosine, sine});
      add(patches_[at(j)], {-axis, end, part(d - foot, rj), angle, cosine, sine});
    };
    if (arc.whole()) {
      const Vec3 any = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
      const Vec3 start = unit_or_zero(any - dot(any, axis) * axis);
      return add_to_both(start, start, 2 * pi);
    }
    const Vec3 da = radial(arc.from_apex, i, axis), db = radial(arc.to_apex, i, axis);
    const Vec3 start = radial(corners_[at(arc.from)], i, axis), end = radial(corners_[at(arc.to)], i, axis);
    // From apex to apex; which half it is in is decided exactly. Then back to the corners.
    double turn = 2 * pi;
    if (arc.from_apex != arc.to_apex) {
      turn = std::abs(arctangent(dot(cross(axis, da), db), dot(da, db)));
      if (arc.turn == 0) turn = pi;
      if (arc.turn < 0) turn = 2 * pi - turn;
    }
    const double angle = turn - angle_between(da, start) - angle_between(end, db);
    add_to_both(start, end, std::max(0.0, angle));
  }
  /// Unit vector from the line through c_i to a point.
  Vec3 radial(Vec3 p, std::int32_t i, Vec3 axis) const {
    const Vec3 v = p - center(i);
    return unit_or_zero(v - dot(v, axis) * axis);
  }
  Vec3 radial(std::int32_t ball, std::int32_t i, Vec3 axis) const { return radial(center(ball), i, axis); }
  static double angle_between(Vec3 a, Vec3 b) { return arctangent(length(cross(a, b)), dot(a, b)); }

  MassProperties sum() const {
    MassProperties result;
    Vec3 moment, closure;
    std::array<std::array<double, 3>, 3> product{};  // integral of x_a x_b
    for (const std::int32_t ball : complex_.vertices) {
      const Patch& patch = patches_[at(ball)];
      const double w = weight(ball), r = std::sqrt(w);
      const double solid = std::clamp(
          2 * pi * static_cast<double>(2 - patch.link) + patch.curvature - patch.turning, 0.0, 4 * pi);
      const Vec3 c = center(ball) - origin_;
      const std::array<double, 3> x = components(c);
      std::array<double, 3> n{}, mc{};                 // N, and M c
      std::array<std::array<double, 3>, 3> m{}, tc{};  // M, and T c
      for (std::size_t a = 0; a < 3; ++a) n[a] = -patch.first[a] / 2;
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
          m[a][b] = ((a == b ? solid : 0) - patch.second[a][b]) / 3;
          mc[a] += m[a][b] * x[b];
          for (std::size_t k = 0; k < 3; ++k) {
            const double t = ((a == b ? n[k] : 0) + (a == k ? n[b] : 0) - patch.third[a][b][k]) / 4;
            tc[a][b] += t * x[k];
          }
        }
      }
      const Vec3 normal{n[0], n[1], n[2]};
      const double reach = dot(c, normal) + r * solid;  // integral of x.n over the unit sphere
      result.area += w * solid;
      result.volume += w * reach / 3;
      moment = moment + w / 2 * ((squared_length(c) + w) * normal + 2 * r * Vec3{mc[0], mc[1], mc[2]});
      closure = closure + w * normal;
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
          product[a][b] += w / 5 *
                           (x[a] * x[b] * reach + r * x[a] * (mc[b] + r * n[b]) +
                            r * x[b] * (mc[a] + r * n[a]) + w * (tc[a][b] + r * m[a][b]));
        }
      }
    }
    result.volume = std::max(0.0, result.volume);
    if (result.area > 0) result.closure_error = length(closure) / result.area;
    if (!(result.volume > 0)) return result;
    const Vec3 mean = 1 / result.volume * moment;
    result.center_of_mass = origin_ + mean;
    const std::array<double, 3> g = components(mean);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) product[a][b] -= result.volume * g[a] * g[b];
    }
    const double trace = product[0][0] + product[1][1] + product[2][2];
    result.inertia = {trace - product[0][0],
                      trace - product[1][1],
                      trace - product[2][2],
                      -(product[0][1] + product[1][0]) / 2,
                      -(product[0][2] + product[2][0]) / 2,
                      -(product[1][2] + product[2][1]) / 2};
    return result;
  }

  const SimplicialComplex& complex_;
  Monitor& monitor_;
  Vec3 origin_;
  std::vector<Patch> patches_;  // by ball
  std::vector<ExposedSide> sides_;
  std::vector<Vec3> corners_;  // of the boundary, by exposed side
};

}  // namespace

MassProperties union_measure(const SimplicialComplex& complex, Monitor& monitor) {
  return Measure(complex, monitor).run(nullptr);
}

MassProperties union_measure(const SimplicialComplex& complex, const PowerDiagram& diagram,
                             Monitor& monitor) {
  check_diagram_of(diagram, complex);
  return Measure(complex, monitor).run(&diagram);
}

}  // namespace ballflow::geometry
