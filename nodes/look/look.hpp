// What a model is, before anything is computed from it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "io/read_mesh.hpp"
#include "io/strays.hpp"
#include "look/gaps.hpp"
#include "look/widths.hpp"
#include "search/self_intersection.hpp"
#include "search/shells.hpp"
#include "search/surface_chain.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {

/// How far samples are from their neighbours: edges of a mesh, for a cloud the distances to the next point.
struct Spacing {
  double median = 0, largest = 0;
};

struct LookOptions {
  std::size_t most_intersections = 100000;  // pairs of triangles; counting ends there
  WidthsOptions widths;
};

struct Look {
  Box box;
  Spacing spacing;
  Strays strays;  // the few points that stretch the box tenfold or more

  // Of a mesh.
  MeshTopology topology;    // of the file's triangles
  std::int64_t turned = 0;  // triangles that would be turned over, so that neighbours face the same way
  bool orientable = true;
  /// Every edge is run through as often in one direction as in the other: there is an inside, and poles are
  /// labelled by exact crossings.
  bool closed = false;
  double area = 0;
  SelfIntersections intersections;
  Gaps gaps;
  // Of a closed one.
  TriangleMesh outwards;         // its triangles, turned as the solid takes them
  std::optional<Shells> shells;  // of the triangles as the chain has them
  std::optional<Widths> widths;
  std::optional<Betti> betti;   // of the solid, where the surface is an embedded manifold
  std::string unknown_because;  // else
};

/// Where two triangles meet, about: the middle of what their bounding boxes have in common.
Vec3 place_of(const TriangleMesh& mesh, const std::array<std::int32_t, 2>& pair);

/// Looks at a model in a time that grows nearly in proportion to its size.
Look look_at(const MeshFile& model, const LookOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
