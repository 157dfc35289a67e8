#include "ellipsoids/principal_scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "base/principal_axes.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

constexpr double flat = 1e-9;   // of the largest thickness
constexpr double equal = 1e-6;  // moments, of the largest
const char* const with_thickness =
    "give the sheet a thickness before (a closed mesh of both of its sides), or use balls of a cloud";

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
          mesh.vertices[static_cast<std::size_t>(t[2])]};
}

void add(SymmetricMatrix& m, double weight, Vec3 v) {
  const std::array<double, 3> x{v.x, v.y, v.z};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] += weight * x[i] * x[j];
}

/// Integrals of 1, x and x x^T over something.
struct Moments {
  double mass = 0;
  Vec3 first;
  SymmetricMatrix second{};

  /// A simplex of that mass: of density 1, with the corners and perhaps the origin.
  void add_simplex(double of_mass, const Corners& p, std::size_t corners) {
    const Vec3 sum = p[0] + p[1] + p[2];
    const auto n = static_cast<double>(corners);
    mass += of_mass;
    first = first + of_mass / n * sum;
    const double weight = of_mass / (n * (n + 1));
    add(second, weight, sum);
    for (const Vec3 corner : p) add(second, weight, corner);
  }
  SymmetricMatrix about_center() const {
    SymmetricMatrix m = second;
    add(m, -1 / mass, first);
    return m;
  }
};

struct Measured {
  Moments moments;
  SymmetricMatrix normals{};  // integral of n n^T
  bool closed = false;
  double volume = 0;
};

/// Coordinates are relative to the origin and in units of the longest edge.
Measured measure(const std::vector<Vec3>& points, const TriangleMesh& mesh, Monitor& monitor) {
  Measured result;
  if (mesh.triangles.empty()) {
    for (const Vec3 p : points) result.moments.add_simplex(1, {p, p, p}, 3);
    return result;
  }
  const WindingNumber winding(mesh, monitor);
  result.closed = winding.chain().closed();
  result.volume = result.closed ? winding.enclosed_volume() : 0;
  Moments solid, surface;
  for (const Triangle& t : winding.chain().triangles) {
    const Corners p = corners_of(mesh, t);
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double twice = length(normal);
    if (!(twice > 0)) continue;
    surface.add_simplex(twice / 2, p, 3);
    solid.add_simplex(dot(p[0], cross(p[1], p[2])) / 6, p, 4);
    add(result.normals, 1 / (2 * twice), normal);
  }
  // Where components turn different ways their sum says nothing; the surface does.
  const bool use_solid =
      result.volume > 0 && std::abs(std::abs(solid.mass) - result.volume) <= 1e-6 * result.volume;
  result.moments = use_solid ? solid : surface;
  return result;
}

/// The axes by descending moments, unique also where moments are equal; nothing where all are.
std::optional<Frame> unique_frame(const SymmetricMatrix& m) {
  std::array<Vec3, 3> axes = principal_axes(m);
  const auto moment = [&](Vec3 u) {
    const std::array<double, 3> x{u.x, u.y, u.z};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum += x[i] * m[i][j] * x[j];
    return sum;
  };
  const double a = moment(axes[0]), b = moment(axes[1]), c = moment(axes[2]);
  const double least = equal * std::max(std::abs(a), std::abs(c));
  const bool first = a - b <= least, last = b - c <= least;
  if (first && last) return std::nullopt;
  const auto upright = [](Vec3 u) {
    const std::array<double, 3> x{u.x, u.y, u.z};
    std::size_t most = 0;
    // What is as large up to rounding does not decide.
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(x[i]) > std::abs(x[most]) + 1e-9) most = i;
    return x[most] < 0 ? -u : u;
  };
  if (first || last) {
    const Vec3 alone = upright(last ? axes[0] : axes[2]);
    const std::array<Vec3, 3> coordinates = Frame{}.axes;
    Vec3 nearest{};
    for (const Vec3 e : coordinates) {
      const Vec3 in_plane = e - dot(e, alone) * alone;
      if (squared_length(in_plane) > squared_length(nearest) + 1e-9) nearest = in_plane;
    }
    const Vec3 other = 1 / length(nearest) * nearest;
    // Both are right-handed.
    return last ? Frame{{alone, other, cross(alone, other)}} : Frame{{other, cross(alone, other), alone}};
  }
  axes[0] = upright(axes[0]);
  axes[1] = upright(axes[1]);
  axes[2] = cross(axes[0], axes[1]);
  return Frame{axes};
}

Vec3 extents_along(const Frame& frame, const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3 p : points) box.add(frame.into(p));
  return box.upper - box.lower;
}

