// Samples whose Voronoi diagram is tried, and their poles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "poles/voronoi_poles.hpp"
#include "shapes.hpp"

namespace ballflow::voronoi_cases {

using geometry::PoleSet;
using geometry::voronoi_poles;
using test::PointSet;
using test::Vec3;

inline std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

inline PoleSet poles_of(const PointSet& points) {
  PoleSet poles = voronoi_poles(points, {});
  EXPECT_EQ(geometry::broken_invariant(poles), "");
  EXPECT_EQ(poles.sample_poles.size(), points.points.size());
  for (const auto& own : poles.sample_poles) EXPECT_EQ(own[2], -1);
  return poles;
}

inline std::vector<std::int32_t> defining_samples_of(const PoleSet& poles, std::size_t pole) {
  return {poles.defining_samples.begin() + poles.defining_offsets[pole],
          poles.defining_samples.begin() + poles.defining_offsets[pole + 1]};
}

inline std::vector<std::size_t> bounded(const PoleSet& poles) {
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (poles.unbounded[i] == 0) ids.push_back(i);
  }
  return ids;
}

inline PointSet random_points(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<Vec3> points;
  const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.push_back({x, y, z});
  }
  return {points, {}};
}

// Integer coordinates from 0 to `top`: cospherical and coplanar points everywhere.
inline PointSet random_lattice_points(unsigned seed, int count, unsigned top) {
  std::mt19937 random(seed);
  std::set<Vec3> points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const auto coordinate = [&] { return static_cast<double>(random() % (top + 1)); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.insert({x, y, z});
  }
  std::vector<Vec3> order(points.begin(), points.end());
  std::shuffle(order.begin(), order.end(), random);
  return {order, {}};
}

inline PointSet lattice(int side) {
  std::vector<Vec3> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    }
  }
  return {points, {}};
}

}  // namespace ballflow::voronoi_cases
