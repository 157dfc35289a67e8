// Points, poses and shapes for the tests of shape priors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "base/random.hpp"
#include "sample/surface_sample.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

/// Keeps what a function warned of.
struct Warnings : Monitor {
  std::string text;
  void warn(const std::string& more) override { text += more + "\n"; }
};

/// n points of the unit cube.
inline std::vector<Vec3> random_points(Random& random, std::size_t n) {
  std::vector<Vec3> points(n);
  for (Vec3& p : points) p = {random.unit(), random.unit(), random.unit()};
  return points;
}

/// A rotation, uniform among all (of a random quaternion in the unit ball), and a translation.
inline ShapePose random_pose(Random& random, double scale = 1, double shift = 1) {
  double q[4], n;
  do {
    n = 0;
    for (double& x : q) {
      x = 2 * random.unit() - 1;
      n += x * x;
    }
  } while (n > 1 || n < 0.01);
  for (double& x : q) x /= std::sqrt(n);
  const auto [w, x, y, z] = q;
  ShapePose pose;
  pose.rotation = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                   2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                   2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  pose.scale = scale;
  pose.similarity = scale == 1 ? 0 : 1;
  pose.translation = shift * Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
  return pose;
}

inline std::vector<Vec3> moved(std::span<const Vec3> points, const ShapePose& pose) {
  std::vector<Vec3> result;
  for (const Vec3& p : points) result.push_back(transformed(pose, p));
  return result;
}

/// With its normals, if there are any.
inline PointSet moved(const PointSet& points, const ShapePose& pose) {
  PointSet result;
  result.points = moved(points.points.span(), pose);
  std::vector<Vec3> normals;
  for (const Vec3& n : points.normals) normals.push_back(turned(pose, n));
  result.normals = std::move(normals);
  return result;
}

inline PointSet samples_of(const TriangleMesh& mesh, std::int64_t count, std::uint64_t seed) {
  return sample_surface(mesh, {Spread::poisson, count, seed});
}

/// A closed box of `sizes` on a grid; `lift` moves points of the grid, [0, 1]^3 scaled, to where they belong.
template <class Lift>
TriangleMesh lifted_box(Vec3 sizes, int n, const Lift& lift) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  const auto face = [&](const auto& place) {
    const auto base = static_cast<std::int32_t>(vertices.size());
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const Vec3 p = place(static_cast<double>(i) / n, static_cast<double>(j) / n);
        vertices.push_back(lift(Vec3{sizes.x * p.x, sizes.y * p.y, sizes.z * p.z}));
      }
    }
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t j = 0; j < n; ++j) {
        const std::int32_t p = base + i * (n + 1) + j;
        triangles.push_back({p, p + n + 1, p + n + 2});
        triangles.push_back({p, p + n + 2, p + 1});
      }
    }
  };
  face([](double a, double b) { return Vec3{a, b, 1}; });
  face([](double a, double b) { return Vec3{b, a, 0}; });
  face([](double a, double b) { return Vec3{a, 0, b}; });
  face([](double a, double b) { return Vec3{b, 1, a}; });
  face([](double a, double b) { return Vec3{1, a, b}; });
  face([](double a, double b) { return Vec3{0, b, a}; });
  return {std::move(vertices), std::move(triangles)};
}

/// A box of 10 x 4 x 3 with a bump of height 1.6 and deviation 1 over `place` of its top.
inline TriangleMesh bump_box(double place) {
  return lifted_box({10, 4, 3}, 40, [&](Vec3 p) {
    const double across = (p.x - place) * (p.x - place) + (p.y - 2) * (p.y - 2);
    return Vec3{p.x, p.y, p.z * (1 + 1.6 / 3 * std::exp(-across / 2))};
  });
}

/// Unlike its mirror image: a long box, bent to one side at one end and to another at the other.
inline TriangleMesh handed_shape() {
  return lifted_box({6, 2, 1}, 20, [](Vec3 p) {
    const double right = std::max(0.0, p.x - 3), left = std::max(0.0, 2 - p.x);
    return Vec3{p.x, p.y + 0.3 * right * right, p.z + 0.4 * left * left};
  });
}

}  // namespace ballflow::geometry
