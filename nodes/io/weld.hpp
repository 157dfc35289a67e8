// Vertices that are meant to be one, and the gaps between those that are not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// For each point the one that it is welded to: the nearest of the earlier points that stand for themselves
/// and are at most `tolerance` away, the first one of several; itself where there is none. Points that stand
/// for themselves are farther apart than that, and no chain of near points is pulled together.
///
/// - `first` says, as first_equal_point does, which points are equal: only the first ones are compared
/// - finite points; tolerance is positive and finite
std::vector<std::int32_t> weld(std::span<const Vec3> points, std::span<const std::int32_t> first,
                               double tolerance, Monitor& monitor = no_monitor());

/// What welding would do for an open mesh whose gaps are small.
struct SmallGaps {
  std::int64_t open_edges = 0;  // edges of one triangle
  std::int64_t left = 0;        // of them after welding
  double widest = 0;            // distance of vertices that belong together
  double tolerance = 0;         // with which they are welded, of two digits
};

/// Nothing for a mesh without open edges, and where gaps are not small: vertices on open edges have no
/// others, not joined with them by an open edge, within a twentieth of the median length of open edges, or
/// welding them would not close at least half of the open edges.
std::optional<SmallGaps> small_gaps(const TriangleMesh& mesh, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
