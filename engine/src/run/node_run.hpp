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
  double seconds = 0, cpu_seconds = 0;     // the latter to 0.1 ms
};

/// Runs the node apart from others: its parallel loops never pick up work of another node while they wait
/// (work stealing across nodes can deadlock). With several threads it gets a task arena of its own.
NodeRunOutcome run_node(const NodeRunRequest& request);

/// The same within what already runs apart, without times; outputs are not hashed.
NodeRunOutcome call_node(const NodeRunRequest& request);

/// Does `work` for `request` like run_node: apart from other nodes, outputs hashed, times taken.
NodeRunOutcome run_alone(const NodeRunRequest& request, const std::function<NodeRunOutcome()>& work);

}  // namespace ballflow
