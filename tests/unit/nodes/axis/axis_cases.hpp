// Unions of balls and their medial axes, for the tests of both.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "binary_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry::axis_cases {

using test::betti_of;

class Listener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

struct Result {
  SimplicialComplex complex;
  MedialAxis axis;
  std::vector<std::string> warnings;
};

inline Result axis_of(const std::vector<Vec3>& centers, const std::vector<double>& radii) {
  Result r;
  Listener listener;
  r.complex = alpha_shape({centers, radii, {}, {}}, {}, listener);
  r.axis = medial_axis(r.complex, {}, listener);
  r.warnings = listener.warnings;
  EXPECT_EQ(broken_invariant(r.axis), "");
  return r;
}

inline Result axis_of(const std::vector<Vec3>& centers, double radius) {
  return axis_of(centers, std::vector<double>(centers.size(), radius));
}

inline std::int64_t count(const MedialAxis& axis, AxisKind kind) {
  return std::count(axis.polygon_kinds.begin(), axis.polygon_kinds.end(), static_cast<std::uint8_t>(kind));
}

/// A random number in [0, 1), the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

struct BallSet {
  std::vector<Vec3> centers;
  std::vector<double> radii;
};

inline BallSet random_balls(Random& random, double smallest, double largest, double height = 1) {
  BallSet balls;
  const std::size_t n = 5 + random.below(56);
  for (std::size_t i = 0; i < n; ++i) {
    balls.centers.push_back({random.unit(), random.unit(), height * random.unit()});
    balls.radii.push_back(smallest + (largest - smallest) * random.unit());
  }
  return balls;
}

/// The axis has the topology of the union: all Betti numbers, the Euler characteristic, no warning.
inline void expect_topology_of_the_union(const Result& r, const std::string& what) {
  SCOPED_TRACE(what);
  const AxisTopology topology = axis_topology(r.axis);
  EXPECT_EQ(topology.euler_characteristic, r.complex.euler_characteristic());
  EXPECT_EQ(topology.components, r.complex.betti[0]);
  EXPECT_EQ(betti_of(r.axis), r.complex.betti);
  EXPECT_TRUE(r.warnings.empty());
}

/// Points on three spheres and strictly inside no ball: the boundary vertices, from their definition.
inline std::vector<Vec3> boundary_vertices(const BallSet& balls) {
  std::vector<Vec3> result;
  const auto& c = balls.centers;
  const auto& r = balls.radii;
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      const double ij = distance(c[i], c[j]);
      if (ij > r[i] + r[j]) continue;
      for (std::size_t k = j + 1; k < c.size(); ++k) {
        // Coordinates in the frame of the triangle: x along ij, y towards k.
        const Vec3 ex = (1 / ij) * (c[j] - c[i]);
        const double along = dot(ex, c[k] - c[i]);
        const Vec3 across = c[k] - c[i] - along * ex;
        const double up = length(across);
        const Vec3 ey = (1 / up) * across, ez = cross(ex, ey);
        const double x = (r[i] * r[i] - r[j] * r[j] + ij * ij) / (2 * ij);
        const double y = (r[i] * r[i] - r[k] * r[k] + along * along + up * up - 2 * along * x) / (2 * up);
        const double zz = r[i] * r[i] - x * x - y * y;
        if (!(zz >= 0)) continue;
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 p = c[i] + x * ex + y * ey + (sign * std::sqrt(zz)) * ez;
          bool covered = false;
          for (std::size_t m = 0; m < c.size(); ++m) {
            covered = covered || (m != i && m != j && m != k && distance(p, c[m]) < r[m]);
          }
          if (!covered) result.push_back(p);
        }
      }
    }
  }
  return result;
}

}  // namespace ballflow::geometry::axis_cases
