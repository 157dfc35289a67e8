// The vertices of the boundary of a union of grown balls, and decisions about them that no rounding changes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "axis/delaunay_table.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "exact/long_number.hpp"
#include "power/grown_balls.hpp"
#include "power/union_vertices.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// The regular vertices of the boundary of the union of grown balls. Balls in general position have three
/// spheres and one triangle through each of them. What is decided about them is known by names (vertices on
/// one sphere are cospherical, on two cocircular), else computed in as many bits as it takes.
class GrownSites {
 public:
  /// Keeps references. `complex` is grown_complex(balls) and has tetrahedra.
  GrownSites(const SimplicialComplex& complex, const GrownBalls& balls, Monitor& monitor);

  /// Points rounded to doubles, so that some may coincide. The last four are no vertices: they have neither
  /// balls nor faces, lie around all others and farther from every ball than those, and make the
  /// triangulation three-dimensional.
  const UnionVertices& table() const { return table_; }
  std::vector<DelaunayCell> delaunay(Monitor& monitor) const;

  /// 1 where the circumcentre of the four sites lies on the inner side of the triangle of w, else -1.
  int side_of_circumcenter(std::int32_t w, const std::array<std::int32_t, 4>& sites) const;
  /// The same of the centroid of centres of balls; 0 in the plane of the triangle.
  int side_of_centroid(std::int32_t w, std::span<const std::int32_t> balls) const;
  Vec3 circumcenter(const std::array<std::int32_t, 4>& sites) const;
  /// Whether the centre of ball a is nearer to that circumcentre than the centre of b.
  bool nearer(std::int32_t a, std::int32_t b, const std::array<std::int32_t, 4>& sites) const;

  /// The signs of CGAL's predicates of the same names.
  int orientation(const std::array<std::int32_t, 4>& sites) const;
  int side_of_oriented_sphere(const std::array<std::int32_t, 5>& sites) const;

 private:
  struct Place {
    LongNumber x, y, z;
  };
  struct Bounds {
    std::array<double, 3> low, high;
  };
  Place place(std::int32_t site, long bits) const;
  Place vertex_of_balls(std::int32_t site, long bits) const;
  Place center(std::int32_t ball, long bits) const;
  std::int32_t shared_balls(std::span<const std::int32_t> sites) const;
  template <class Value>
  int sign_of(const Value& value) const;

  const SimplicialComplex& complex_;
  const GrownBalls& balls_;
  UnionVertices table_;
  std::vector<Bounds> bounds_;  // per site
  std::vector<long> lengths_;   // of numbers, one after the other, until a sign is certain
  mutable std::vector<std::vector<Place>> places_;  // per site: none or the longest so far
  mutable std::vector<long> bits_;                  // of it
};

}  // namespace ballflow::geometry
