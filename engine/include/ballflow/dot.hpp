// A graph as a picture: text in the DOT language for Graphviz.
#pragma once

#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"

namespace ballflow {

/// The expanded DAG. A node is a table of its input ports, name, type, parameters that differ from their
/// defaults, and output ports; edges connect ports. Subgraphs are clusters. A loop is a cluster with a node
/// for the loop itself, the nodes of its body, and dashed edges that bring the state back. `plans` (as
/// Dag::nodes, or empty) adds HIT, RUN or MAYBE. Any text may occur in the graph: all of it is escaped.
std::string dot(const Dag& dag, const std::vector<NodePlan>& plans = {});

}  // namespace ballflow
