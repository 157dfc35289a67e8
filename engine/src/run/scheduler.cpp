#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "base/process_usage.hpp"
#include "run/runner.hpp"

namespace ballflow {

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

const OutputEntry* find_output(const std::vector<OutputEntry>& outputs, const std::string& port) {
  for (const OutputEntry& output : outputs) {
    if (output.port == port) return &output;
  }
  return nullptr;
}

Runner::Impl::Impl(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
                   EventSink& events, Manifests earlier)
    : dag_(dag),
      registry_(registry),
      store_(std::move(store)),
      lease_(Lease::take(store_)),
      options_(std::move(options)),
      events_(events),
      earlier_(std::move(earlier)),
      force_(options_.force) {
  if (options_.threads == 0) options_.threads = std::max(1u, std::thread::hardware_concurrency());
  if (options_.memory_bytes == 0) options_.memory_bytes = physical_memory_bytes() / 10 * 8;
  result_.nodes.resize(dag.nodes.size());
  for (const DagOutput& output : dag.outputs) wanted_.emplace(output.from.node, output.from.port);
  const std::set<std::size_t>& targets = options_.only.empty() ? options_.until : options_.only;
  needed_ = targets.empty() ? needed_nodes(dag) : needed_nodes(dag, targets);
}

namespace {

/// Makes what arenas of the process have in common and keeps it. oneTBB 2021 reads the limit of threads
/// without a lock when it makes that, so two first runs at once, each with a limit of its own, would race.
void keep_scheduler() {
  struct Kept {
    tbb::task_arena arena{1};
    Kept() { arena.initialize(); }
  };
  static Kept kept;
}

}  // namespace

const RunResult& Runner::Impl::run() {
  start_ = Clock::now();
  const double cpu = process_cpu_seconds();
  emit({Event::Kind::run_started});
  keep_scheduler();
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options_.threads);
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
  }
  for (const std::size_t i : nondeterministic_) result_.nodes[i].deterministic = false;
  if (options_.check_determinism) check_determinism();
  result_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  result_.cpu_seconds = process_cpu_seconds() - cpu;
  result_.peak_rss_bytes = peak_rss_bytes();
  result_.status = ExitCode::ok;
  const auto any = [this](NodeStatus status) {
    return std::any_of(result_.nodes.begin(), result_.nodes.end(),
                       [status](const NodeResult& node) { return node.status == status; });
  };
  if (cancelled() && any(NodeStatus::cancelled)) result_.status = ExitCode::cancelled;
  if (any(NodeStatus::failed)) result_.status = ExitCode::node_failed;
  emit({Event::Kind::run_finished});
  return result_;
}

bool Runner::Impl::cancelled() const {
  return options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed);
}

bool Runner::Impl::stopping() const { return cancelled() || stop_.load(std::memory_order_relaxed); }

/// What goes wrong while events are shown must not cost the results.
void Runner::Impl::emit(Event event) noexcept {
  event.memory = memory_used_.load(std::memory_order_relaxed);
  const std::lock_guard lock(events_mutex_);
  event.time = std::chrono::duration<double>(Clock::now() - start_).count();  // inside: times never go back
  try {
    events_.on(event);
  } catch (...) {
  }
}

void Runner::Impl::message(std::size_t i, bool warning, const std::string& text) {
  Event event{Event::Kind::node_message, i};
  event.warning = warning;
  event.text = text;
  emit(std::move(event));
}

/// False when the plan became void and everything has to be looked at again.
bool Runner::Impl::run_once() {
  const std::vector<NodeResult> before = std::move(result_.nodes);
  result_.nodes.assign(dag_.nodes.size(), {});
  before_ = &before;
  states_.clear();
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) states_.push_back(std::make_unique<State>());
  flights_.clear();
  flights_.reserve(dag_.nodes.size());
  deferred_.clear();
  memory_used_ = 0;
  running_ = 0;
  stop_ = false;
  stop_starting_ = false;
  void_ = false;

  const bool narrowed = !options_.only.empty() || !options_.until.empty();
  std::vector<std::size_t> ready;
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    if (!needed_[i]) {
      result_.nodes[i].status = NodeStatus::skipped;
      result_.nodes[i].reason = narrowed ? "was not asked for" : "no output of the graph needs it";
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
  name_what_did_not_run();
  return true;
}

