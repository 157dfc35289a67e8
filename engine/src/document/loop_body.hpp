// What a loop takes from the file of its body and from its "until".
#pragma once

#include <string>

#include "ballflow/graph.hpp"
#include "document/findings.hpp"
#include "document/graph_file.hpp"
#include "document/setting.hpp"

namespace ballflow {

/// The ports of a loop are those of its body: `loop` gets them. False when something is wrong with the body,
/// which is then reported. `node` is a node of `file`, `written` its kind.
bool read_interface(const GraphFile& file, const GraphNode& node, const GraphNode::Loop& written,
                    const GraphFile& body, const Registry& registry, Loop& loop, Findings& findings);

/// Reads the condition `text` and checks it against the states of `loop`. `setting` is where it was set from
/// outside, or null.
bool read_until(const GraphFile& file, const GraphNode& node, const GraphNode::Loop& written,
                const PlacedSetting* setting, const std::string& text, const Registry& registry, Loop& loop,
                Findings& findings);

}  // namespace ballflow
