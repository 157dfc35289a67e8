#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "base/quote.hpp"
#include "run/loop.hpp"
#include "run/loop_states.hpp"
#include "run/runner.hpp"

namespace ballflow {
namespace {

/// What is cheaper to compute again than to write and to read is not stored: a covering matrix of 740 MB
/// takes a second to build. 500 MB/s is what hashing, writing and mapping cost on an ordinary disk; small
/// artifacts are always stored.
bool worth_storing(std::uint64_t bytes, double seconds) {
  constexpr std::uint64_t always = 16u << 20;
  constexpr double bytes_per_second = 500e6;
  return bytes <= always || seconds * bytes_per_second >= static_cast<double>(bytes);
}

/// Bytes that are still written when the run was cancelled meanwhile.
constexpr std::uint64_t worth_waiting_for = 64u << 20;

/// Nodes slower than this are flushed to the disk before they are published.
constexpr double sync_seconds = 1.0;

void require_output(const PortDecl& port, const ExecutionOutcome& outcome) {
  const auto made = outcome.outputs.find(port.name);
  if (made != outcome.outputs.end() && made->second != nullptr && made->second->type() == port.type &&
      made->second->version() == port.type_version)
    return;
  throw Error(ExitCode::plugin,
              "the executor gave no output " + in_quotes(port.name) + " of type " + port.type,
              "this is a bug of the executor; please report it");
}

}  // namespace

/// The key was made from the content of files before the node read them. What was computed from a file that
/// changed in between must not be found under the key of the former content.
void Runner::Impl::check_files(std::size_t i) {
  const DagNode& node = dag_.nodes[i];
  const std::optional<std::string> file = file_read_by(node);
  if (!file || make_key(node).key == states_[i]->key) return;
  const char* const or_others = files_named_by(node).empty() ? "" : ", or a file that it names,";
  throw Error(ExitCode::node_failed, *file + or_others + " changed while the run was reading it",
              "wait until its writer is done, then run again");
}

/// Runs the node with inputs from memory or from the store; leaves everything but the status in the result.
NodeStatus Runner::Impl::execute_and_publish(std::size_t i) {
  State& state = *states_[i];
  NodeResult& result = result_.nodes[i];
  const bool may_be_kept = dag_.nodes[i].kind.loop() != nullptr && store_->is_transport() && !is_forced(i);
  const ExecutionOutcome outcome = may_be_kept ? execute_for_jobs(i) : execute(i, options_.threads);
  result.seconds = result.cost_seconds = outcome.seconds;
  result.cpu_seconds = outcome.cpu_seconds;
  result.warnings = outcome.warnings;
  result.iterations = outcome.iterations;
  if (outcome.status != ExecutionOutcome::Status::ok) {
    result.cause = outcome.cause;
    result.hint = outcome.hint;
    if (outcome.failed_call) {
      result.failed_call = FailedCall{outcome.failed_call->node, {}};
      for (const auto& [port, artifact] : outcome.failed_call->inputs)
        result.failed_call->inputs[port] = output_entry(port, *artifact);
    }
    return outcome.status == ExecutionOutcome::Status::failed ? NodeStatus::failed : NodeStatus::cancelled;
  }
  check_files(i);
  compare_with_earlier(i, outcome);
  result.outputs = publish(i, outcome);
  output_sizes_.add(dag_.nodes[i].kind.type(), input_bytes(i), bytes_of(result.outputs));
  {
    const std::lock_guard lock(mutex_);
    force_.erase(i);
  }
  const std::lock_guard lock(state.mutex);
  keep(state, outcome.outputs);
  return NodeStatus::run;
}

/// Whatever made the node run: where there is a result of its key already, of an equal node of this run or in
/// the store, it must be the same. There is one when the node was forced, when another process was not kept
/// out by a lock, or when the entry does not give what the node declares now.
void Runner::Impl::compare_with_earlier(std::size_t i, const ExecutionOutcome& outcome) {
  const Digest& key = *states_[i]->key;
  std::optional<std::vector<OutputEntry>> earlier;
  {
    const std::lock_guard lock(mutex_);
    const auto replaced = replaced_.find(key);
    const auto flight = flights_.find(key);
    if (replaced != replaced_.end()) {
      earlier = replaced->second.outputs;
    } else if (flight != flights_.end() && flight->second.settled != nobody) {
      earlier = result_.nodes[flight->second.settled].outputs;
    }
  }
  if (!earlier) {
    if (auto entry = store_->peek_action(key)) earlier = std::move(entry->outputs);
  }
  if (!earlier || same_digests(*earlier, outcome)) return;
  if (gives_declared(*earlier, dag_.nodes[i].kind.outputs())) return disagree(i);
  message(i, true,
          "its entry in the cache has other outputs or types than the node declares now, and is replaced: "
          "the author has not raised the behaviour version");
}

/// A loop goes on where a job that was cancelled had come to, and leaves that when this one is. Elsewhere
/// than between jobs it does not: who presses Ctrl-C does not wait for a state to be stored.
ExecutionOutcome Runner::Impl::execute_for_jobs(std::size_t i) {
  LoopStates kept(*store_, *dag_.nodes[i].kind.loop(), *states_[i]->key);
  const auto before =
      kept.latest([&](const std::string& text) { message(i, true, text + "; an earlier one counts"); });
  if (before) message(i, false, "goes on after iteration " + std::to_string(before->state.iterations));
  ExecutionOutcome outcome = execute(i, options_.threads, before ? &before->state : nullptr);
  if (before) {  // what it takes in all
    outcome.seconds += before->seconds;
    outcome.cpu_seconds += before->cpu_seconds;
  }
  const bool further = outcome.reached && (!before || outcome.reached->iterations > before->state.iterations);
  if (outcome.status != ExecutionOutcome::Status::cancelled || !further || !cancelled() || void_)
    return outcome;
  try {
    check_files(i);
    kept.put({*outcome.reached, outcome.seconds, outcome.cpu_seconds});
    message(i, false,
            "stops after iteration " + std::to_string(outcome.reached->iterations) +
                ", where the next job goes on");
  } catch (const Error& error) {
    message(i, true, "the next job begins anew: " + std::string(error.what()));
  }
  return outcome;
}

ExecutionOutcome Runner::Impl::execute(std::size_t i, unsigned threads, const LoopState* resume) {
  const DagNode& node = dag_.nodes[i];
  ExecutionRequest request;
  request.node = &node;
  request.registry = &registry_;
  request.threads = threads;
  request.seed = options_.seed;
  request.memory_bytes = options_.memory_bytes;
  request.resume = resume;
  for (const auto& [port, edge] : node.inputs) request.inputs[port] = ensure(edge, i);
  request.cancelled = [this] { return stopping(); };
  request.progress = [this, i](double fraction) { progress(i, fraction); };
  request.message = [this, i](bool warning, const std::string& text) { message(i, warning, text); };
  ExecutionOutcome outcome = executor_->execute(request);
  if (outcome.status == ExecutionOutcome::Status::failed) {
    if (!outcome.failed_call) outcome.failed_call = InnerCall{&node, request.inputs};
    // Whatever they cost to make again: the call can then be repeated alone.
    for (const auto& [port, artifact] : outcome.failed_call->inputs) store_->put_blob(*artifact, false);
  }
  if (outcome.status == ExecutionOutcome::Status::ok) {
    for (const PortDecl& port : node.kind.outputs()) require_output(port, outcome);
  }
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

void Runner::Impl::progress(std::size_t i, double fraction) {
  using namespace std::chrono;
  const std::int64_t now = duration_cast<milliseconds>(Clock::now().time_since_epoch()).count();
  std::int64_t last = states_[i]->last_progress.load(std::memory_order_relaxed);
  if (now - last < 50 || !states_[i]->last_progress.compare_exchange_strong(last, now)) return;
  Event event{Event::Kind::node_progress, i};
  event.fraction = std::isnan(fraction) ? 0 : std::clamp(fraction, 0.0, 1.0);
  emit(std::move(event));
}

/// Stores the artifacts of a finished node and then its entry.
std::vector<OutputEntry> Runner::Impl::publish(std::size_t i, const ExecutionOutcome& outcome) {
  ActionEntry entry;
  entry.manifest = result_.nodes[i].manifest;
  entry.warnings = outcome.warnings;
  entry.seconds = outcome.seconds;
  entry.cpu_seconds = outcome.cpu_seconds;
  for (const auto& [port, artifact] : outcome.outputs) {
    entry.outputs.push_back(output_entry(port, *artifact));
    // Between jobs there is no other way than the store.
    if (!store_->is_transport() &&
        (store_->read_only() || !worth_storing(artifact->file_size(), outcome.seconds)))
      continue;
    const bool large = artifact->file_size() > worth_waiting_for;
    const auto give_up = [this, large] { return large && cancelled(); };
    if (give_up()) continue;
    Event event{Event::Kind::cache_write, i};
    event.text = dag_.nodes[i].path + "." + port;
    event.bytes = artifact->file_size();
    const auto start = Clock::now();
    store_->put_blob(*artifact, outcome.seconds > sync_seconds, give_up);
    event.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    emit(std::move(event));
  }
  const ActionPut put = store_->put_action(*states_[i]->key, entry, outcome.seconds > sync_seconds);
  // Another process has left a result meanwhile.
  if (put.disagreed && gives_declared(put.disagreed->outputs, dag_.nodes[i].kind.outputs()) &&
      !same_digests(put.disagreed->outputs, outcome))
    disagree(i);
  // The upstream keeps what it has and says so in its notes; this run goes on with its own result.
  if (options_.strict && put.upstream_disagreed &&
      gives_declared(put.upstream_disagreed->outputs, dag_.nodes[i].kind.outputs()) &&
      !same_digests(put.upstream_disagreed->outputs, outcome))
    disagree(i);
  return std::move(entry.outputs);
}

}  // namespace ballflow
