// Instances -> flat DAG: which output every input reads, whether the types agree, in which order nodes can
// run.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "document/expand.hpp"
#include "document/references.hpp"

namespace ballflow {

/// By leaf and input port; EdgeRef::node is a leaf, or `loop_input` for an input of the loop around it and
/// for an artifact from outside.
using Edges = std::vector<std::map<std::string, EdgeRef>>;

/// Connects the leaves and checks every reference: ports, types, what is required. `given` are the artifacts
/// for the inputs of the top graph.
Edges connect_leaves(const Expansion& expansion, const Registry& registry,
                     const std::map<std::string, ArtifactPtr>& given, References& references,
                     Findings& findings);

/// The leaves in topological order, ties by path. Cycles are reported, each once.
std::vector<std::size_t> order_leaves(const Expansion& expansion, const Edges& edges, Findings& findings);

/// The leaves in this order as a DAG, those of loop bodies as the DAGs of the loops.
Dag build_dag(const Expansion& expansion, const Edges& edges, const std::vector<std::size_t>& order,
              const std::map<std::string, ArtifactPtr>& given, References& references);

/// All of it. An empty DAG when something is wrong.
Dag connect(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, Findings& findings);

}  // namespace ballflow
