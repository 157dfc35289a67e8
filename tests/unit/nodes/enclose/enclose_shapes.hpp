// Meshes that balls are fitted to in tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "sample/generate.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

inline TriangleMesh shape(const std::string& text) { return generate(parse_shape(text)); }

/// The twelve triangles of a box, outwards.
inline TriangleMesh box_mesh(Vec3 lower, Vec3 upper) {
  std::vector<Vec3> v;
  for (int k = 0; k < 8; ++k) {
    v.push_back({(k & 1) != 0 ? upper.x : lower.x, (k & 2) != 0 ? upper.y : lower.y,
                 (k & 4) != 0 ? upper.z : lower.z});
  }
  return {v, std::vector<Triangle>{{0, 2, 3},
                                   {0, 3, 1},
                                   {4, 5, 7},
                                   {4, 7, 6},
                                   {0, 1, 5},
                                   {0, 5, 4},
                                   {2, 6, 7},
                                   {2, 7, 3},
                                   {0, 4, 6},
                                   {0, 6, 2},
                                   {1, 3, 7},
                                   {1, 7, 5}}};
}

inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> vertices(a.vertices.begin(), a.vertices.end());
  std::vector<Triangle> triangles(a.triangles.begin(), a.triangles.end());
  const auto first = static_cast<std::int32_t>(vertices.size());
  vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
  for (Triangle t : b.triangles) {
    for (std::int32_t& v : t) v += first;
    triangles.push_back(t);
  }
  return {std::move(vertices), std::move(triangles)};
}

inline TriangleMesh turned_over(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  for (Triangle& t : triangles) std::swap(t[0], t[1]);
  return {mesh.vertices, std::move(triangles)};
}

inline Vec3 random_vector(Random& random) {
  const double x = random.unit(), y = random.unit(), z = random.unit();
  return {x, y, z};
}

/// Unconnected triangles in about the unit cube.
inline TriangleMesh triangle_soup(Random& random, int triangles) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> faces;
  for (std::int32_t t = 0; t < triangles; ++t) {
    const Vec3 at = random_vector(random);
    for (int k = 0; k < 3; ++k) vertices.push_back(at + 0.4 * random_vector(random));
    faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return {std::move(vertices), std::move(faces)};
}

}  // namespace ballflow::geometry
