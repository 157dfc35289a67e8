// The order of the leaves of a graph.
#include <algorithm>
#include <numeric>

#include "ballflow/text.hpp"
#include "document/connect.hpp"
#include "document/order.hpp"

namespace ballflow {
namespace {

/// `cycle` runs along the edges.
void report(const Expansion& expansion, const Edges& edges, const std::vector<std::size_t>& cycle,
            Findings& findings) {
  std::string text;
  for (const std::size_t leaf : cycle) text += expansion.leaves[leaf].path + " -> ";
  text += expansion.leaves[cycle[0]].path;
  const Leaf& leaf = expansion.leaves[cycle[0]];
  const GraphNode& node = expansion.file_of(leaf.scope).nodes[leaf.node];
  Offset offset = node.offset;
  for (const auto& [port, edge] : edges[cycle[0]]) {
    if (edge.node == cycle.back()) offset = node.input(std::string(port_of_slot(port)))->from.offset;
  }
  findings.error(expansion.file_of(leaf.scope), offset, "cycle: " + printable(text),
                 "remove one of these edges");
}

}  // namespace

std::vector<std::size_t> order_leaves(const Expansion& expansion, const Edges& edges, Findings& findings) {
  std::vector<std::size_t> by_path(edges.size());
  std::iota(by_path.begin(), by_path.end(), std::size_t{0});
  std::sort(by_path.begin(), by_path.end(), [&](std::size_t a, std::size_t b) {
    return expansion.leaves[a].path < expansion.leaves[b].path;
  });
  std::vector<std::uint32_t> rank(edges.size());
  for (std::size_t i = 0; i < by_path.size(); ++i) rank[by_path[i]] = static_cast<std::uint32_t>(i);
  DigraphEdges by_rank;
  for (std::size_t leaf = 0; leaf < edges.size(); ++leaf) {
    for (const auto& [port, edge] : edges[leaf]) {
      if (edge.node != loop_input) by_rank.emplace_back(rank[edge.node], rank[leaf]);
    }
  }
  const TopologicalOrder order = topological_order(digraph(edges.size(), by_rank));
  const auto leaves = [&](const std::vector<std::uint32_t>& ranks) {
    std::vector<std::size_t> result;
    result.reserve(ranks.size());
    for (const std::uint32_t one : ranks) result.push_back(by_path[one]);
    return result;
  };
  for (const std::vector<std::uint32_t>& cycle : order.cycles)
    report(expansion, edges, leaves(cycle), findings);
  return leaves(order.nodes);
}

}  // namespace ballflow
