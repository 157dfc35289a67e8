// Betti numbers of the union of balls of one stage of a pipeline.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {

struct UnionTopologyOptions {
  // inner: polar balls, taken with the tolerance `polar` of PowerDiagram; enlarged and kept: taken as they
  // are.
  TopologyStage stage = TopologyStage::kept;
};

/// The row of a topology table for a set of balls; no simplex is listed, and no balls are 0 0 0.
/// - Accepts and refuses what alpha_shape does. Throws InputError for stages that are no unions of balls.
TopologyTable union_row(const Balls& balls, const UnionTopologyOptions& options, Monitor& monitor);
/// The same where the power diagram is known; it brings its own tolerance.
TopologyTable union_row(const PowerDiagram& diagram, const UnionTopologyOptions& options, Monitor& monitor);

}  // namespace ballflow::geometry
