// The text of a graph file -> GraphFile. What is wrong with the file alone is found here, once, no matter how
// often the graph is included.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "document/findings.hpp"
#include "document/graph_file.hpp"

namespace ballflow {

/// Reports the keys of an object that are not among `known`; `what` says what it is ("a node").
bool known_keys(const GraphFile& file, Findings& findings, const json_text::Value& object,
                const std::string& what, const std::vector<std::string>& known);

/// Whether the value of a member is a text, which `to` then has; reported otherwise.
bool read_text(const GraphFile& file, Findings& findings, const json_text::Member& member, std::string& to);

/// Reads one entry of the section "params".
GraphParam read_param(const GraphFile& file, Findings& findings, const json_text::Member& member);

/// Reads a value, in which "${name}" stands for a parameter.
Template read_template(GraphFile& file, Findings& findings, const json_text::Value& value);

/// Reads an edge, "node.port" or "inputs.name"; `consumer` is the node that has it, or null.
Reference read_reference(GraphFile& file, Findings& findings, const json_text::Value& value,
                         const GraphNode* consumer);

/// Reads the sections "sweep" and "map" of a graph.
void read_sweep(GraphFile& file, Findings& findings);

/// Reads a text; null when it is no JSON object. Everything else that is wrong becomes findings, and the
/// elements concerned are marked as broken.
std::unique_ptr<GraphFile> read_graph_file(json_text::Source source, Findings& findings);

}  // namespace ballflow
