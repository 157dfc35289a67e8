// One execution of one node across the plugin boundary.
#pragma once

#include "ballflow/executor.hpp"

namespace ballflow {

/// Runs the node in this thread and in what arena that is, without times; outputs are not hashed.
ExecutionOutcome execute_node(const ExecutionRequest& request);

}  // namespace ballflow
