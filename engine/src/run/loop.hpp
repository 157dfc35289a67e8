// Execution of a loop node: its body again and again, in memory.
#pragma once

#include "run/node_run.hpp"

namespace ballflow {

/// Runs the loop of `request.node`. The nodes of the body run one after the other in one task arena. Nothing
/// is hashed or stored but what the scheduler does with the final state. Equal messages of a node in the body
/// are passed on once, and no more than 20 of them. A failure names the node and the iteration.
NodeRunOutcome run_loop(const NodeRunRequest& request);

/// A file that the node reads, or a node in its body; nothing when none does.
std::optional<std::string> file_read_by(const DagNode& node);

}  // namespace ballflow