/// Twice the volume over the integral of |n.u|, for the three axes.
Vec3 chords_along(const Frame& frame, const TriangleMesh& mesh, double volume) {
  Vec3 shadow;
  for (const Triangle& t : mesh.triangles) {
    const Corners p = corners_of(mesh, t);
    const Vec3 n = frame.into(cross(p[1] - p[0], p[2] - p[0]));
    shadow = shadow + Vec3{std::abs(n.x) / 2, std::abs(n.y) / 2, std::abs(n.z) / 2};
  }
  return {2 * volume / shadow.x, 2 * volume / shadow.y, 2 * volume / shadow.z};
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

Vec3 least_is_one(Vec3 f) {
  const double least = std::min({f.x, f.y, f.z});
  return {f.x / least, f.y / least, f.z / least};
}

void check(const PrincipalScalingOptions& options) {
  if (!(options.stretch >= 0 && std::isfinite(options.stretch))) {
    throw InputError("stretch is " + std::to_string(options.stretch), "it is a finite number, at least 0");
  }
  const Vec3 f = options.given;
  if (options.factors == ScalingFactors::given &&
      !(is_finite(f) && f.x > 0 && f.y > 0 && f.z > 0 &&
        std::max({f.x, f.y, f.z}) * flat <= std::min({f.x, f.y, f.z}))) {
    throw InputError("the factors are " + number(f.x) + ", " + number(f.y) + " and " + number(f.z),
                     "they are finite, above 0, and no two differ by more than a factor of 1e9");
  }
}

}  // namespace

Scaling principal_scaling(const PointSet& points, const TriangleMesh& mesh,
                          const PrincipalScalingOptions& options, Monitor& monitor) {
  check(options);
  for (const std::string& broken : {broken_invariant(points), broken_invariant(mesh)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  const std::span<const Vec3> places = mesh.triangles.empty() ? points.points.span() : mesh.vertices.span();
  if (places.empty()) throw InputError("there is nothing to scale: no points", "connect a mesh or points");
  const Box box = bounding_box(places);
  Scaling result;
  result.origin = 0.5 * box.lower + 0.5 * box.upper;
  result.longest_edge = box.longest_edge();
  if (!(result.longest_edge > 0) || !std::isfinite(result.longest_edge)) {
    throw InputError("all " + std::to_string(places.size()) + " points are one, or too far apart",
                     "connect an object in space");
  }
  std::vector<Vec3> local;
  local.reserve(places.size());
  for (const Vec3 p : places) local.push_back(1 / result.longest_edge * (p - result.origin));
  const TriangleMesh local_mesh{mesh.triangles.empty() ? Array<Vec3>() : Array<Vec3>(local), mesh.triangles};
  const Measured measured = measure(local, local_mesh, monitor);
  monitor.step(0.8);

  std::optional<Frame> found = Frame{};
  if (options.axes == ScalingAxes::principal && measured.moments.mass != 0) {
    SymmetricMatrix m = measured.moments.about_center();
    if (measured.moments.mass < 0)
      for (auto& row : m)
        for (double& x : row) x = -x;
    found = unique_frame(m);
  } else if (options.axes == ScalingAxes::normals) {
    if (mesh.triangles.empty()) {
      throw InputError("axes are to follow normals, and there are no triangles",
                       "set axes to principal, or connect a mesh");
    }
    // Where most of the surface faces comes last, as the thin direction does among principal axes.
    SymmetricMatrix m = measured.normals;
    for (auto& row : m)
      for (double& x : row) x = -x;
    found = unique_frame(m);
  }
  const Frame frame = found.value_or(Frame{});
  result.rotation = quaternion_of(frame);
  if (options.factors == ScalingFactors::given) {
    result.thickness_from = static_cast<std::uint8_t>(ThicknessFrom::given);
    result.factors = least_is_one(options.given);
    monitor.step(1);
    return result;
  }
  const bool chords = options.factors == ScalingFactors::chords && measured.closed;
  result.thickness_from = static_cast<std::uint8_t>(chords ? ThicknessFrom::chords : ThicknessFrom::extents);
  const Vec3 extents = extents_along(frame, local);
  if (measured.closed && !(measured.volume > 1e-15)) {
    throw InputError("the closed surface has no volume: it is flat", with_thickness);
  }
  const Vec3 thickness = chords ? chords_along(frame, local_mesh, measured.volume) : extents;
  const double thin = std::min({thickness.x, thickness.y, thickness.z});
  const double thick = std::max({thickness.x, thickness.y, thickness.z});
  if (!(thin > flat * thick) || !(std::min({extents.x, extents.y, extents.z}) > flat)) {
    throw InputError("the object is flat: " + number(thin * result.longest_edge) + " thick along one axis, " +
                         number(thick * result.longest_edge) + " along another",
                     with_thickness);
  }
  const Vec3 rule =
      !found ? Vec3{1, 1, 1} : Vec3{thick / thickness.x, thick / thickness.y, thick / thickness.z};
  const auto stretched = [&](double f) { return 1 + options.stretch * (f - 1); };
  result.factors = least_is_one({stretched(rule.x), stretched(rule.y), stretched(rule.z)});
  result.thickness = result.longest_edge * thickness;
  if (std::max({rule.x, rule.y, rule.z}) < 1.1) {
    monitor.warn("the object is about as thick along all three axes (" + number(result.thickness.x) + ", " +
                 number(result.thickness.y) + ", " + number(result.thickness.z) +
                 "): ellipsoids along them will hardly be fewer than balls");
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
