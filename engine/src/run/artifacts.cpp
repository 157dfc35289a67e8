#include <oneapi/tbb/global_control.h>

#include <algorithm>

#include "run/runner.hpp"

namespace ballflow {

ArtifactPtr Runner::Impl::artifact(const EdgeRef& output) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options_.threads);
  try {
    return ensure(output, output.node);
  } catch (const PlanIsVoid&) {
    throw Error(ExitCode::node_failed,
                dag_.nodes[output.node].path + " gave another result when it was run again",
                "the node is not deterministic; run the command again to compute what depends on it anew");
  } catch (const Stopped&) {
    throw Error(ExitCode::cancelled,
                "cancelled while " + dag_.nodes[output.node].path + " was run again for its output");
  }
}

/// Whether the artifact is in memory or in the store, or soon will be.
bool Runner::Impl::is_at_hand(const EdgeRef& edge, const OutputEntry& entry) {
  {
    const std::unique_lock lock(states_[edge.node]->mutex, std::try_to_lock);
    if (!lock.owns_lock()) return true;  // another reader is just making it again
    if (states_[edge.node]->held.count(edge.port) != 0) return true;
  }
  return store_->has_blob(entry);
}

ArtifactPtr Runner::Impl::load(const EdgeRef& edge, const OutputEntry& entry, std::size_t reader) {
  const auto start = Clock::now();
  ArtifactPtr artifact = store_->load(entry);
  if (artifact == nullptr) return nullptr;
  const TypeDeclaration* type = registry_.type(entry.type);
  if (const std::string wrong = type == nullptr ? std::string() : check_arrays(*type, *artifact);
      !wrong.empty()) {
    // Valid once, or written by somebody else: like every failure of a lookup it is a miss.
    message(edge.node, true, "the cached artifact of " + edge.port + " " + wrong + "; it is made again");
    return nullptr;
  }
  Event event{Event::Kind::cache_read, reader};
  event.text = dag_.nodes[edge.node].path + "." + edge.port;
  event.bytes = entry.bytes;
  event.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  emit(std::move(event));
  return artifact;
}

/// Keeps what a node made until its last consumer has ended; the caller has locked the state.
void Runner::Impl::keep(State& state, const std::map<std::string, ArtifactPtr>& artifacts) {
  for (const auto& [port, artifact] : artifacts) budget_->hold(artifact);
  for (const auto& [port, artifact] : state.held) budget_->let_go(artifact);
  state.held = artifacts;
}

namespace {

constexpr const char* disagreement = "not deterministic: equal inputs and parameters gave another result";

}  // namespace

/// Equal inputs and parameters gave another result than before.
void Runner::Impl::disagree(std::size_t i) {
  if (!options_.strict) return tell_disagreement(i);
  {
    const std::lock_guard lock(mutex_);
    nondeterministic_.insert(i);
  }
  throw Error(
      ExitCode::node_failed, dag_.nodes[i].path + " is " + disagreement + " than the one in the cache",
      "see what differs with --check-determinism; without --strict the new result replaces the old one");
}

/// Once.
void Runner::Impl::tell_disagreement(std::size_t i) {
  {
    const std::lock_guard lock(mutex_);
    if (!nondeterministic_.insert(i).second) return;
  }
  std::string text(disagreement);  // in two steps: a false alarm of g++ 12 about operator+
  text += "; what depends on it is computed anew";
  message(i, true, text);
}

/// The artifact of a resolved node: held in memory, read from the store, or made again for `reader`.
ArtifactPtr Runner::Impl::ensure(const EdgeRef& edge, std::size_t reader) {
  if (const Given* given = dag_.nodes[edge.node].kind.given()) return given->artifact;
  State& state = *states_[edge.node];
  const std::lock_guard lock(state.mutex);
  if (const auto held = state.held.find(edge.port); held != state.held.end()) return held->second;
  NodeResult& result = result_.nodes[edge.node];
  const std::string& path = dag_.nodes[edge.node].path;
  const OutputEntry* entry = find_output(result.outputs, edge.port);
  if (entry == nullptr) {
    throw Error(ExitCode::node_failed, path + " has no output \"" + edge.port + "\"");
  }
  if (ArtifactPtr artifact = load(edge, *entry, reader)) return state.held[edge.port] = artifact;
  if (!may_run(edge.node)) {
    throw Error(ExitCode::node_failed, "needs " + path + "." + edge.port + ", which is not in the cache",
                "run it with what it needs: --until " + dag_.nodes[reader].path);
  }

  emit({Event::Kind::node_started, edge.node});
  const ExecutionOutcome outcome = execute(edge.node, options_.threads);
  if (outcome.status == ExecutionOutcome::Status::cancelled) throw Stopped();
  if (outcome.status != ExecutionOutcome::Status::ok) {
    throw Error(ExitCode::node_failed, path + " had to be run again and failed: " + outcome.cause,
                outcome.hint);
  }
  check_files(edge.node);
  const bool equal = same_digests(result.outputs, outcome);
  if (!equal) disagree(edge.node);
  const std::vector<OutputEntry> outputs = publish(edge.node, outcome);
  if (!equal) {
    // Kept here too: the store may be read-only.
    const std::lock_guard run_lock(mutex_);
    replaced_[*state.key] = {result.manifest, outputs, outcome.warnings, outcome.seconds,
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
  keep(state, outcome.outputs);
  Event event{Event::Kind::node_finished, edge.node};
  event.result = &result;
  emit(std::move(event));
  return state.held.at(edge.port);
}

/// Drops artifacts whose last consumer is done, unless they are outputs of the graph that only memory has.
void Runner::Impl::forget(std::size_t i) {
  if (options_.check_determinism) return;  // every node runs again afterwards
  State& state = *states_[i];
  const std::lock_guard lock(state.mutex);
  for (auto held = state.held.begin(); held != state.held.end();) {
    const bool wanted = wanted_.count({i, held->first}) != 0;
    const OutputEntry* entry = find_output(result_.nodes[i].outputs, held->first);
    if (wanted && (entry == nullptr || !store_->has_blob(*entry))) {
      ++held;
    } else {
      budget_->let_go(held->second);
      held = state.held.erase(held);
    }
  }
}

}  // namespace ballflow
