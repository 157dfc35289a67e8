// The inside of Runner. runner.cpp has rounds and their ends, scheduler.cpp what happens to a node and when,
// execution.cpp hands nodes to the executor and stores what they give, artifacts.cpp keeps, loads and makes
// again, determinism.cpp runs nodes again to compare.
#pragma once

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <unordered_map>

#include "ballflow/executor.hpp"
#include "ballflow/gc.hpp"
#include "ballflow/run.hpp"
#include "run/forecast.hpp"
#include "run/key_waits.hpp"
#include "run/memory_budget.hpp"

namespace ballflow {

/// Thrown when an artifact that had to be computed again came out different: all keys that were derived
/// from the old one are void.
struct PlanIsVoid {};

/// Thrown when an artifact that had to be computed again was not, because nobody wants results any more.
struct Stopped {};

// entries.cpp
const OutputEntry* find_output(const std::vector<OutputEntry>& outputs, const std::string& port);
bool same_digests(const std::vector<OutputEntry>& entries, const ExecutionOutcome& outcome);
bool same_digests(const std::vector<OutputEntry>& a, const std::vector<OutputEntry>& b);
/// Whether all declared outputs are there, of the declared types and versions.
bool gives_declared(const std::vector<OutputEntry>& outputs, const std::vector<PortDecl>& declared);
std::uint64_t bytes_of(const std::vector<OutputEntry>& outputs);
/// The entry of the key that the manifest stands for; does not count as a use.
std::optional<ActionEntry> entry_of_manifest(Store& store, const std::string& manifest);

/// The first difference between two sets of outputs by port, in words; empty when there is none.
std::string first_difference(const std::map<std::string, ArtifactPtr>& a,
                             const std::map<std::string, ArtifactPtr>& b);

class Runner::Impl {
 public:
  Impl(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
       EventSink& events, Manifests earlier);
  const RunResult& run();
  ArtifactPtr artifact(const EdgeRef& output);

 private:
  using Clock = std::chrono::steady_clock;
  struct State {
    std::mutex mutex;                         // held while the node's artifacts are made again
    std::map<std::string, ArtifactPtr> held;  // by port; guarded by mutex
    std::optional<Digest> key;
    std::vector<std::size_t> consumers;  // needed nodes that read an output, each once
    std::vector<std::size_t> twins;      // other needed nodes that compute the same from the same
    std::size_t inputs_missing = 0;      // guarded by mutex_
    std::size_t consumers_left = 0;      // and twins; guarded by mutex_
    bool admitted = false;               // it has got its memory from the budget
    bool told_key = false;               // that another process computes the same
    std::atomic<std::int64_t> last_progress{0};
  };
  static constexpr std::size_t nobody = static_cast<std::size_t>(-1);
  /// The nodes of one key.
  struct Flight {
    std::size_t leader = nobody;  // computes or finds the result
    bool forced = false;          // the leader is
    std::vector<std::size_t> followers;
    std::size_t settled = nobody;  // the first that has a result
  };

  // runner.cpp
  bool cancelled() const;
  bool stopping() const;
  bool may_run(std::size_t i) const { return options_.only.empty() || options_.only.count(i) != 0; }
  void emit(Event event) noexcept;
  void message(std::size_t i, bool warning, const std::string& text);
  bool run_once();
  void find_twins();
  void name_what_did_not_run();

  // scheduler.cpp
  void dispatch(std::size_t i);
  void dispatch_admitted(const std::vector<std::size_t>& nodes);
  void process(std::size_t i);
  bool go_on_with(std::size_t i);
  bool resolve(std::size_t i);
  bool lead(std::size_t i, bool forced, std::size_t& leader);
  bool is_forced(std::size_t i);
  bool wait_for_key(std::size_t i);
  std::optional<ActionEntry> known_entry(std::size_t i);
  ActionKey make_key(const DagNode& node);
  bool admit(std::size_t i);
  std::uint64_t memory_claim(std::size_t i);
  std::uint64_t input_bytes(std::size_t i) const;
  std::uint64_t output_claim(std::size_t i, std::uint64_t read);
  bool adopt(std::size_t i, const ActionEntry& entry, const std::string& reason);
  std::string why(std::size_t i) const;
  bool settle(std::size_t i, NodeStatus status, const std::string& reason);
  bool follow(std::size_t i, std::size_t leader);
  void compare_with_equals(std::size_t i);
  std::vector<std::size_t> producers_of(std::size_t i) const;

  // execution.cpp
  void check_files(std::size_t i);
  void compare_with_earlier(std::size_t i, const ExecutionOutcome& outcome);
  NodeStatus execute_and_publish(std::size_t i);
  ExecutionOutcome execute(std::size_t i, unsigned threads, const LoopState* resume = nullptr);
  ExecutionOutcome execute_for_jobs(std::size_t i);
  void progress(std::size_t i, double fraction);
  std::vector<OutputEntry> publish(std::size_t i, const ExecutionOutcome& outcome);

  // artifacts.cpp
  bool is_at_hand(const EdgeRef& edge, const OutputEntry& entry);
  ArtifactPtr ensure(const EdgeRef& edge, std::size_t reader);
  ArtifactPtr load(const EdgeRef& edge, const OutputEntry& entry, std::size_t reader);
  void keep(State& state, const std::map<std::string, ArtifactPtr>& artifacts);
  void disagree(std::size_t i);
  void tell_disagreement(std::size_t i);
  void forget(std::size_t i);

  // determinism.cpp
  void check_determinism();
  std::string compare_executions(std::size_t i);

  const Dag& dag_;
  const Registry& registry_;
  std::shared_ptr<Store> store_;
  std::unique_ptr<Lease> lease_;  // what this run uses is not collected while it lives
  RunOptions options_;
  std::shared_ptr<Executor> executor_;
  EventSink& events_;
  Manifests earlier_;
  RunResult result_;
  Clock::time_point start_ = Clock::now();
  std::set<std::pair<std::size_t, std::string>> wanted_;  // outputs of the graph
  const std::vector<NodeResult>* before_ = nullptr;       // of the round before, while a round is on
  std::vector<std::unique_ptr<State>> states_;
  std::vector<bool> needed_;
  std::atomic<std::size_t> tasks_{0};     // of nodes that run or are about to be looked at
  std::unique_ptr<MemoryBudget> budget_;  // of the round
  OutputSizes output_sizes_;
  // While a round is on.
  tbb::task_arena* arena_ = nullptr;
  tbb::task_group* group_ = nullptr;
  KeyWaits* key_waits_ = nullptr;
  std::mutex mutex_, events_mutex_;
  std::set<std::size_t> force_;  // not yet computed; guarded by mutex_
  std::unordered_map<Digest, Flight> flights_;
  std::map<Digest, ActionEntry> replaced_;  // of nodes that turned out not to be deterministic
  std::set<std::size_t> nondeterministic_;  // guarded by mutex_
  // stop_: nobody wants results any more; stop_starting_: what runs may end, nothing new begins
  std::atomic<bool> stop_{false}, stop_starting_{false}, void_{false};
};

}  // namespace ballflow
