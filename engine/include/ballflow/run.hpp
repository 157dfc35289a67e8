// Running a DAG: what is in the cache is taken from there, the rest runs in parallel.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/events.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/key.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

struct RunOptions {
  unsigned threads = 0;            // 0: all cores
  std::uint64_t memory_bytes = 0;  // budget for the estimates of running nodes; 0: 80 % of the memory
  std::uint64_t seed = 0;
  const std::atomic<bool>* cancel = nullptr;  // polled; set it from anywhere to cancel
};

struct NodeResult {
  NodeStatus status = NodeStatus::pending;
  std::string reason;                   // why it ran, or why it was a hit
  double seconds = 0, cpu_seconds = 0;  // of this run; 0 for a hit
  std::string manifest;                 // of the key; empty when an input never came to be
  std::vector<OutputEntry> outputs;
  std::vector<std::string> warnings;
  std::optional<std::int64_t> iterations;  // of a loop that ran
  std::string cause, hint;                 // of a failure
};

struct RunResult {
  ExitCode status = ExitCode::ok;  // ok, node_failed or cancelled
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_rss_bytes = 0;
  std::vector<NodeResult> nodes;  // as Dag::nodes
};

/// Key manifests of an earlier run by node path: what reasons are compared with.
using Manifests = std::map<std::string, std::string>;

/// One run of a DAG. Only nodes that a graph output needs are looked at; only artifacts that a running
/// node needs are read.
class Runner {
 public:
  Runner(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
         EventSink& events, Manifests earlier = {});
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Never throws for a failing node: the failure is in the result. After a failure nothing new is started;
  /// what was running is finished and stored.
  const RunResult& run();

  /// The artifact of a finished output, from memory, from the store, or by running its node again. Throws
  /// Error when that fails.
  ArtifactPtr artifact(const EdgeRef& output);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a run would do, without doing it.
struct NodePlan {
  enum class Verdict {
    hit,
    run,
    maybe,
    unneeded
  };  // maybe: an input will be computed anew and may turn out equal
  Verdict verdict = Verdict::run;
  std::string reason;
  std::optional<double> seconds;  // what the node took when it last ran with this key
};
std::vector<NodePlan> plan(const Dag& dag, Store& store, std::uint64_t seed, const Manifests& earlier);

/// The entry of a key in the store. One that lacks a declared output, or has it in another version of its
/// type, is a miss: it comes from a library whose author forgot to raise the behaviour version.
std::optional<ActionEntry> find_entry(Store& store, const NodeDeclaration& decl, const Digest& key);

/// Which nodes the outputs of the graph need; as Dag::nodes.
std::vector<bool> needed_nodes(const Dag& dag);

/// What differs between two key manifests, in words ("params.epsilon 0.3 -> 0.5").
std::vector<std::string> manifest_differences(const std::string& before, const std::string& now);

}  // namespace ballflow
