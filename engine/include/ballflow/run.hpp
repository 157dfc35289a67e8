// Running a DAG: what is in the cache is taken from there, the rest runs in parallel.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ballflow/events.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/key.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

class Executor;

struct RunOptions {
  unsigned threads = 0;  // 0: all processors that this process may use: affinity and control groups count
  /// Budget for what running nodes need, with their outputs, and for outputs that are held: each until its
  /// last consumer has ended, those of the graph that are not stored until the end. What is mapped from the
  /// store does not count, because the system can take it back. Exceeded only by one node alone that could
  /// never run otherwise, and by outputs larger than anybody could foresee. 0: 80 % of the memory that this
  /// process may use.
  std::uint64_t memory_bytes = 0;
  std::uint64_t seed = 0;
  const std::atomic<bool>* cancel = nullptr;  // polled; set it from anywhere to cancel

  bool keep_going = false;  // after a failure go on with everything that does not need the failed node
  /// A result that differs from an earlier one of the same key fails the node. Otherwise the new result
  /// replaces the old one with a warning, and what depends on it is computed anew.
  bool strict = false;
  /// Run every node with 1 thread and with max(2, threads), also those that are in the cache, one after the
  /// other. A node whose results differ fails, and its cause names the first array and element that differ.
  bool check_determinism = false;

  // Nodes by index into Dag::nodes.
  std::set<std::size_t> until;  // these and what they need; empty: what the outputs of the graph need
  std::set<std::size_t> only;   // these alone: what they need has to be in the cache. Excludes `until`
  std::set<std::size_t> force;  // computed although they are in the cache; what follows them may be a hit

  std::shared_ptr<Executor> executor;  // runs the nodes (executor.hpp); null: in this process
};

/// The greater number of threads of check_determinism.
unsigned several_threads(const RunOptions& options);

/// The call that failed: of the node itself, or of a node in the body of a loop. What it takes to run it
/// alone.
struct FailedCall {
  const DagNode* node = nullptr;              // of the Dag, or of the body of a Loop in it
  std::map<std::string, OutputEntry> inputs;  // by port; stored, unless the store could not be written
};

struct NodeResult {
  NodeStatus status = NodeStatus::pending;
  std::string reason;                   // why it ran, or why it was a hit
  double seconds = 0, cpu_seconds = 0;  // of this run; 0 for a hit
  double cost_seconds = 0;              // what computing it took, in this run or in the one that stored it
  std::string manifest;                 // of the key; empty when an input never came to be
  std::vector<OutputEntry> outputs;
  std::vector<std::string> warnings;
  std::optional<std::int64_t> iterations;  // of a loop that ran
  std::string cause, hint;                 // of a failure
  bool deterministic = true;               // false: its result disagreed with another one of the same key
  std::optional<FailedCall> failed_call;   // of a failure while it ran
};

struct RunResult {
  ExitCode status = ExitCode::ok;  // ok, node_failed or cancelled
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_rss_bytes = 0;
  std::vector<NodeResult> nodes;  // as Dag::nodes
};

/// The key manifests of a run, for the history.
Manifests manifests_of(const Dag& dag, const RunResult& result);

/// One run of a DAG. Only nodes that a graph output needs are looked at; only artifacts that a running
/// node needs are read.
class Runner {
 public:
  Runner(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
         EventSink& events, Manifests earlier = {});
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Never throws for a failing node: the failure is in the result. After a failure nothing new is started
  /// (but see keep_going); what was running is finished and stored.
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
  std::string manifest;  // of the key, without the inputs that are not known; empty when unneeded
  /// Of a hit what it took to make. Otherwise a guess: what the node took in another execution, preferably
  /// with the same parameters and with inputs of about the size, times the ratio of the sizes of the inputs.
  /// Empty when it never ran.
  std::optional<double> seconds;
  std::string seconds_from;  // where the guess comes from
  std::uint64_t memory = 0;  // the node's own estimate, for inputs of the known or guessed size
};
/// "HIT", "RUN", "MAYBE", or "-" for a node that no output needs.
std::string_view to_string(NodePlan::Verdict verdict);
std::vector<NodePlan> plan(const Dag& dag, Store& store, std::uint64_t seed, const Manifests& earlier);

/// The entry of a key in the store. One that lacks a declared output, or has it in another version of its
/// type, is a miss: it comes from a library whose author forgot to raise the behaviour version.
std::optional<ActionEntry> find_entry(Store& store, const NodeKind& kind, const Digest& key);

/// What an entry says of one output.
OutputEntry output_entry(const std::string& port, const Artifact& artifact);

/// A budget of memory: "8G", bytes, or "50%" of what this process may use (of the machine, or of the limit of
/// its control groups). Empty for anything else.
std::optional<std::uint64_t> parse_memory(std::string_view text);

/// What differs between two key manifests, each difference in words: "params.epsilon 0.3 -> 0.5", "Enlarge
/// version 1 -> 2", "library CGAL \"5.5\" -> \"5.6\"", "input balls: other content".
std::vector<std::string> manifest_differences(const std::string& before, const std::string& now);

}  // namespace ballflow
