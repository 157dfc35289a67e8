#include "document/order.hpp"

#include <algorithm>
#include <boost/graph/depth_first_search.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/graph/two_bit_color_map.hpp>
#include <boost/range/iterator_range.hpp>
#include <functional>
#include <iterator>
#include <queue>

namespace ballflow {
namespace {

using Node = std::uint32_t;

/// Kahn's algorithm with a heap in place of the queue. boost::topological_sort has no say in which of several
/// orders it gives, and the one of a DAG must not depend on how its graph is written.
std::vector<Node> smallest_first(const Digraph& graph) {
  const std::size_t n = num_vertices(graph);
  std::vector<std::uint32_t> missing(n, 0);
  for (const auto edge : boost::make_iterator_range(edges(graph))) ++missing[target(edge, graph)];
  std::priority_queue<Node, std::vector<Node>, std::greater<>> ready;
  for (Node node = 0; node < n; ++node) {
    if (missing[node] == 0) ready.push(node);
  }
  std::vector<Node> order;
  order.reserve(n);
  while (!ready.empty()) {
    const Node node = ready.top();
    ready.pop();
    order.push_back(node);
    for (const Node next : boost::make_iterator_range(adjacent_vertices(node, graph))) {
      if (--missing[next] == 0) ready.push(next);
    }
  }
  return order;
}

/// Collects cycles that have no node in common: an edge back to a node that is still being visited closes
/// one, which runs along the way from there to here.
class CycleCollector : public boost::default_dfs_visitor {
 public:
  struct Search {
    std::vector<Node> way;           // the nodes being visited
    std::vector<std::size_t> place;  // in `way`, by node
    std::vector<std::size_t> taken;  // by place: how many nodes of the way end with the last one on a cycle
    std::vector<std::vector<Node>> cycles;
  };
  explicit CycleCollector(Search& search) : search_(search) {}

  template <class Graph>
  void discover_vertex(Node node, const Graph&) {
    search_.place[node] = search_.way.size();
    search_.way.push_back(node);
    search_.taken.push_back(search_.taken.empty() ? 0 : search_.taken.back());
  }

  template <class Edge, class Graph>
  void back_edge(Edge edge, const Graph& graph) {
    const std::size_t begin = search_.place[target(edge, graph)];
    if (search_.taken.back() > begin) return;  // a node on this cycle is on another one
    search_.cycles.emplace_back(search_.way.begin() + static_cast<std::ptrdiff_t>(begin), search_.way.end());
    for (std::size_t i = begin; i < search_.way.size(); ++i) search_.taken[i] = i + 1;
  }

  template <class Graph>
  void finish_vertex(Node, const Graph&) {
    search_.way.pop_back();
    search_.taken.pop_back();
  }

 private:
  Search& search_;
};

/// Cycles among the nodes that are `left`, whose own are taken out of it.
std::vector<std::vector<Node>> disjoint_cycles(const Digraph& graph, std::vector<bool>& left) {
  const auto is_left = [&left](Node node) { return left[node]; };
  const std::function<bool(Node)> filter = is_left;
  const boost::filtered_graph<Digraph, boost::keep_all, std::function<bool(Node)>> rest(graph, {}, filter);
  CycleCollector::Search search;
  search.place.resize(num_vertices(graph));
  auto colors = boost::make_two_bit_color_map(num_vertices(graph), get(boost::vertex_index, graph));
  boost::depth_first_search(rest, boost::visitor(CycleCollector(search)).color_map(colors));
  for (std::vector<Node>& cycle : search.cycles) {
    for (const Node node : cycle) left[node] = false;
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  }
  return std::move(search.cycles);
}

}  // namespace

TopologicalOrder topological_order(const Digraph& graph) {
  TopologicalOrder result;
  result.nodes = smallest_first(graph);
  if (result.nodes.size() == num_vertices(graph)) return result;
  std::vector<bool> left(num_vertices(graph), true);
  for (const Node node : result.nodes) left[node] = false;
  // What one search passes by, because it touches a cycle that was found, may close another one elsewhere.
  while (result.cycles.size() < most_cycles) {
    std::vector<std::vector<Node>> found = disjoint_cycles(graph, left);
    if (found.empty()) break;
    std::move(found.begin(), found.end(), std::back_inserter(result.cycles));
  }
  return result;
}

}  // namespace ballflow
