// What a picture shows: points, balls or polygons, as `ballflow export` writes them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ballflow::render {

using Vector = std::array<double, 3>;

inline Vector operator+(Vector a, Vector b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector operator-(Vector a, Vector b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector operator*(double s, Vector a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(Vector a, Vector b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(Vector a, Vector b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Unit vector along `a`; the z axis when `a` is zero.
Vector normalised(Vector a);

struct Model {
  std::vector<Vector> vertices;
  std::vector<double> radii;  // one per vertex, or empty
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> edges;

  bool has_surface() const { return !polygons.empty() || !edges.empty(); }
};

/// Reads a binary little-endian PLY file: the elements vertex (x, y, z and optionally radius), face
/// (vertex_indices) and edge (vertex1, vertex2); other elements and properties are skipped. Throws
/// std::runtime_error that names the file and what is wrong with it.
Model read_ply(const std::string& path);

}  // namespace ballflow::render
