// Minimum cuts of graphs with two terminals.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// A graph of `nodes` nodes beside a source and a sink. Capacities are integers, so that the cut is exact.
struct CutGraph {
  struct Edge {
    std::int32_t a, b;      // two different nodes; there may be several edges between them
    std::int64_t capacity;  // in either direction, >= 0
  };
  std::int32_t nodes = 0;
  std::vector<Edge> edges;
  std::vector<std::int64_t> from_source, to_sink;  // per node, >= 0
};

struct MinimumCut {
  std::vector<std::uint8_t> at_source;  // per node, 1 on the side of the source
  std::int64_t capacity = 0;            // of what is cut
};

/// The cut of least capacity; of several the one with the fewest nodes at the source. By Boykov and
/// Kolmogorov's algorithm (2004), Boost.Graph's, on a compressed graph. Precondition: all capacities together
/// are below 2^62.
MinimumCut minimum_cut(const CutGraph& graph, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
