// What is derived from the declarations of nodes: JSON schemas for editors, and documentation.
#pragma once

#include <string>

#include "ballflow/node_decl.hpp"
#include "ballflow/registry.hpp"

namespace ballflow {

/// JSON schema (draft-07) of one entry of "nodes" in a graph file: every registered node type with its
/// ports, parameters, units, ranges, choices and docs, and subgraph nodes. "${param}" is accepted in place of
/// any value.
Json nodes_schema(const Registry& registry);

/// JSON schema (draft-07) of a whole graph file; contains nodes_schema.
Json graph_schema(const Registry& registry);

/// Markdown: a table of all nodes, then one section per node and per type.
std::string nodes_markdown(const Registry& registry);

/// The section of one node: what it does, when not to use it, ports, parameters, citations, an example.
std::string node_markdown(const NodeDeclaration& node);

}  // namespace ballflow
