#include "surface/minimum_cut.hpp"

#include <algorithm>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cstddef>
#include <utility>

namespace ballflow::geometry {
namespace {

struct Arc {
  std::int32_t from, to;
  std::int64_t capacity;
};

using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                 boost::no_property, std::int32_t, std::int64_t>;

/// Both arcs of every pair of nodes, sorted, parallel ones added up.
std::vector<Arc> arcs_of(const CutGraph& graph) {
  const std::int32_t source = graph.nodes, sink = source + 1;
  std::vector<Arc> arcs;
  arcs.reserve(2 * graph.edges.size() + 4 * graph.from_source.size());
  const auto add = [&](std::int32_t a, std::int32_t b, std::int64_t there, std::int64_t back) {
    arcs.push_back({a, b, there});
    arcs.push_back({b, a, back});
  };
  for (const auto& [a, b, capacity] : graph.edges) add(a, b, capacity, capacity);
  for (std::int32_t i = 0; i < graph.nodes; ++i) {
    // What the terminals both pull is cut in any case: only the difference matters.
    const std::int64_t in = graph.from_source[static_cast<std::size_t>(i)],
                       out = graph.to_sink[static_cast<std::size_t>(i)];
    if (in > out) add(source, i, in - out, 0);
    if (out > in) add(i, sink, out - in, 0);
  }
  std::sort(arcs.begin(), arcs.end(),
            [](const Arc& a, const Arc& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
  std::size_t kept = 0;
  for (const Arc& arc : arcs) {
    if (kept > 0 && arcs[kept - 1].from == arc.from && arcs[kept - 1].to == arc.to) {
      arcs[kept - 1].capacity += arc.capacity;
    } else {
      arcs[kept++] = arc;
    }
  }
  arcs.resize(kept);
  return arcs;
}

}  // namespace

MinimumCut minimum_cut(const CutGraph& graph, Monitor& monitor) {
  monitor.step(0);
  const std::vector<Arc> arcs = arcs_of(graph);
  const auto vertices = static_cast<std::size_t>(graph.nodes) + 2;
  std::vector<std::pair<std::int32_t, std::int32_t>> ends;
  std::vector<std::int64_t> capacity;
  std::vector<std::size_t> first(vertices + 1, 0);  // arc that leaves each vertex
  for (const Arc& arc : arcs) {
    ends.emplace_back(arc.from, arc.to);
    capacity.push_back(arc.capacity);
    ++first[static_cast<std::size_t>(arc.from) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
  const Graph compressed(boost::edges_are_sorted, ends.begin(), ends.end(),
                         static_cast<std::int32_t>(vertices));
  std::vector<Graph::edge_descriptor> reverse;
  reverse.reserve(arcs.size());
  for (const Arc& arc : arcs) {
    const auto begin = ends.begin() + static_cast<std::ptrdiff_t>(first[static_cast<std::size_t>(arc.to)]);
    const auto end = ends.begin() + static_cast<std::ptrdiff_t>(first[static_cast<std::size_t>(arc.to) + 1]);
    const auto back = std::lower_bound(begin, end, std::pair(arc.to, arc.from)) - ends.begin();
    reverse.emplace_back(arc.to, back);
  }
  monitor.step(0.2);
  std::vector<std::int64_t> residual(arcs.size());
  std::vector<boost::default_color_type> color(vertices);
  std::vector<Graph::edge_descriptor> predecessor(vertices);
  std::vector<std::int32_t> distance(vertices);
  const auto edge_index = get(boost::edge_index, compressed);
  const auto vertex_index = get(boost::vertex_index, compressed);
  MinimumCut result;
  result.capacity = boost::boykov_kolmogorov_max_flow(
      compressed, boost::make_iterator_property_map(capacity.begin(), edge_index),
      boost::make_iterator_property_map(residual.begin(), edge_index),
      boost::make_iterator_property_map(reverse.begin(), edge_index),
      boost::make_iterator_property_map(predecessor.begin(), vertex_index),
      boost::make_iterator_property_map(color.begin(), vertex_index),
      boost::make_iterator_property_map(distance.begin(), vertex_index), vertex_index, graph.nodes,
      graph.nodes + 1);
  for (std::int32_t i = 0; i < graph.nodes; ++i) {
    result.capacity +=
        std::min(graph.from_source[static_cast<std::size_t>(i)], graph.to_sink[static_cast<std::size_t>(i)]);
    result.at_source.push_back(color[static_cast<std::size_t>(i)] == boost::black_color ? 1 : 0);
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
