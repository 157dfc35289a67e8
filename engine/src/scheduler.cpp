#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <thread>

#include "ballflow/gc.hpp"
#include "ballflow/run.hpp"
#include "loop.hpp"
#include "node_run.hpp"

namespace ballflow {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t peak_rss() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t physical_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// What is cheaper to compute again than to write and to read is not stored: a covering matrix of 740 MB
/// takes a second to build. 500 MB/s is what hashing, writing and mapping cost on an ordinary disk; small
/// artifacts are always stored.
bool worth_storing(std::uint64_t bytes, double seconds) {
  constexpr std::uint64_t always = 16u << 20;
  constexpr double bytes_per_second = 500e6;
  return bytes <= always || seconds * bytes_per_second >= static_cast<double>(bytes);
}

/// Nodes slower than this are flushed to the disk before they are published.
constexpr double sync_seconds = 1.0;

/// Thrown when an artifact that had to be computed again came out different: all keys that were derived
/// from the old one are void.
struct PlanIsVoid {};

/// Thrown when an artifact that had to be computed again was not, because nobody wants results any more.
struct Stopped {};

const OutputEntry* find_output(const std::vector<OutputEntry>& outputs, const std::string& port) {
  for (const OutputEntry& output : outputs) {
    if (output.port == port) return &output;
  }
  return nullptr;
}

}  // namespace

std::string_view to_string(NodeStatus status) {
  switch (status) {
    case NodeStatus::pending:
      return "pending";
    case NodeStatus::hit:
      return "hit";
    case NodeStatus::run:
      return "run";
    case NodeStatus::failed:
      return "failed";
    case NodeStatus::skipped:
      return "skipped";
    case NodeStatus::cancelled:
      return "cancelled";
  }
  return "";
}

class Runner::Impl {
 public:
  Impl(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
       EventSink& events, Manifests earlier)
      : dag_(dag),
        registry_(registry),
        store_(std::move(store)),
        lease_(Lease::take(store_)),
        options_(options),
        events_(events),
        earlier_(std::move(earlier)) {
    if (options_.threads == 0) options_.threads = std::max(1u, std::thread::hardware_concurrency());
    if (options_.memory_bytes == 0) options_.memory_bytes = physical_memory() / 10 * 8;
    result_.nodes.resize(dag.nodes.size());
    for (const DagOutput& output : dag.outputs) wanted_.emplace(output.from.node, output.from.port);
  }

