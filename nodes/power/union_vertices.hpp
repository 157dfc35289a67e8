// The vertices of the boundary of a union of balls, read off its dual complex.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// A boundary vertex lies on the spheres of three balls i, j, k; the triangle ijk of the complex names it,
/// together with the side of the triangle on which no tetrahedron of the complex lies (Amenta and Kolluri
/// 2001, section 3). A triangle in one tetrahedron names one vertex (it is regular), a triangle in no
/// tetrahedron two, one on either side (they are singular), a triangle in two tetrahedra none.
///
/// More than three spheres may pass through one point (balls on a grid, say). The vertices of their
/// triangles are then merged into one, which keeps all the names.
struct UnionVertices {
  /// A regular triangle of the complex, seen from its vertex.
  struct Face {
    std::int32_t triangle = 0;  // index into complex.triangles
    std::int8_t outside = 1;    // orientation(i, j, k, x) of the points x on the vertex' side: 1 or -1
  };

  std::vector<Vec3> points;  // n, in the order of their first names; pairwise distinct

  // Balls whose spheres name vertex w: balls[ball_offsets[w] .. ball_offsets[w + 1]), ascending.
  std::vector<std::int64_t> ball_offsets{0};
  std::vector<std::int32_t> balls;

  // Regular triangles that name vertex w, ascending; none when all its triangles are singular.
  std::vector<std::int64_t> face_offsets{0};
  std::vector<Face> faces;

  std::size_t size() const { return points.size(); }
  std::span<const std::int32_t> balls_of(std::size_t w) const { return part(balls, ball_offsets, w); }
  std::span<const Face> faces_of(std::size_t w) const { return part(faces, face_offsets, w); }

 private:
  template <class T>
  static std::span<const T> part(const std::vector<T>& all, const std::vector<std::int64_t>& offsets,
                                 std::size_t w) {
    const auto first = static_cast<std::size_t>(offsets[w]);
    return std::span(all).subspan(first, static_cast<std::size_t>(offsets[w + 1]) - first);
  }
};

/// One name of a boundary vertex, before merging.
struct ExposedSide {
  std::int32_t triangle;  // index into complex.triangles
  std::int8_t side;       // orientation(i, j, k, x) of the points x on the side without tetrahedron: 1 or -1
  bool regular;           // there is a tetrahedron on the other side
};

/// All names, by triangle, side -1 first. Same preconditions as union_vertices.
std::vector<ExposedSide> exposed_sides(const SimplicialComplex& complex, Monitor& monitor = no_monitor());
/// The same where the power diagram is known that `complex` was read off: nothing is searched, and no
/// orientation computed.
std::vector<ExposedSide> exposed_sides(const SimplicialComplex& complex, const PowerDiagram& diagram,
                                       Monitor& monitor = no_monitor());

/// An order of points that keeps the order of their mirror images in coordinate planes, unless they are
/// images of each other. What is computed from points in this order is rounded alike however they are
/// numbered, and its mirror image is computed from mirrored input.
inline bool before(Vec3 a, Vec3 b) {
  const Vec3 u{std::abs(a.x), std::abs(a.y), std::abs(a.z)}, v{std::abs(b.x), std::abs(b.y), std::abs(b.z)};
  return u != v ? u < v : a < b;
}

/// The point on the spheres of the triangle's balls that lies on that side of it.
Vec3 boundary_vertex(const SimplicialComplex& complex, const ExposedSide& side);

/// Vertices closer than `merge_distance` (model units) to each other, in a chain, become one. The complex
/// must hold its invariants (see broken_invariant) and its tetrahedra must not be flat.
UnionVertices union_vertices(const SimplicialComplex& complex, double merge_distance,
                             Monitor& monitor = no_monitor());
/// The same from the names that exposed_sides() found.
UnionVertices union_vertices(const SimplicialComplex& complex, const std::vector<ExposedSide>& named,
                             double merge_distance, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
