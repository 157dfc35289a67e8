// Inner and outer poles.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "poles/voronoi_poles.hpp"
#include "types/balls.hpp"
#include "types/pole_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class LabelMethod : std::uint8_t { automatic, mesh, winding, angle };

/// "auto", "mesh", "winding" or "angle".
const char* name(LabelMethod method);

/// Which outer polar balls are wanted.
enum class OuterBalls : std::uint8_t {
  all,      // those of unbounded poles too, which end at far-away points
  bounded,  // those that only samples bound: what the medial axis of the outside is made of
};

struct LabelPolesOptions {
  LabelMethod method = LabelMethod::automatic;
  OuterBalls outer = OuterBalls::all;
  Vertices vertices = Vertices::poles;  // which entries of the set are balls: poles only, or all of them
};

struct LabelledPoles {
  PoleSet poles;  // labelled, with third poles; with Vertices::poles without the other candidates
  Balls inner;    // balls of the inner entries, in their order: the discrete medial axis transform
  Balls outer;    // those of the outer entries, all of them or the bounded ones

  LabelMethod method = LabelMethod::mesh;  // what was used: mesh, winding or angle
  // Poles whose label says little (of the poles that are in the result): winding number in [1/4, 3/4], or
  // centre exactly on the surface; for `angle` strong evidence against the label (see angle_labels).
  std::int64_t uncertain = 0;
  std::int64_t unlabelled = 0;  // `angle` only: poles of which nothing is known, neither inner nor outer
  std::int64_t turned_triangles = 0;  // turned over to make the mesh consistently oriented
};

/// Labels a pole inner when the mesh winds around it by more than 1/2 [Aichholzer et al. 2007 label poles by
/// a mesh too; Kornberger 2010, 3.4]. It is the Voronoi vertex that is labelled, once, not the pole of each
/// sample.
///
/// - `mesh`: closed meshes, that is, every edge is run through equally often in both directions once
///   triangles are turned over where they disagree. Signed crossings of a ray are counted with exact
///   predicates: right at sharp edges, where the sample is too coarse, with components inside each other (a
///   component of negative volume inside another one bounds a cavity) and with self-intersections (inside
///   means wound around at least once)
/// - `winding`: any mesh; open ones by the generalized winding number [Jacobson et al. 2013]
/// - `angle`: no mesh at all, see angle_labels; for clouds of points
/// - `automatic`: `mesh` when the mesh is closed, `angle` when it has no triangles, else `winding` and a
///   warning that says why and how many poles are uncertain
///
/// Where the first two poles of a sample have the same label, as happens at sharp edges, the farthest vertex
/// of its cell with the other label, among the poles and candidates of the set, becomes its third pole. Equal
/// radii are decided by the coordinates of the centres. A sample has poles on one side only when no listed
/// vertex of its cell is on the other.
///
/// Vertices::all keeps the entries that are poles of no sample, labelled like the others, and their balls;
/// automatic does where the mesh is closed. Method angle knows nothing of them and drops them.
///
/// Unbounded poles are outer. A pole exactly on the surface is outer.
///
/// No triangles, `mesh` may be {}, say that there is no mesh.
///
/// Refuses (InputError), with method automatic, an open mesh around which fewer than a fifth as many poles as
/// samples are inside, or more than a fifth of the poles are uncertain: a sheet. Refuses a mesh without
/// triangles when `mesh` or `winding` is asked for, indices out of range, a mesh that is not closed when
/// `mesh` is asked for, and an inside without any pole: an open sheet has none. Preconditions: `poles` and
/// the mesh are in the same coordinates; broken_invariant(poles) is empty.
LabelledPoles label_poles(const PoleSet& poles, const TriangleMesh& mesh, const LabelPolesOptions& options,
                          Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
