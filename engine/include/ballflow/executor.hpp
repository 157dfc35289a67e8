// How one node is executed. The scheduler (run.hpp) decides which node runs, when and with which inputs; it
// knows the cache, the memory and what a failure ends. An executor gets one node with its inputs and gives
// its outputs or a failure; it knows none of that. In this process is the default; others may use another
// process or machine.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/registry.hpp"

namespace ballflow {

/// How far a loop has come. Whoever begins with this ends with the same as one who begins at the beginning.
struct LoopState {
  std::int64_t iterations = 0;                // that have ended
  std::map<std::string, ArtifactPtr> states;  // by name, every output of the body
  std::vector<std::string> warnings;          // so far
};

/// One execution of one node: of a DAG, or of a loop as a whole.
struct ExecutionRequest {
  const DagNode* node = nullptr;
  const Registry* registry = nullptr;         // has the node, and the types of its outputs
  std::map<std::string, ArtifactPtr> inputs;  // by port, connected ones only
  unsigned threads = 1;                       // that the node may use
  std::uint64_t seed = 0;
  std::uint64_t memory_bytes = 0;  // budget of the run, so that a node that needs more can say so; 0: unknown
  const LoopState* resume = nullptr;  // of a loop: begin here; an executor may begin at the beginning
  // All three may be called from any thread, until the execution ends. Whoever is asked to stop does so soon.
  std::function<bool()> cancelled;
  std::function<void(double)> progress;  // 0 to 1
  std::function<void(bool warning, const std::string&)> message;
};

/// A call of a node in the body of a loop, with what it got.
struct InnerCall {
  const DagNode* node = nullptr;
  std::map<std::string, ArtifactPtr> inputs;  // by port
};

struct ExecutionOutcome {
  enum class Status { ok, failed, cancelled } status = Status::failed;
  std::map<std::string, ArtifactPtr> outputs;  // by port, every declared one when ok, else none
  std::vector<std::string> warnings;
  std::string cause, hint;                 // when failed
  std::optional<InnerCall> failed_call;    // when failed in the body of a loop
  std::optional<std::int64_t> iterations;  // of a loop
  std::optional<LoopState> reached;        // of a loop that did not fail; an executor may leave it out
  double seconds = 0, cpu_seconds = 0;     // the latter to 0.1 ms
};

/// Called from several threads at once, once per node that runs. An execution may take its time: the caller
/// waits.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Runs the node to its end. A node that fails is an outcome; an Error that is thrown ends the node as
  /// well, and says what went wrong around it. Outputs are valid artifacts of the declared types.
  virtual ExecutionOutcome execute(const ExecutionRequest& request) = 0;
};

/// Runs nodes in this process, each apart from others: its parallel loops never pick up work of another node
/// while they wait (work stealing across nodes can deadlock). With several threads a node gets a task arena
/// of its own. Outputs are hashed when it returns.
std::shared_ptr<Executor> in_process_executor();

}  // namespace ballflow
