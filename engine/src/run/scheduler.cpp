#include <algorithm>
#include <utility>

#include "run/runner.hpp"

namespace ballflow {

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
  if (const Given* given = node.kind.given()) {
    result_.nodes[i].outputs = {output_entry(given->outputs[0].name, *given->artifact)};
    return settle(i, NodeStatus::hit, "given");
  }

  const bool forced = options_.force.count(i) != 0 && take_force(i);
  if (!state.key) {
    ActionKey made = make_key(node);
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
    if (const auto entry = known_entry(i)) return adopt(i, *entry, "same inputs and parameters");
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
    if (!forced) meanwhile = known_entry(i);
    if (!meanwhile && !stopping()) status = execute_and_publish(i);
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
std::optional<ActionEntry> Runner::Impl::known_entry(std::size_t i) {
  const Digest& key = *states_[i]->key;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = replaced_.find(key); found != replaced_.end()) return found->second;
  }
  return find_entry(*store_, dag_.nodes[i].kind, key);
}

ActionKey Runner::Impl::make_key(const DagNode& node) {
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
    most = std::max(most, node.kind.memory().for_inputs_of(bytes));
  }
  return most;
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

}  // namespace ballflow
