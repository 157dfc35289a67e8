#include "run/runner.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/process_usage.hpp"
#include "base/usable.hpp"

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

std::string_view to_string(Event::Kind kind) {
  switch (kind) {
    case Event::Kind::run_started:
      return "run_started";
    case Event::Kind::node_waiting:
      return "node_waiting";
    case Event::Kind::node_started:
      return "node_started";
    case Event::Kind::node_progress:
      return "node_progress";
    case Event::Kind::node_message:
      return "node_message";
    case Event::Kind::cache_read:
      return "cache_read";
    case Event::Kind::cache_write:
      return "cache_write";
    case Event::Kind::node_finished:
      return "node_finished";
    case Event::Kind::run_finished:
      return "run_finished";
  }
  return "";
}

Runner::Impl::Impl(const Dag& dag, const Registry& registry, std::shared_ptr<Store> store, RunOptions options,
                   EventSink& events, Manifests earlier)
    : dag_(dag),
      registry_(registry),
      store_(std::move(store)),
      lease_(Lease::take(store_)),
      options_(std::move(options)),
      executor_(options_.executor ? options_.executor : in_process_executor()),
      events_(events),
      earlier_(std::move(earlier)),
      force_(options_.force) {
  if (options_.threads == 0) options_.threads = usable_processors();
  if (options_.memory_bytes == 0) options_.memory_bytes = usable_memory_bytes() / 10 * 8;
  budget_ = std::make_unique<MemoryBudget>(options_.memory_bytes);
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
    // The calling thread counts, and only waits (see run_once).
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options_.threads + (options_.threads > 1 ? 1 : 0));
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
  event.memory = budget_->used();
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

/// Nodes with the same type, parameters and inputs, found before anything has run: a subgraph that is there
/// twice. One of them computes; what it made stays in memory until the others have settled and taken it over,
/// or else they would compute it again where no store has it. Twins are ready at the same time, so that is
/// soon.
void Runner::Impl::find_twins() {
  std::map<std::string, std::size_t> first;  // of each kind of computation, its first node
  std::vector<std::size_t> same_as(dag_.nodes.size());
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    same_as[i] = i;
    const DagNode& node = dag_.nodes[i];
    if (node.kind.declared() == nullptr) continue;  // loops and artifacts: each is its own
    Json computation = {{"type", node.kind.type()},
                        {"version", node.kind.version()},
                        {"params", node.params},
                        {"inputs", Json::object()}};
    for (const auto& [port, edge] : node.inputs)
      computation["inputs"][port] = {same_as[edge.node], edge.port};
    same_as[i] = first.emplace(computation.dump(), i).first->second;
  }
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    if (needed_[i]) groups[same_as[i]].push_back(i);
  }
  for (const auto& [node, group] : groups) {
    for (const std::size_t i : group) {
      for (const std::size_t twin : group) {
        if (twin == i) continue;
        states_[i]->twins.push_back(twin);
        ++states_[i]->consumers_left;
      }
    }
  }
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
  budget_ = std::make_unique<MemoryBudget>(options_.memory_bytes);
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
  find_twins();

  const bool several = options_.threads > 1;
  tbb::task_arena arena(static_cast<int>(options_.threads), several ? 0 : 1);
  KeyWaits key_waits(*store_, several, [this] { return stopping() || stop_starting_; });
  arena_ = &arena;
  key_waits_ = &key_waits;
  if (several) {
    // All work is done by threads of the scheduler, and this one waits outside the arena: a thread that waits
    // in it cannot help a node that runs in an arena of its own, which would then have one thread less.
    tbb::task_group group;
    group_ = &group;
    tasks_ += ready.size();
    for (const std::size_t i : ready) arena.enqueue(group.defer([this, i] { process(i); }));
    group.wait();
  } else {
    arena.execute([&] {
      tbb::task_group group;
      group_ = &group;
      for (const std::size_t i : ready) dispatch(i);
      do {
        group.wait();
      } while (key_waits.wait());
    });
  }
  group_ = nullptr;
  arena_ = nullptr;
  key_waits_ = nullptr;
  before_ = nullptr;
  if (void_ && !cancelled()) return false;
  name_what_did_not_run();
  return true;
}

/// Gives every node that is still pending its status and the reason.
void Runner::Impl::name_what_did_not_run() {
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
