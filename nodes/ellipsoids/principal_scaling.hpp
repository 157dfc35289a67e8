// A scaling along perpendicular axes that makes thin directions of an object thick (Kornberger 2010, 6.4).
#pragma once

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/scaling.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class ScalingAxes : std::uint8_t {
  principal,    // of the second moments: of the solid, of an open surface, or of the points
  normals,      // of the second moments of the normals: the last one is where most of the surface faces
  coordinates,  // those of the coordinates
};

enum class ScalingFactors : std::uint8_t {
  chords,   // by the mean chords of the solid along the axes; by extents where there is no closed surface
  extents,  // by the edges of the box along the axes
  given,
};

struct PrincipalScalingOptions {
  ScalingAxes axes = ScalingAxes::principal;
  ScalingFactors factors = ScalingFactors::chords;
  // What is made of the rule's factors f: 1 + stretch (f - 1). 0 leaves the object as it is, which gives
  // balls.
  double stretch = 1;
  Vec3 given{1, 1, 1};  // ScalingFactors::given: along the first, second and third axis; above 0
};

/// The mean chord along a direction u is the volume of the solid over half the integral of |n.u| over its
/// surface: the mean, over all lines along u, of the lengths of the pieces in the solid (Cauchy). It is what
/// has to be comparable: that of a bent sheet is its thickness, where its box is as high as it is bent. The
/// factor of axis i is (largest mean chord) / (its own), so that the stretched solid has the same mean chord
/// along all three; of a box these are its edges.
///
/// - Axes descend by second moments. Where two are equal (to 1e-6 of the largest moment) the axes between
/// them
///   follow the axes of the coordinates; where all are, they are these, and the rules' factors are 1. Every
///   axis has its largest component positive, the third is the cross product of the others.
/// - Given factors are divided by the least of them.
/// - The origin is the middle of the object's box. Rotated and moved input has rotated and moved axes, up to
///   rounding, where moments differ.
/// - Warns where the largest factor is below 1.1: ellipsoids will not be fewer than balls.
///
/// Throws InputError for input without points, options out of range, a solid without volume (a flat sheet),
/// points that lie in one plane to 1e-9 of their extent where extents count, and a flat object in general:
/// a thickness below 1e-9 of the largest.
Scaling principal_scaling(const PointSet& points, const TriangleMesh& mesh,
                          const PrincipalScalingOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
