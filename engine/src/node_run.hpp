// One execution of one node across the plugin boundary.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/registry.hpp"

namespace ballflow {

struct NodeRunRequest {
  const DagNode* node = nullptr;
  const Registry* registry = nullptr;
  std::map<std::string, ArtifactPtr> inputs;  // by port
  unsigned threads = 1;
  std::uint64_t seed = 0;
  std::function<bool()> cancelled;
  std::function<void(double)> progress;
  std::function<void(bool warning, const std::string&)> message;
};

/// A call of a node in the body of a loop, with what it got.
struct InnerCall {
  const DagNode* node = nullptr;
  std::map<std::string, ArtifactPtr> inputs;  // by port
};

struct NodeRunOutcome {
  enum class Status { ok, failed, cancelled } status = Status::failed;
  std::map<std::string, ArtifactPtr> outputs;  // by port, every declared one when ok
  std::vector<std::string> warnings;
  std::string cause, hint;                 // when failed
  std::optional<InnerCall> failed_call;    // when failed in the body of a loop
  std::optional<std::int64_t> iterations;  // of a loop
  double seconds = 0, cpu_seconds = 0;
};

/// Runs the node inside a task arena of its own, so that its parallel loops never pick up work of another
/// node while they wait (work stealing across nodes can deadlock).
NodeRunOutcome run_node(const NodeRunRequest& request);

/// The same in the arena of the caller, without times; outputs are not hashed.
NodeRunOutcome call_node(const NodeRunRequest& request);

/// Does `work` for `request` in an arena of its own, hashes its outputs, and takes its times.
NodeRunOutcome run_in_arena(const NodeRunRequest& request, const std::function<NodeRunOutcome()>& work);

}  // namespace ballflow
