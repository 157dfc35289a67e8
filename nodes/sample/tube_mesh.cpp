#include "sample/tube_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/circle.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;

constexpr double pi = 3.14159265358979323846;
constexpr double row_height = 0.86602540378443864676;  // of equilateral triangles of side 1
constexpr int length_steps = 4096;                     // of the polygon that measures the curve
constexpr std::int64_t fewest_corners = 6;             // of a ring
constexpr double max_stretch = 1.25;                   // distance of rings per side

struct Ring {
  Index first = 0;  // vertex
  Index corners = 0;
  double phase = 0;  // of the first vertex, turns
};

class Builder {
 public:
  /// A ring of `corners` vertices at distance r from `center`; one vertex when r = 0. side and binormal are
  /// orthogonal unit vectors.
  Ring add_ring(const Vec3& center, const Vec3& side, const Vec3& binormal, double r, Index corners,
                double phase) {
    const Ring ring{static_cast<Index>(vertices.size()), corners, phase};
    for (Index i = 0; i < corners; ++i) {
      const auto [c, s] = on_circle(phase + static_cast<double>(i) / corners);
      vertices.push_back(center + r * (c * side + s * binormal));
    }
    return ring;
  }

  /// Triangles between a ring and the next one along the curve: the ring whose next corner comes first moves
  /// on.
  void connect(const Ring& a, const Ring& b) {
    const auto turn = [](const Ring& ring, Index i) {
      return ring.phase + static_cast<double>(i) / ring.corners;
    };
    const auto corner = [](const Ring& ring, Index i) { return ring.first + i % ring.corners; };
    Index i = 0, j = 0;
    while (i < a.corners || j < b.corners) {
      const bool along_a =
          j == b.corners || (i < a.corners && turn(a, i + 1) + turn(a, i) <= turn(b, j + 1) + turn(b, j));
      if (along_a) {
        if (a.corners > 1) triangles.push_back({corner(a, i), corner(a, i + 1), corner(b, j)});
        ++i;
      } else {
        if (b.corners > 1) triangles.push_back({corner(b, j + 1), corner(b, j), corner(a, i)});
        ++j;
      }
    }
  }

  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// Parameters at equal arc length: count of them, from 0, with or without the end.
std::vector<double> equal_arc_length(const TubeCurve& curve, std::int64_t count, double total,
                                     const std::vector<double>& lengths) {
  std::vector<double> parameters;
  std::size_t step = 0;
  const auto gaps = static_cast<double>(curve.closed ? count : count - 1);
  for (std::int64_t i = 0; i < count; ++i) {
    const double target = total * static_cast<double>(i) / gaps;
    while (step + 2 < lengths.size() && lengths[step + 1] < target) ++step;
    const double part = (target - lengths[step]) / (lengths[step + 1] - lengths[step]);
    parameters.push_back((static_cast<double>(step) + part) / length_steps);
  }
  return parameters;
}

}  // namespace

TriangleMesh tube_mesh(const TubeCurve& curve, double r, std::int64_t n) {
  std::vector<double> lengths = {0};
  for (int i = 1; i <= length_steps; ++i) {
    const double t = static_cast<double>(i) / length_steps,
                 before = static_cast<double>(i - 1) / length_steps;
    lengths.push_back(lengths.back() + distance(curve.point(t), curve.point(before)));
  }
  const double total = lengths.back();
  // Near-equilateral triangles of side e: n times row_height e^2 is the area.
  const double area = 2 * pi * r * total + (curve.closed ? 0 : 4 * pi * r * r);
  const double e = std::sqrt(area / (row_height * static_cast<double>(n)));
  const auto corners = static_cast<Index>(
      std::max(fewest_corners, static_cast<std::int64_t>(std::floor(2 * pi * r / e + 0.5))));
  const double side = 2 * pi * r / corners, spacing = side * row_height;
  // Rings of the half spheres, from the pole at angle 0 to the equator, which is a ring of the tube.
  const auto cap_rings = static_cast<Index>(std::max(1.0, std::floor(pi * r / 2 / spacing + 0.5)));
  // As many rings as n allows, not much farther apart than their corners; an even number, as every other one
  // is turned by half a corner.
  const double tube_n = static_cast<double>(n) * (2 * pi * r * total / area);
  const double gaps = std::max(tube_n / corners, total / (max_stretch * side));
  auto count = std::max<std::int64_t>(4, 2 * static_cast<std::int64_t>(std::floor(gaps / 2 + 0.5)));
  if (!curve.closed) ++count;

  Builder builder;
  std::vector<Ring> rings;
  struct Station {
    Vec3 point, tangent, side, binormal;
  };
  const auto station = [&curve](double t) {
    Station s{curve.point(t), curve.tangent(t), curve.side(t), {}};
    s.tangent = (1 / length(s.tangent)) * s.tangent;
    s.side = s.side - dot(s.side, s.tangent) * s.tangent;
    s.side = (1 / length(s.side)) * s.side;
    s.binormal = cross(s.tangent, s.side);
    return s;
  };
  const double half_corner = 0.5 / corners;
  const auto add_cap_ring = [&](const Station& s, double sign, Index k) {
    const auto [c, radius] = on_circle(0.25 * k / cap_rings);
    const auto around =
        k == 0 ? Index{1} : std::max<Index>(5, static_cast<Index>(std::floor(corners * radius + 0.5)));
    rings.push_back(builder.add_ring(s.point + (sign * c * r) * s.tangent, s.side, s.binormal,
                                     k == 0 ? 0.0 : radius * r, around, k % 2 == 0 ? 0.0 : 0.5 / around));
  };
  const std::vector<double> parameters = equal_arc_length(curve, count, total, lengths);
  if (!curve.closed) {
    for (Index k = 0; k < cap_rings; ++k) add_cap_ring(station(parameters.front()), -1, k);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Station s = station(parameters[i]);
    rings.push_back(
        builder.add_ring(s.point, s.side, s.binormal, r, corners, i % 2 == 0 ? 0.0 : half_corner));
  }
  if (!curve.closed) {
    for (Index k = cap_rings - 1; k >= 0; --k) add_cap_ring(station(parameters.back()), 1, k);
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) builder.connect(rings[i], rings[i + 1]);
  if (curve.closed) builder.connect(rings.back(), rings.front());
  return {std::move(builder.vertices), std::move(builder.triangles)};
}

}  // namespace ballflow::geometry