  const RunResult& run() {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options_.threads);
    const auto start = Clock::now();
    const double cpu = process_cpu_seconds();
    emit({Event::Kind::run_started, 0, 0, false, {}, nullptr});
    // A round that ends with a void plan has learned the new outputs of at least one node. A node that gives
    // yet another result in every round is given up.
    for (std::size_t round = 0; !run_once(); ++round) {
      if (round < dag_.nodes.size()) continue;
      for (NodeResult& node : result_.nodes) {
        if (node.status != NodeStatus::pending && node.status != NodeStatus::cancelled) continue;
        node.status = NodeStatus::failed;
        node.cause = "needs the output of a node that gives another result whenever it runs";
        node.hint = "make that node deterministic: see the warnings above";
      }
      break;
    }
    result_.seconds = since(start);
    result_.cpu_seconds = process_cpu_seconds() - cpu;
    result_.peak_rss_bytes = peak_rss();
    result_.status = ExitCode::ok;
    for (const NodeResult& node : result_.nodes) {
      if (node.status == NodeStatus::failed) result_.status = ExitCode::node_failed;
    }
    if (result_.status == ExitCode::ok && cancelled()) {
      for (const NodeResult& node : result_.nodes) {
        if (node.status == NodeStatus::cancelled) result_.status = ExitCode::cancelled;
      }
    }
    emit({Event::Kind::run_finished, 0, 0, false, {}, nullptr});
    return result_;
  }

  ArtifactPtr artifact(const EdgeRef& output) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options_.threads);
    try {
      return ensure(output);
    } catch (const PlanIsVoid&) {
      throw Error(ExitCode::node_failed,
                  dag_.nodes[output.node].path + " gave another result when it was run again",
                  "the node is not deterministic; run the command again to compute what depends on it anew");
    } catch (const Stopped&) {
      throw Error(ExitCode::cancelled,
                  "cancelled while " + dag_.nodes[output.node].path + " was run again for its output");
    }
  }

 private:
  struct State {
    std::mutex mutex;                         // held while the node's artifacts are made again
    std::map<std::string, ArtifactPtr> held;  // by port; guarded by mutex
    std::optional<ActionKey> key;
    std::vector<std::size_t> consumers;  // needed nodes that read an output, each once
    std::size_t inputs_missing = 0;      // guarded by mutex_
    std::size_t consumers_left = 0;      // guarded by mutex_
    std::atomic<std::int64_t> last_progress{0};
  };
  struct Flight {
    std::size_t leader;
    std::vector<std::size_t> followers;
  };

  bool cancelled() const {
    return options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed);
  }
  bool stopping() const { return cancelled() || stop_.load(std::memory_order_relaxed); }

  /// What goes wrong while events are shown must not cost the results.
  void emit(const Event& event) noexcept {
    const std::lock_guard lock(events_mutex_);
    try {
      events_.on(event);
    } catch (...) {
    }
  }

  /// False when the plan became void and everything has to be looked at again.
  bool run_once() {
    const std::vector<NodeResult> before = std::move(result_.nodes);
    result_.nodes.assign(dag_.nodes.size(), {});
    before_ = &before;
    states_.clear();
    for (std::size_t i = 0; i < dag_.nodes.size(); ++i) states_.push_back(std::make_unique<State>());
    flights_.clear();
    deferred_.clear();
    memory_used_ = 0;
    running_ = 0;
    stop_ = false;
    stop_starting_ = false;
    void_ = false;

    const std::vector<bool> needed = needed_nodes(dag_);
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
      if (!needed[i]) {
        result_.nodes[i].status = NodeStatus::skipped;
        result_.nodes[i].reason = "no output of the graph needs it";
        continue;
      }
      const std::vector<std::size_t> producers = producers_of(i);
      states_[i]->inputs_missing = producers.size();
      for (const std::size_t producer : producers) {
        states_[producer]->consumers.push_back(i);
        ++states_[producer]->consumers_left;
      }
      if (producers.empty()) ready.push_back(i);
    }

    tbb::task_arena arena(static_cast<int>(options_.threads));
    arena.execute([&] {
      tbb::task_group group;
      group_ = &group;
      for (const std::size_t i : ready) dispatch(i);
      group.wait();
      group_ = nullptr;
    });
    before_ = nullptr;
    if (void_ && !cancelled()) return false;
    for (NodeResult& node : result_.nodes) {
      if (node.status != NodeStatus::pending) continue;
      node.status = cancelled() ? NodeStatus::cancelled : NodeStatus::skipped;
      node.reason = cancelled() ? "the run was cancelled" : "another node failed first";
    }
    return true;
  }

  void dispatch(std::size_t i) {
    group_->run([this, i] { process(i); });
  }

  /// Everything that can go wrong with one node ends here, as its result.
  void process(std::size_t i) {
    try {
      resolve(i);
    } catch (const PlanIsVoid&) {
      void_ = true;
      stop_ = true;
      settle(i, NodeStatus::cancelled, "");
    } catch (const Stopped&) {
      settle(i, NodeStatus::cancelled, "the run was cancelled");
    } catch (const Error& error) {
      result_.nodes[i].cause = error.what();
      result_.nodes[i].hint = error.hint();
      settle(i, NodeStatus::failed, "");
    } catch (const std::bad_alloc&) {
      result_.nodes[i].cause = "out of memory";
      result_.nodes[i].hint = "use a smaller input or a machine with more memory";
      settle(i, NodeStatus::failed, "");
    } catch (const std::exception& error) {
      result_.nodes[i].cause = error.what();
      settle(i, NodeStatus::failed, "");
    } catch (...) {
      result_.nodes[i].cause = "the node threw something that is no exception of the standard library";
      result_.nodes[i].hint = "this is a bug of the node; please report it";
      settle(i, NodeStatus::failed, "");
    }
  }

  void resolve(std::size_t i) {
    const DagNode& node = dag_.nodes[i];
    State& state = *states_[i];
    if (stopping()) return settle(i, NodeStatus::cancelled, "the run was cancelled");
    if (stop_starting_) return;  // stays pending, becomes skipped

    if (!state.key) {
      state.key = key_of(node);
      result_.nodes[i].manifest = state.key->manifest;
      std::optional<std::size_t> done;
      {
        const std::lock_guard lock(mutex_);
        const auto [flight, first] = flights_.try_emplace(state.key->key, Flight{i, {}});
        if (!first) {
          const std::size_t leader = flight->second.leader;
          const NodeStatus status = result_.nodes[leader].status;
          if (status == NodeStatus::pending) {
            flight->second.followers.push_back(i);  // single-flight: one computation, two nodes
            return;
          }
          if (status == NodeStatus::run || status == NodeStatus::hit) done = leader;
        }
      }
      if (done) return follow(i, *done);
    }
    if (const auto entry = entry_of(i)) return adopt(i, *entry, "same inputs and parameters");

    if (!admit(i)) return;  // dispatched again when memory is free
    emit({Event::Kind::node_started, i, 0, false, {}, nullptr});
    std::optional<ActionEntry> meanwhile;
    NodeStatus status = NodeStatus::cancelled;
    try {
      // Another process may be computing the same key; then its result becomes a hit here.
      const auto lock = store_->lock(state.key->key, [this] { return stopping(); });
      meanwhile = entry_of(i);
      if (!meanwhile && !stopping()) status = compute(i);
    } catch (...) {
      dismiss(i);
      throw;
    }
    dismiss(i);
    if (meanwhile) return adopt(i, *meanwhile, "computed meanwhile by another run");
    settle(i, status, why(i));
  }

  /// From this run, else from the store.
  std::optional<ActionEntry> entry_of(std::size_t i) {
    const Digest& key = states_[i]->key->key;
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = replaced_.find(key); found != replaced_.end()) return found->second;
    }
    return find_entry(*store_, *dag_.nodes[i].decl, key);
  }

  ActionKey key_of(const DagNode& node) {
    std::map<std::string, OutputEntry> inputs;
    for (const auto& [port, edge] : node.inputs)
      inputs[port] = *find_output(result_.nodes[edge.node].outputs, edge.port);
    return action_key(node, inputs, options_.seed, *store_);
  }

  /// The key was made from the content of files before the node read them. What was computed from a file that
  /// changed in between must not be found under the key of the former content.
  void check_files(std::size_t i) {
    const DagNode& node = dag_.nodes[i];
    const std::optional<std::string> file = file_read_by(node);
    if (!file || key_of(node).key == states_[i]->key->key) return;
    throw Error(ExitCode::node_failed, *file + " changed while the run was reading it",
                "wait until its writer is done, then run again");
  }

  /// Takes the estimate of the node's memory from the budget; false: put aside until a node has ended.
  bool admit(std::size_t i) {
    const std::uint64_t estimate = memory_estimate(i);
    const std::lock_guard lock(mutex_);
    if (running_ > 0 && memory_used_ + estimate > options_.memory_bytes) {
      deferred_.push_back(i);
      return false;
    }
    ++running_;
    memory_used_ += estimate;
    return true;
  }

  void dismiss(std::size_t i) {
    std::vector<std::size_t> again;
    {
      const std::lock_guard lock(mutex_);
      --running_;
      memory_used_ -= memory_estimate(i);
      again.swap(deferred_);
    }
    for (const std::size_t other : again) dispatch(other);
  }

  std::uint64_t memory_estimate(std::size_t i) const {
    const NodeDeclaration& decl = *dag_.nodes[i].decl;
    std::uint64_t bytes = 0;
    for (const auto& [port, edge] : dag_.nodes[i].inputs) {
      if (const OutputEntry* entry = find_output(result_.nodes[edge.node].outputs, edge.port))
        bytes += entry->bytes;
    }
    return decl.memory_fixed +
           static_cast<std::uint64_t>(decl.memory_per_input_byte * static_cast<double>(bytes));
  }

  void adopt(std::size_t i, const ActionEntry& entry, const std::string& reason) {
    NodeResult& result = result_.nodes[i];
    result.outputs = entry.outputs;
    result.warnings = entry.warnings;
    const NodeResult* previous = before_ != nullptr && i < before_->size() ? &(*before_)[i] : nullptr;
    if (previous != nullptr && previous->status == NodeStatus::run && previous->manifest == result.manifest) {
      result.seconds = previous->seconds;  // it ran in an earlier round of this run
      result.cpu_seconds = previous->cpu_seconds;
      result.warnings = previous->warnings;
      result.iterations = previous->iterations;
      return settle(i, NodeStatus::run, previous->reason);
    }
    for (const std::string& warning : entry.warnings)
      emit({Event::Kind::node_message, i, 0, true, warning, nullptr});
    settle(i, NodeStatus::hit, reason);
  }

  /// Runs the node with inputs from memory or from the store; leaves everything but the status in the result.
  NodeStatus compute(std::size_t i) {
    State& state = *states_[i];
    NodeResult& result = result_.nodes[i];
    const NodeRunOutcome outcome = execute(i);
    result.seconds = outcome.seconds;
    result.cpu_seconds = outcome.cpu_seconds;
    result.warnings = outcome.warnings;
    result.iterations = outcome.iterations;
    if (outcome.status != NodeRunOutcome::Status::ok) {
      result.cause = outcome.cause;
      result.hint = outcome.hint;
      return outcome.status == NodeRunOutcome::Status::failed ? NodeStatus::failed : NodeStatus::cancelled;
    }
    check_files(i);
    result.outputs = publish(i, outcome);
    const std::lock_guard lock(state.mutex);
    state.held = outcome.outputs;
    return NodeStatus::run;
  }

  NodeRunOutcome execute(std::size_t i) {
    const DagNode& node = dag_.nodes[i];
    NodeRunRequest request;
    request.node = &node;
    request.registry = &registry_;
    request.threads = options_.threads;
    request.seed = options_.seed;
    for (const auto& [port, edge] : node.inputs) request.inputs[port] = ensure(edge);
    request.cancelled = [this] { return stopping(); };
    request.progress = [this, i](double fraction) { progress(i, fraction); };
    request.message = [this, i](bool warning, const std::string& text) {
      emit({Event::Kind::node_message, i, 0, warning, text, nullptr});
    };
    NodeRunOutcome outcome = node.loop ? run_loop(request) : run_node(request);
    request.inputs.clear();
    for (const auto& [port, edge] :
         node.inputs) {  // made again for this node alone: nobody else will free them
      bool last = false;
      {
        const std::lock_guard lock(mutex_);
        last = states_[edge.node]->consumers_left == 0;
      }
      if (last) forget(edge.node);
    }
    return outcome;
  }

  void progress(std::size_t i, double fraction) {
    using namespace std::chrono;
    const std::int64_t now = duration_cast<milliseconds>(Clock::now().time_since_epoch()).count();
    std::int64_t last = states_[i]->last_progress.load(std::memory_order_relaxed);
    if (now - last < 50 || !states_[i]->last_progress.compare_exchange_strong(last, now)) return;
    const double shown = std::isnan(fraction) ? 0 : std::clamp(fraction, 0.0, 1.0);
    emit({Event::Kind::node_progress, i, shown, false, {}, nullptr});
  }

  /// Stores the artifacts of a finished node and then its entry.
  std::vector<OutputEntry> publish(std::size_t i, const NodeRunOutcome& outcome) {
    ActionEntry entry;
    entry.manifest = states_[i]->key->manifest;
    entry.warnings = outcome.warnings;
    entry.seconds = outcome.seconds;
    entry.cpu_seconds = outcome.cpu_seconds;
    for (const auto& [port, artifact] : outcome.outputs) {
      entry.outputs.push_back({port, artifact->type(), artifact->version(), artifact->digest(),
                               artifact->file_size(), artifact->checksum(), artifact->summary()});
      if (worth_storing(artifact->file_size(), outcome.seconds)) {
        store_->put_blob(*artifact, outcome.seconds > sync_seconds);
      }
    }
    store_->put_action(states_[i]->key->key, entry, outcome.seconds > sync_seconds);
    return entry.outputs;
  }

  std::string why(std::size_t i) const {
    const auto before = earlier_.find(dag_.nodes[i].path);
    if (before == earlier_.end()) return "never ran here";
    std::string text;
    for (const std::string& difference : manifest_differences(before->second, states_[i]->key->manifest)) {
      text += (text.empty() ? "" : "; ") + difference;
    }
    return text.empty() ? "its entry is no longer in the cache" : text;
  }

  /// The artifact of a resolved node: held in memory, read from the store, or made again.
  ArtifactPtr ensure(const EdgeRef& edge) {
    State& state = *states_[edge.node];
    const std::lock_guard lock(state.mutex);
    if (const auto held = state.held.find(edge.port); held != state.held.end()) return held->second;
    NodeResult& result = result_.nodes[edge.node];
    const OutputEntry* entry = find_output(result.outputs, edge.port);
    if (entry == nullptr) {
      throw Error(ExitCode::node_failed, dag_.nodes[edge.node].path + " has no output \"" + edge.port + "\"");
    }
    if (ArtifactPtr artifact = store_->load(*entry)) return state.held[edge.port] = artifact;

    emit({Event::Kind::node_started, edge.node, 0, false, {}, nullptr});
    const NodeRunOutcome outcome = execute(edge.node);
    if (outcome.status == NodeRunOutcome::Status::cancelled) throw Stopped();
    if (outcome.status != NodeRunOutcome::Status::ok) {
      throw Error(ExitCode::node_failed,
                  dag_.nodes[edge.node].path + " had to be run again and failed: " + outcome.cause,
                  outcome.hint);
    }
    check_files(edge.node);
    const bool equal = std::all_of(result.outputs.begin(), result.outputs.end(), [&](const OutputEntry& o) {
      const auto made = outcome.outputs.find(o.port);
      return made != outcome.outputs.end() && made->second->digest() == o.digest;
    });
    if (!equal) {
      emit({Event::Kind::node_message, edge.node, 0, true,
            "not deterministic: equal inputs and parameters gave another result; what depends on it is "
            "computed anew",
            nullptr});
    }
    const std::vector<OutputEntry> outputs = publish(edge.node, outcome);
    if (!equal) {
      // Kept here too: the store may be read-only.
      const std::lock_guard run_lock(mutex_);
      replaced_[state.key->key] = {state.key->manifest, outputs, outcome.warnings, outcome.seconds,
                                   outcome.cpu_seconds};
      throw PlanIsVoid();
    }
    {
      const std::lock_guard run_lock(mutex_);
      result.status = NodeStatus::run;
      result.reason = "its artifact was needed and not stored";
      result.seconds += outcome.seconds;
      result.cpu_seconds += outcome.cpu_seconds;
      result.iterations = outcome.iterations;
    }
    state.held = outcome.outputs;
    emit({Event::Kind::node_finished, edge.node, 1, false, {}, &result});
    return state.held.at(edge.port);
  }

  /// The node has its final status: tells followers and consumers, frees what nobody needs any more.
  void settle(std::size_t i, NodeStatus status, const std::string& reason) {
    {
      const std::lock_guard lock(mutex_);
      result_.nodes[i].status = status;
      result_.nodes[i].reason = reason;
      if (status == NodeStatus::failed) stop_starting_ = true;
    }
    // Before any consumer can start: one that needs the artifact again writes to the result.
    emit({Event::Kind::node_finished, i, 1, false, {}, &result_.nodes[i]});

    std::vector<std::size_t> followers, ready, done_with;
    const bool good = status == NodeStatus::hit || status == NodeStatus::run;
    {
      const std::lock_guard lock(mutex_);
      if (states_[i]->key) {
        const auto flight = flights_.find(states_[i]->key->key);
        if (flight != flights_.end() && flight->second.leader == i) followers.swap(flight->second.followers);
      }
      for (const std::size_t consumer : states_[i]->consumers) {
        if (good && --states_[consumer]->inputs_missing == 0) ready.push_back(consumer);
      }
      for (const std::size_t producer : producers_of(i)) {
        if (--states_[producer]->consumers_left == 0) done_with.push_back(producer);
      }
    }
    for (const std::size_t follower : followers) {
      if (good) {
        follow(follower, i);
        continue;
      }
      result_.nodes[follower].cause = result_.nodes[i].cause;
      result_.nodes[follower].hint = result_.nodes[i].hint;
      settle(follower, status, reason);
    }
    if (states_[i]->consumers.empty()) done_with.push_back(i);
    for (const std::size_t node : done_with) forget(node);
    for (const std::size_t consumer : ready) {
      if (!stopping() && !stop_starting_.load()) dispatch(consumer);
    }
  }

  /// Gives a node what another one with the same key has computed or found in this round.
  void follow(std::size_t i, std::size_t leader) {
    result_.nodes[i].outputs = result_.nodes[leader].outputs;
    result_.nodes[i].warnings = result_.nodes[leader].warnings;
    {
      const std::scoped_lock lock(states_[leader]->mutex, states_[i]->mutex);
      states_[i]->held = states_[leader]->held;
    }
    settle(i, NodeStatus::hit, "same computation as " + dag_.nodes[leader].path);
  }

  /// The nodes that `i` reads from, each once.
  std::vector<std::size_t> producers_of(std::size_t i) const {
    std::vector<std::size_t> producers;
    for (const auto& [port, edge] : dag_.nodes[i].inputs) producers.push_back(edge.node);
    std::sort(producers.begin(), producers.end());
    producers.erase(std::unique(producers.begin(), producers.end()), producers.end());
    return producers;
  }

  /// Drops artifacts whose last consumer is done, unless they are outputs of the graph that only memory has.
  void forget(std::size_t i) {
    State& state = *states_[i];
    const std::lock_guard lock(state.mutex);
    for (auto held = state.held.begin(); held != state.held.end();) {
      const bool wanted = wanted_.count({i, held->first}) != 0;
      const OutputEntry* entry = find_output(result_.nodes[i].outputs, held->first);
      if (wanted && (entry == nullptr || !store_->has_blob(*entry))) {
        ++held;
      } else {
        held = state.held.erase(held);
      }
    }
  }

  const Dag& dag_;
  const Registry& registry_;
  std::shared_ptr<Store> store_;
  std::unique_ptr<Lease> lease_;  // what this run uses is not collected while it lives
  RunOptions options_;
  EventSink& events_;
  Manifests earlier_;
  RunResult result_;
  std::set<std::pair<std::size_t, std::string>> wanted_;  // outputs of the graph
  const std::vector<NodeResult>* before_ = nullptr;       // of the round before, while a round is on
  std::vector<std::unique_ptr<State>> states_;
  tbb::task_group* group_ = nullptr;
  std::mutex mutex_, events_mutex_;
  std::map<Digest, Flight> flights_;
  std::vector<std::size_t> deferred_;
  std::map<Digest, ActionEntry> replaced_;  // of nodes that turned out not to be deterministic
  std::uint64_t memory_used_ = 0;           // estimates of the running nodes
  std::size_t running_ = 0;
  // stop_: nobody wants results any more; stop_starting_: what runs may end, nothing new begins
  std::atomic<bool> stop_{false}, stop_starting_{false}, void_{false};
};

Runner::Runner(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
               EventSink& events, Manifests earlier)
    : impl_(std::make_unique<Impl>(dag, registry, std::move(store), options, events, std::move(earlier))) {}
Runner::~Runner() = default;
const RunResult& Runner::run() { return impl_->run(); }
ArtifactPtr Runner::artifact(const EdgeRef& output) { return impl_->artifact(output); }

}  // namespace ballflow