/// Gives every node that is still pending its status and the reason.
void Runner::Impl::name_what_did_not_run() {
  constexpr std::size_t nobody = static_cast<std::size_t>(-1);
  std::vector<std::size_t> blame(dag_.nodes.size(), nobody);  // the node that kept this one from running
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    NodeResult& node = result_.nodes[i];
    if (!needed_[i]) continue;
    if (node.status == NodeStatus::failed || node.status == NodeStatus::skipped) blame[i] = i;
    if (node.status != NodeStatus::pending) continue;
    for (const std::size_t producer : producers_of(i)) {
      if (blame[i] == nobody) blame[i] = blame[producer];
    }
    const std::string& path = blame[i] == nobody ? dag_.nodes[i].path : dag_.nodes[blame[i]].path;
    if (cancelled()) {
      node.status = NodeStatus::cancelled;
      node.reason = "the run was cancelled";
    } else if (blame[i] == nobody) {
      node.status = NodeStatus::skipped;
      node.reason = "another node failed first";
    } else if (result_.nodes[blame[i]].status == NodeStatus::failed) {
      node.status = NodeStatus::skipped;
      node.reason = "needs " + path + ", which failed";
    } else if (may_run(i)) {
      node.status = NodeStatus::failed;
      node.cause = "needs " + path + ", whose result is not in the cache";
      node.hint = "run it with what it needs: --until " + dag_.nodes[i].path;
    } else {
      node.status = NodeStatus::skipped;
      node.reason = "needs " + path + ", whose result is not in the cache";
    }
    Event event{Event::Kind::node_finished, i};
    event.result = &node;
    emit(std::move(event));
  }
}

void Runner::Impl::dispatch(std::size_t i) {
  group_->run([this, i] { process(i); });
}

