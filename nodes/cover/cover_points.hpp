// What the balls have to cover: the samples alone, or more of the surface between them.
#pragma once

#include <cstdint>

#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class Demand : std::uint8_t {
  automatic,  // by thickness()
  samples,
  facets,   // and the centre of every triangle
  edges,    // and of every triangle and edge
  patches,  // whole triangles: one ball has to contain all three corners
};

struct CoverPoints {
  Demand demand = Demand::samples;  // what is covered: never automatic
  PointSet points;  // the samples first, then centres; pairwise distinct, without normals if there are any
  TriangleMesh patches;  // of Demand::patches: vertices are the points; without triangles else
};

/// How thick a solid is where it was sampled, against how densely: the median over the samples of the largest
/// ball through each, in mean lengths of the surface's edges at it. 0 without such samples.
/// `balls` are inner balls that know the samples they pass through.
double thickness(const TriangleMesh& surface, const Balls& balls);

/// What is covered for a solid of that thickness: from 1.5 on samples, from 1 on facets, below edges.
///
/// From 14 models (docs/sampling.md has the figures): ten are above 1.7, where facets take 1 to 20 % more
/// balls than samples and holes are rare. Below 1.3 samples leave up to 12 % of the surface outside, what is
/// said here at most 5 %, for 2 to 26 % more balls.
Demand demand_for(double thickness);

/// Where walls are thin a ball reaches few samples, and balls that cover all samples leave holes between
/// them. Centres of triangles cost nothing to have and close most holes; thick shapes are covered by fewer
/// balls without.
///
/// - `surface` is a triangulation of the samples: its vertices are they. Without triangles there is nothing
///   between samples, and every demand is that for samples.
/// - `balls`: the inner balls of the samples, for Demand::automatic alone. It covers the samples where they
/// do not
///   know the samples they pass through.
/// - A union that covers patches contains the triangles whole.
///
/// Throws InputError where the surface's vertices are not the samples, or an index is out of range.
CoverPoints cover_points(const PointSet& samples, const TriangleMesh& surface, Demand demand,
                         const Balls& balls = {});

}  // namespace ballflow::geometry
