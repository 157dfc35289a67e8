// Sets of balls and their alpha-shapes, checked.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "power/alpha_shape.hpp"
#include "power/power_diagram.hpp"
#include "power/union_betti.hpp"
#include "power/union_vertices.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry::alpha_cases {

using Simplices = std::vector<std::vector<std::int32_t>>;

inline Balls make_balls(std::vector<Vec3> centers, std::vector<double> radii) {
  return {std::move(centers), std::move(radii), {}, {}};
}

inline Balls make_balls(std::vector<Vec3> centers, double radius) {
  std::vector<double> radii(centers.size(), radius);
  return make_balls(std::move(centers), std::move(radii));
}

inline bool same(const std::vector<ExposedSide>& a, const std::vector<ExposedSide>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ExposedSide& x, const ExposedSide& y) {
    return x.triangle == y.triangle && x.side == y.side && x.regular == y.regular;
  });
}

/// The complex, which keeps its own invariants, is that of the power diagram, and has the Betti numbers that
/// are counted without it.
inline SimplicialComplex shape_of(const Balls& balls, const AlphaShapeOptions& options = {}) {
  SimplicialComplex complex = alpha_shape(balls, options, no_monitor());
  EXPECT_EQ(broken_invariant(complex), "");
  const PowerDiagram diagram = power_diagram(balls, options, no_monitor());
  EXPECT_EQ(broken_invariant(diagram), "");
  EXPECT_EQ(union_betti(diagram, no_monitor()), complex.betti);
  EXPECT_EQ(union_betti(balls, options.tolerance, no_monitor()), complex.betti);
  EXPECT_TRUE(same(exposed_sides(complex, diagram), exposed_sides(complex)));
  EXPECT_NO_THROW(check_diagram_of(diagram, complex));
  EXPECT_EQ(complex.centers, balls.centers);
  return complex;
}

inline Simplices simplices_of(const SimplicialComplex& complex) {
  Simplices all;
  for (const auto v : complex.vertices) all.push_back({v});
  for (const auto& s : complex.edges) all.emplace_back(s.begin(), s.end());
  for (const auto& s : complex.triangles) all.emplace_back(s.begin(), s.end());
  for (const auto& s : complex.tetrahedra) all.emplace_back(s.begin(), s.end());
  std::sort(all.begin(), all.end());
  return all;
}

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Vec3 uniform_point(std::mt19937_64& random) {
  const double x = uniform(random, 0, 1), y = uniform(random, 0, 1), z = uniform(random, 0, 1);
  return {x, y, z};
}

inline Balls random_balls(std::mt19937_64& random, int n, double low, double high) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    centers.push_back(uniform_point(random));
    radii.push_back(uniform(random, low, high));
  }
  return make_balls(std::move(centers), std::move(radii));
}

/// Centers and radii on small grids: cospherical centers, equal balls, tangent balls, nested balls.
inline Balls grid_balls(std::mt19937_64& random, int n, int side) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  const auto digit = [&] { return static_cast<double>(random() % static_cast<unsigned>(side)); };
  for (int i = 0; i < n; ++i) {
    const double x = digit(), y = digit(), z = digit();
    centers.push_back({x, y, z});
    radii.push_back(0.25 * static_cast<double>(random() % 6));
  }
  return make_balls(std::move(centers), std::move(radii));
}

}  // namespace ballflow::geometry::alpha_cases
