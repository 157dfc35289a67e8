// How far a set of balls is from the surface it stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ballflow::geometry {

/// M is the surface, U the union of the balls, bd U its boundary; d is the Euclidean distance, all lengths
/// are in model units. A one-sided distance from X to Y is the largest d(x, Y), x in X; its true value lies
/// between at_least and at_most, whatever the spacing of the samples, up to rounding.
struct OneSidedDistance {
  using scalar = double;  // how it is stored: 4 doubles
  static constexpr std::size_t dimension = 4;

  double at_least = 0, value = 0, at_most = 0;
  double mean = 0;  // over the area of X, from samples
};

/// What a set of balls was compared with: how much its numbers say about a solid.
enum class ComparedWith : std::uint8_t {
  nothing,      // there was no comparison
  cloud,        // points: nothing is known between them
  open_mesh,    // triangles that bound no solid
  closed_mesh,  // triangles that bound one: as a chain, turned over where neighbours disagree, they have no
                // boundary. Edges of four and more triangles are allowed.
};

/// "a closed mesh", "an open mesh", "a cloud of points", "nothing".
const char* in_words(ComparedWith what);

struct Comparison {
  std::uint8_t compared_with = static_cast<std::uint8_t>(ComparedWith::nothing);  // M: not `nothing`

  std::int64_t surface_samples = 0, union_samples = 0;
  double spacing = 0;  // no point of M, and none of bd U, is farther than this from a sample

  OneSidedDistance surface_to_union;  // from M to bd U
  OneSidedDistance union_to_surface;  // from bd U to M
  double coverage = 0;                // part of the area of M that is in U, in [0, 1]
  double uncovered = 0;               // largest d(x, U) of the samples x of M; 0 when all are in U
  // The largest r - d(c, M) of a ball, at least 0: no ball with its centre c inside reaches farther beyond M.
  // Of ellipsoids the length by which half-axes have to be shortened for that (compare_ellipsoids.hpp).
  double protrusion = 0;

  double union_volume = 0;  // by formulas: right but for rounding, whatever the spacing; of ellipsoids
                            // along lines, to about 1e-4
  // Enclosed by M: the integral of its winding number, with its components turned outwards but for cavities,
  // as LabelPoles turns them. What M winds around twice counts twice.
  double surface_volume = 0;
  std::uint8_t surface_encloses = 0;  // 1 for a closed mesh, else surface_volume is 0

  bool with_closed_mesh() const {
    return compared_with == static_cast<std::uint8_t>(ComparedWith::closed_mesh);
  }
  double hausdorff() const;
  double hausdorff_at_most() const;
  /// The mean of the two mean distances.
  double chamfer() const { return (surface_to_union.mean + union_to_surface.mean) / 2; }
};

/// Empty when every bound is on its side of the value and no number is negative, else what is wrong.
std::string broken_invariant(const Comparison& comparison);

}  // namespace ballflow::geometry
