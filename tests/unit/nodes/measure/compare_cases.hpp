// Balls and surfaces that are compared.
#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "measure/compare.hpp"

namespace ballflow::geometry::compare_cases {

inline double unit(std::mt19937& random) { return random() / 4294967296.0; }

/// The surface of [-1, 1]^3.
inline TriangleMesh cube() {
  std::vector<Vec3> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.push_back({k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  return {vertices, std::vector<Triangle>{{0, 2, 1},
                                          {1, 2, 3},
                                          {4, 5, 6},
                                          {5, 7, 6},
                                          {0, 1, 4},
                                          {1, 5, 4},
                                          {2, 6, 3},
                                          {3, 6, 7},
                                          {0, 4, 2},
                                          {2, 4, 6},
                                          {1, 3, 5},
                                          {3, 7, 5}}};
}

inline Balls balls_of(std::vector<Vec3> centers, std::vector<double> radii) {
  return {std::move(centers), std::move(radii), {}, {}};
}

inline std::string refusal(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                           const CompareOptions& options = {}) {
  try {
    compare(balls, points, mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace ballflow::geometry::compare_cases
