// Execution of a loop node: its body again and again, in memory.
#pragma once

#include "ballflow/executor.hpp"

namespace ballflow {

/// Runs the loop of `request.node` in this thread, the nodes of its body one after the other. Nothing is
/// hashed or stored but what the caller does with the final state. Equal messages of a node in the body are
/// passed on once, and no more than 20 of them. A failure names the node and the iteration. A loop that is
/// cancelled says what its last whole iteration gave.
ExecutionOutcome execute_loop(const ExecutionRequest& request);

/// A file that the node reads, or a node in its body; nothing when none does.
std::optional<std::string> file_read_by(const DagNode& node);

}  // namespace ballflow
