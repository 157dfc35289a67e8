// Graphs and runs as a page holds them.
#pragma once

#include <cstddef>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/history.hpp"
#include "ballflow/run.hpp"

namespace ballflow::show {

/// A graph is {"name", "doc", "run", "started", "status", "seconds", "cpu_seconds", "params", "nodes"}; a
/// node
/// {"path", "name", "type", "status", "reason", "seconds", "cost_seconds", "iterations", "params", "inputs",
/// "outputs", "body", "warnings", "error"}. What is not known is not there. Inputs are "path.port" of what is
/// read; outputs are {"type", "digest", "bytes", "summary"} by port.
///
/// A variant is {"graph": number, "name", "values": {axis: value}, "nodes": [numbers],
/// "outputs": [{"name", "from", "digest", "type"}]}.
struct RunJson {
  Json graph, variants;
};

/// Of a recorded run, which is graph number `number` of the page. A report may come from anywhere: fields of
/// the wrong kind are as good as absent.
RunJson run_json(const RunRecord& run, std::size_t number);

/// Of a graph that has not run. `plans` as Dag::nodes, or empty.
Json graph_json(const Dag& dag, const std::vector<NodePlan>& plans);
Json variants_json(const Dag& dag, std::size_t number);

}  // namespace ballflow::show
