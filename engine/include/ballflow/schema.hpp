// What is derived from the declarations of nodes: JSON schemas for editors, and documentation.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/node_decl.hpp"
#include "ballflow/registry.hpp"

namespace ballflow {

/// JSON schema (draft-07) of one entry of "nodes" in a graph file: every registered node type with its
/// ports, parameters, units, ranges, choices and docs, and subgraph nodes. "${param}" is accepted in place of
/// any value.
Json nodes_schema(const Registry& registry);

/// JSON schema (draft-07) of a whole graph file; contains nodes_schema.
Json graph_schema(const Registry& registry);

/// How a graph uses a node.
struct NodeExample {
  std::string graph, file;        // what runs it, and where the node is written; relative to the folder
  std::vector<Setting> settings;  // with which the graph has the node
  Json entry;                     // {"name": {"type": ..., ...}}, as in the file
};

/// The first use of every node type in the graphs of a folder, subgraphs that they can choose included.
std::map<std::string, NodeExample> find_examples(const std::string& folder, const Registry& registry);

/// Markdown: a table of all nodes, then one section per node and per type.
std::string nodes_markdown(const Registry& registry, const std::map<std::string, NodeExample>& examples = {});

/// The section of one node: what it does, when not to use it, ports, parameters, citations, an example.
/// Without one, an entry with made-up sources is shown.
std::string node_markdown(const NodeDeclaration& node, const NodeExample* example = nullptr);

}  // namespace ballflow
