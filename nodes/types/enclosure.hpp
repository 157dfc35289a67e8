// Whether a union of balls contains everything inside a surface, as VerifyEnclosure found it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Why a triangle is not proven to be covered.
enum class OpenTriangle : std::uint8_t {
  point_outside = 0,  // a point of it is in no ball: decided exactly
  undecided = 1,  // balls meet on it without overlapping, so that no piece around the point is in one of them
};

/// Why a part of space that the balls leave out and close off from infinity does or does not matter.
enum class VoidPlace : std::uint8_t {
  outside = 0,  // of the solid inside a closed mesh: nothing that has to be covered
  inside = 1,   // of the solid
  unknown = 2,  // the mesh is not closed: what it holds is not known
};

struct Enclosure {
  std::int64_t balls = 0;
  std::int64_t triangles = 0;
  std::int64_t pieces = 0;  // of the triangles, each of which lies in one ball
  std::uint8_t meant = 1;   // 0: the balls are not meant to enclose; of interest is how far they stand out
  std::uint8_t closed = 0;  // 1: every edge of the mesh has two triangles, or an even number, that cancel

  Array<std::int32_t> open_triangles;  // u, ascending: not proven to be covered
  Array<Vec3> open_points;       // u x 3, model units: a point of each, rounded; where the two cases say
  Array<std::uint8_t> open_why;  // u: OpenTriangle
  double area = 0;               // of all triangles, squared model units
  // Of these the part in no ball, by pieces of half a percent of the box: about; 0 where nothing is open.
  double open_area = 0;
  double gap =
      0;  // farthest of the looked-at points of the mesh from the union, model units; 0: none outside
  // No point of the triangles is farther from the union than that, up to rounding; model units. 0 where they
  // are covered, -1 where nothing is known: without balls, and without triangles.
  double gap_at_most = -1;

  Array<Vec3> void_points;          // v x 3: a point in every void, rounded
  Array<std::uint8_t> void_places;  // v: VoidPlace

  // No point of the balls is farther than that from the solid (of a closed mesh, its inside included), or
  // from the triangles (of others); model units. 0 for balls inside, and where there are no triangles.
  double protrusion = 0;

  /// Where there are no triangles nothing is proven.
  bool covers() const { return triangles > 0 && open_triangles.size() == 0; }
  std::int64_t voids_that_matter() const;
  /// The union contains the triangles and everything that they separate from infinity.
  bool encloses() const { return covers() && voids_that_matter() == 0; }
};

/// "everything inside the surface is in the balls: proven", or what is not: "12 of 300 triangles are not
/// covered (34 % of the surface, up to 0.018 away)", "1 void inside".
std::string describe(const Enclosure& enclosure);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Enclosure& enclosure);

}  // namespace ballflow::geometry
