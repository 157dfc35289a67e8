// Directed graphs for the algorithms of Boost.Graph: nodes are numbers, and every node lies with the nodes
// that its edges lead to in one array.
#pragma once

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ballflow {

using Digraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                   boost::no_property, std::uint32_t, std::uint32_t>;
using DigraphEdges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // from, to

/// The graph of `nodes` nodes with these edges; there may be several between two nodes.
inline Digraph digraph(std::size_t nodes, const DigraphEdges& edges) {
  return {boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(),
          static_cast<std::uint32_t>(nodes)};
}

}  // namespace ballflow
