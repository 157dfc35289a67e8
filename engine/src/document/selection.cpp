// Which nodes of a DAG a name or an output stands for.
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/two_bit_color_map.hpp>
#include <boost/pending/queue.hpp>

#include "ballflow/error.hpp"
#include "ballflow/graph.hpp"
#include "document/digraph.hpp"

namespace ballflow {

std::vector<bool> needed_nodes(const Dag& dag, const std::set<std::size_t>& targets) {
  DigraphEdges against;  // from consumers to what they read
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    for (const auto& [port, edge] : dag.nodes[i].inputs) {
      if (edge.node != loop_input)
        against.emplace_back(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(edge.node));
    }
  }
  const Digraph graph = digraph(dag.nodes.size(), against);
  const auto colors = boost::make_two_bit_color_map(num_vertices(graph), get(boost::vertex_index, graph));
  boost::queue<std::uint32_t> queue;
  boost::breadth_first_visit(graph, targets.begin(), targets.end(), queue, boost::default_bfs_visitor(),
                             colors);
  std::vector<bool> needed(dag.nodes.size());
  for (std::uint32_t i = 0; i < needed.size(); ++i) needed[i] = get(colors, i) != boost::two_bit_white;
  return needed;
}

std::vector<bool> needed_nodes(const Dag& dag) {
  std::set<std::size_t> targets;
  for (const DagOutput& output : dag.outputs) {
    if (output.from.node != loop_input) targets.insert(output.from.node);
  }
  return needed_nodes(dag, targets);
}

std::set<std::size_t> nodes_named(const Dag& dag, const std::string& path) {
  std::set<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const std::string& node = dag.nodes[i].path;
    known.push_back(node);
    const auto is_or_below = [&path](const std::string& one) {
      return one == path || one.rfind(path + "/", 0) == 0;
    };
    const std::string base = base_path(node);
    if (is_or_below(node) || is_or_below(base) || is_or_below(without_entries(base))) found.insert(i);
  }
  for (const Variant& variant : dag.variants) {
    if (variant.name == path) found.insert(variant.nodes.begin(), variant.nodes.end());
  }
  if (!found.empty()) return found;
  const std::string near = nearest(path, known);
  throw Error(ExitCode::usage, dag.file + " has no node \"" + path + "\"",
              near.empty() ? "\"ballflow plan\" lists the nodes" : "did you mean \"" + near + "\"?");
}

}  // namespace ballflow
