// Poles of the Voronoi diagram of a sample.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Which Voronoi vertices are in the set beside the poles.
enum class Vertices : std::uint8_t {
  automatic,  // all where there is a closed mesh of the surface, else poles
  poles,      // candidates for third poles, at samples whose poles are not opposite
  all,        // all bounded ones
};

struct VoronoiPolesOptions {
  Vertices vertices = Vertices::poles;
  // Distance from the centre of the sample's bounding box to the nearest of the far-away points that bound
  // the diagram, in longest edges of that box, at least 4. It matters only to poles that are marked
  // `unbounded`: how far away they lie, and a little which direction is outwards on the convex hull.
  double bounding_distance = 10;
};

/// The poles of every sample [Amenta and Bern 1999, section 4; Kornberger 2010, 3.3 and 3.4]: the vertex of
/// its Voronoi cell farthest from it, and the farthest one v behind that, (v - s) . (p1 - s) < 0. All labels
/// are `unlabelled`, there are no third poles yet.
///
/// On smooth, well-sampled surfaces the two are nearly opposite, one on either side. At a sharp edge the
/// outer part of the cell is a fan between the normals of the faces: where it spans 90 degrees or more, both
/// poles may be in it, although the cell has vertices inside the solid too. So where the poles of a sample
/// are less than 138.6 degrees apart (cosine above -3/4), all bounded vertices of its cell behind the first
/// pole are in the result as candidates; label_poles, which knows the surface, finds the missing pole among
/// them. With Vertices::all the set has all bounded vertices, of all samples.
///
/// The diagram is that of the sample and twelve far-away points around it, so every cell of a sample is
/// bounded. A Voronoi vertex changes only if its empty ball would contain a far-away point. That ball touches
/// a sample and is longer than bounding_distance - 1 box edges, so its centre lies well outside the box, and
/// what replaces it is marked `unbounded`: Voronoi vertices inside the box do not depend on the far-away
/// points. The first pole of a sample on the convex hull is unbounded, its second pole bounded wherever the
/// cell has a bounded vertex on the other side. (Amenta and Bern take the mean normal of the hull for the
/// direction of the first.)
///
/// - accepts any finite, pairwise distinct points that are not all in one plane, cospherical ones too: which
///   Voronoi vertices coincide is decided exactly
/// - refuses (InputError) fewer than 4 points, coplanar or equal points, coordinates that are not finite,
///   and samples whose longest bounding-box edge is outside [1e-40, 1e40] (squares of volumes would leave
///   the range of double)
/// - Vertices::automatic is the same as poles here: decide() knows the mesh
/// - the result does not depend on the number of threads, and, but for the numbering, not on the order of
///   the points; equal distances are decided by the coordinates of the vertices
/// - centres are within about 1e-9 radii of the true Voronoi vertices, most of them within 1e-14; radii are
///   the largest distance from a centre to its samples
/// - expected time O(n log n) and about 1 KB of memory per point for samples of surfaces; quadratic for
///   points on curves
PoleSet voronoi_poles(const PointSet& sample, const VoronoiPolesOptions& options,
                      Monitor& monitor = no_monitor());

/// `automatic` as `all` or `poles`: the balls of all inner vertices contain every Delaunay cell whose centre
/// is inside, however thin the solid, those of poles do not. Only a closed mesh tells for every vertex on
/// which side it is. The mesh may be without triangles.
Vertices decide(Vertices vertices, const TriangleMesh& mesh);

}  // namespace ballflow::geometry
