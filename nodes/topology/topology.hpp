// The topology of a shape along a pipeline: one table from what was found out at every stage.
#pragma once

#include "base/monitor.hpp"
#include "types/medial_axis.hpp"
#include "types/simplicial_complex.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {

/// What is there of the stages of a pipeline; null for what is not.
struct TopologyInputs {
  const TopologyTable* surface = nullptr;  // the row of solid_row(), or no row
  const TopologyTable* inner = nullptr;    // the row of union_row() for each of the others
  const TopologyTable* enlarged = nullptr;
  const TopologyTable* kept = nullptr;  // not needed where `complex` is the alpha-shape of the balls
  const SimplicialComplex* complex = nullptr;
  const MedialAxis* axis = nullptr;
};

/// One row per stage that is there. Everything that differs is a warning in words.
/// - Throws InputError when there is no row at all, and for a table with rows of another stage than its own.
TopologyTable topology(const TopologyInputs& stages, Monitor& monitor);

}  // namespace ballflow::geometry
