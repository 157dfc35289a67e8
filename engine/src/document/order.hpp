// In which order the nodes of a directed graph can run, and what keeps them from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "document/digraph.hpp"

namespace ballflow {

/// Edges lead from what comes first to what comes after.
struct TopologicalOrder {
  /// Every node after those that have edges to it; of all that can come next, the smallest. Without the nodes
  /// that are on a cycle or behind one.
  std::vector<std::uint32_t> nodes;
  /// Along the edges, from the smallest node. No two have a node in common, and without their nodes the graph
  /// has no cycles, unless more than `most_cycles` were found.
  std::vector<std::vector<std::uint32_t>> cycles;
};

/// After this many cycles no further search begins.
constexpr std::size_t most_cycles = 100;

TopologicalOrder topological_order(const Digraph& graph);

}  // namespace ballflow