/// Everything that can go wrong with one node ends here, as its result.
void Runner::Impl::process(std::size_t i) {
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

void Runner::Impl::resolve(std::size_t i) {
  const DagNode& node = dag_.nodes[i];
  State& state = *states_[i];
  if (stopping()) return settle(i, NodeStatus::cancelled, "the run was cancelled");
  if (stop_starting_) return;  // stays pending, becomes skipped
  if (node.given) {
    result_.nodes[i].outputs = {output_entry(node.decl->outputs[0].name, *node.given->artifact)};
    return settle(i, NodeStatus::hit, "given");
  }

  const bool forced = options_.force.count(i) != 0 && take_force(i);
  if (!state.key) {
    ActionKey made = key_of(node);
    state.key = made.key;
    result_.nodes[i].manifest = std::move(made.manifest);
    std::optional<std::size_t> done;
    if (!forced) {
      const std::lock_guard lock(mutex_);
      const auto [flight, first] = flights_.try_emplace(*state.key, Flight{i, {}});
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
  if (!forced) {
    if (const auto entry = entry_of(i)) return adopt(i, *entry, "same inputs and parameters");
    if (!may_run(i)) return settle(i, NodeStatus::skipped, "not in the cache, and only others may run");
  }

  if (!admit(i)) {  // dispatched again when memory is free
    if (forced) {
      const std::lock_guard lock(mutex_);
      force_.insert(i);
    }
    return;
  }
  emit({Event::Kind::node_started, i});
  std::optional<ActionEntry> meanwhile;
  NodeStatus status = NodeStatus::cancelled;
  try {
    // Another process may be computing the same key; then its result becomes a hit here.
    bool told = false;
    const auto lock = store_->lock(*state.key, [&] {
      if (!told) {
        Event event{Event::Kind::node_waiting, i};
        event.text = "another process computes the same";
        emit(std::move(event));
        told = true;
      }
      return stopping();
    });
    if (!forced) meanwhile = entry_of(i);
    if (!meanwhile && !stopping()) status = compute(i);
  } catch (...) {
    dismiss(i);
    throw;
  }
  dismiss(i);
  if (meanwhile) return adopt(i, *meanwhile, "computed meanwhile by another run");
  settle(i, status, forced ? "forced" : why(i));
}

/// Whether the node has still to be computed in spite of its entry: once, also when the plan becomes void.
bool Runner::Impl::take_force(std::size_t i) {
  const std::lock_guard lock(mutex_);
  return force_.erase(i) != 0;
}

/// From this run, else from the store.
std::optional<ActionEntry> Runner::Impl::entry_of(std::size_t i) {
  const Digest& key = *states_[i]->key;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = replaced_.find(key); found != replaced_.end()) return found->second;
  }
  return find_entry(*store_, *dag_.nodes[i].decl, key);
}

ActionKey Runner::Impl::key_of(const DagNode& node) {
  std::map<std::string, OutputEntry> inputs;
  for (const auto& [port, edge] : node.inputs)
    inputs[port] = *find_output(result_.nodes[edge.node].outputs, edge.port);
  return action_key(node, inputs, options_.seed, *store_);
}

/// Takes the estimate of the node's memory from the budget; false: put aside until a node has ended.
bool Runner::Impl::admit(std::size_t i) {
  const std::uint64_t estimate = memory_estimate(i);
  bool tell = false;
  {
    const std::lock_guard lock(mutex_);
    if (running_ == 0 || memory_used_ + estimate <= options_.memory_bytes) {
      ++running_;
      memory_used_ += estimate;
      states_[i]->admitted = estimate;
      return true;
    }
    tell = !std::exchange(states_[i]->waited, true);
    deferred_.push_back(i);
  }
  if (tell) {
    Event event{Event::Kind::node_waiting, i};
    event.text = "memory";
    emit(std::move(event));
  }
  return false;
}

void Runner::Impl::dismiss(std::size_t i) {
  std::vector<std::size_t> again;
  {
    const std::lock_guard lock(mutex_);
    --running_;
    memory_used_ -= states_[i]->admitted;
    again.swap(deferred_);
  }
  for (const std::size_t other : again) dispatch(other);
}

/// Of the node, or of one that has to be run again before it for a lost artifact, whichever is more: they run
/// one after the other.
std::uint64_t Runner::Impl::memory_estimate(std::size_t i) {
  std::uint64_t most = 0;
  std::set<std::size_t> seen;
  std::vector<std::size_t> left{i};
  while (!left.empty()) {
    const DagNode& node = dag_.nodes[left.back()];
    left.pop_back();
    std::uint64_t bytes = 0;
    for (const auto& [port, edge] : node.inputs) {
      const OutputEntry* entry = find_output(result_.nodes[edge.node].outputs, edge.port);
      if (entry == nullptr) continue;
      bytes += entry->bytes;
      if (!is_at_hand(edge, *entry) && seen.insert(edge.node).second) left.push_back(edge.node);
    }
    const double scaled = node.decl->memory_per_input_byte * static_cast<double>(bytes);
    most = std::max(most, node.decl->memory_fixed + static_cast<std::uint64_t>(scaled));
  }
  return most;
}

/// Whether the artifact is in memory or in the store.
bool Runner::Impl::is_at_hand(const EdgeRef& edge, const OutputEntry& entry) {
  {
    const std::lock_guard lock(states_[edge.node]->mutex);
    if (states_[edge.node]->held.count(edge.port) != 0) return true;
  }
  return store_->has_blob(entry);
}

void Runner::Impl::adopt(std::size_t i, const ActionEntry& entry, const std::string& reason) {
  NodeResult& result = result_.nodes[i];
  result.outputs = entry.outputs;
  result.warnings = entry.warnings;
  result.cost_seconds = entry.seconds;
  const NodeResult* previous = before_ != nullptr && i < before_->size() ? &(*before_)[i] : nullptr;
  if (previous != nullptr && previous->status == NodeStatus::run && previous->manifest == result.manifest) {
    result.seconds = previous->seconds;  // it ran in an earlier round of this run
    result.cpu_seconds = previous->cpu_seconds;
    result.warnings = previous->warnings;
    result.iterations = previous->iterations;
    return settle(i, NodeStatus::run, previous->reason);
  }
  for (const std::string& warning : entry.warnings) message(i, true, warning);
  settle(i, NodeStatus::hit, reason);
}

std::string Runner::Impl::why(std::size_t i) const {
  const auto before = earlier_.find(dag_.nodes[i].path);
  if (before == earlier_.end()) return "never ran here";
  std::string text;
  for (const std::string& difference : manifest_differences(before->second, result_.nodes[i].manifest)) {
    text += (text.empty() ? "" : "; ") + difference;
  }
  return text.empty() ? "its entry is no longer in the cache" : text;
}

/// The node has its final status: tells followers and consumers, frees what nobody needs any more.
void Runner::Impl::settle(std::size_t i, NodeStatus status, const std::string& reason) {
  {
    const std::lock_guard lock(mutex_);
    result_.nodes[i].status = status;
    result_.nodes[i].reason = reason;
    if (status == NodeStatus::failed && !options_.keep_going) stop_starting_ = true;
  }
  // Before any consumer can start: one that needs the artifact again writes to the result.
  Event event{Event::Kind::node_finished, i};
  event.result = &result_.nodes[i];
  emit(std::move(event));

  std::vector<std::size_t> followers, ready, done_with;
  const bool good = status == NodeStatus::hit || status == NodeStatus::run;
  {
    const std::lock_guard lock(mutex_);
    if (states_[i]->key) {
      const auto flight = flights_.find(*states_[i]->key);
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
void Runner::Impl::follow(std::size_t i, std::size_t leader) {
  result_.nodes[i].outputs = result_.nodes[leader].outputs;
  result_.nodes[i].warnings = result_.nodes[leader].warnings;
  result_.nodes[i].cost_seconds = result_.nodes[leader].cost_seconds;
  {
    const std::scoped_lock lock(states_[leader]->mutex, states_[i]->mutex);
    states_[i]->held = states_[leader]->held;
  }
  settle(i, NodeStatus::hit, "same computation as " + dag_.nodes[leader].path);
}

/// The nodes that `i` reads from, each once.
std::vector<std::size_t> Runner::Impl::producers_of(std::size_t i) const {
  std::vector<std::size_t> producers;
  for (const auto& [port, edge] : dag_.nodes[i].inputs) producers.push_back(edge.node);
  std::sort(producers.begin(), producers.end());
  producers.erase(std::unique(producers.begin(), producers.end()), producers.end());
  return producers;
}

Runner::Runner(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
               EventSink& events, Manifests earlier)
    : impl_(std::make_unique<Impl>(dag, registry, std::move(store), std::move(options), events,
                                   std::move(earlier))) {}
Runner::~Runner() = default;
const RunResult& Runner::run() { return impl_->run(); }
ArtifactPtr Runner::artifact(const EdgeRef& output) { return impl_->artifact(output); }

Manifests manifests_of(const Dag& dag, const RunResult& result) {
  Manifests manifests;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (!result.nodes[i].manifest.empty()) manifests[dag.nodes[i].path] = result.nodes[i].manifest;
  }
  return manifests;
}

}  // namespace ballflow
