#include <algorithm>
#include <utility>

#include "run/runner.hpp"

namespace ballflow {

void Runner::Impl::dispatch(std::size_t i) {
  ++tasks_;
  group_->run([this, i] { process(i); });
}

/// Nodes that have got their memory from the budget.
void Runner::Impl::dispatch_admitted(const std::vector<std::size_t>& nodes) {
  for (const std::size_t i : nodes) {
    states_[i]->admitted = true;
    dispatch(i);
  }
}

/// The task of a node: what follows from how far it gets.
void Runner::Impl::process(std::size_t i) {
  if (go_on_with(i)) {
    // Last: what the node has read and nobody needs any more is let go by now.
    dispatch_admitted(states_[i]->admitted ? budget_->end(i) : budget_->admit_waiting());
  }
  // Nothing runs and nothing is about to: what waits for memory would wait for ever.
  if (--tasks_ == 0) dispatch_admitted(budget_->start_one());
}

/// As resolve(). Everything that can go wrong with one node ends here, as its result.
bool Runner::Impl::go_on_with(std::size_t i) {
  try {
    return resolve(i);
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
  return true;
}

/// Brings the node as far as it gets. False when it waits: then others go on with it, perhaps already, and
/// its state is theirs.
bool Runner::Impl::resolve(std::size_t i) {
  State& state = *states_[i];
  if (stopping()) return settle(i, NodeStatus::cancelled, "the run was cancelled");
  if (stop_starting_) return true;  // stays pending, becomes skipped
  if (const Given* given = dag_.nodes[i].kind.given()) {
    result_.nodes[i].outputs = {output_entry(given->outputs[0].name, *given->artifact)};
    return settle(i, NodeStatus::hit, "given");
  }
  const bool forced = is_forced(i);
  if (!state.admitted) {
    if (!state.key) {
      ActionKey made = make_key(dag_.nodes[i]);
      state.key = made.key;
      result_.nodes[i].manifest = std::move(made.manifest);
      std::size_t leader = i;
      if (!lead(i, forced, leader)) return leader != i && follow(i, leader);
    }
    if (!forced) {
      const char* const reason =
          state.told_key ? "computed meanwhile by another run" : "same inputs and parameters";
      if (const auto entry = known_entry(i)) return adopt(i, *entry, reason);
      if (!may_run(i)) return settle(i, NodeStatus::skipped, "not in the cache, and only others may run");
    }
    if (!admit(i)) return false;
  }

  LockAttempt attempt = store_->try_lock(*state.key);
  if (attempt.busy) return wait_for_key(i);
  if (!forced) {
    // Another process may have computed the same between the look at the cache and the lock.
    if (const auto entry = known_entry(i)) return adopt(i, *entry, "computed meanwhile by another run");
  }
  emit({Event::Kind::node_started, i});
  const NodeStatus status = execute_and_publish(i);
  attempt.lock.reset();
  return settle(i, status, forced ? "forced" : why(i));
}

/// Single-flight: one computation for all nodes with a key, or two where only some of them are forced. True
/// when it is that of `i`. Otherwise `leader` has computed it, or is `i` where the leader is at it and passes
/// on what it gets.
bool Runner::Impl::lead(std::size_t i, bool forced, std::size_t& leader) {
  const std::lock_guard lock(mutex_);
  Flight& flight = flights_.try_emplace(*states_[i]->key).first->second;
  if (flight.leader == nobody || (forced && !flight.forced)) {
    flight.leader = i;
    flight.forced = forced;
    return true;
  }
  const NodeStatus status = result_.nodes[flight.leader].status;
  if (status == NodeStatus::pending) {
    flight.followers.push_back(i);
    return false;
  }
  if (status != NodeStatus::run && status != NodeStatus::hit) return true;
  leader = flight.leader;
  return false;
}

/// Whether the node has still to be computed in spite of its entry: once, also when the plan becomes void.
bool Runner::Impl::is_forced(std::size_t i) {
  if (options_.force.count(i) == 0) return false;
  const std::lock_guard lock(mutex_);
  return force_.count(i) != 0;
}

/// Another process has the lock of the key. The node waits for it without memory and without a thread.
bool Runner::Impl::wait_for_key(std::size_t i) {
  State& state = *states_[i];
  state.admitted = false;
  dispatch_admitted(budget_->end(i));
  if (!std::exchange(state.told_key, true)) {
    Event event{Event::Kind::node_waiting, i};
    event.text = "another process computes the same";
    emit(std::move(event));
  }
  if (options_.threads == 1) {
    key_waits_->add(*state.key, [this, i] { dispatch(i); });
  } else {
    // The task is there from now on, so that the group does not end without it.
    const auto task = std::make_shared<tbb::task_handle>(group_->defer([this, i] { process(i); }));
    key_waits_->add(*state.key, [this, task] {
      ++tasks_;
      arena_->enqueue(std::move(*task));
    });
  }
  return false;
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

/// Takes what the node will need from the budget; false: it waits until others have ended.
bool Runner::Impl::admit(std::size_t i) {
  std::uint64_t reads_held = 0;
  for (const auto& [port, edge] : dag_.nodes[i].inputs) {
    State& producer = *states_[edge.node];
    const std::unique_lock lock(producer.mutex, std::try_to_lock);
    if (!lock.owns_lock()) continue;  // just being made again
    const auto held = producer.held.find(edge.port);
    if (held != producer.held.end()) reads_held += budget_->held(held->second);
  }
  const auto tell = [&] {
    Event event{Event::Kind::node_waiting, i};
    event.text = "memory";
    emit(std::move(event));
  };
  if (!budget_->start(i, memory_claim(i), reads_held, tell)) return false;
  states_[i]->admitted = true;
  return true;
}

/// What the node needs beyond its inputs, and what its outputs will take. An input that is lost is made again
/// before, by a node that needs memory itself: of those the one that needs most counts, because they run one
/// after the other, and all of their outputs.
std::uint64_t Runner::Impl::memory_claim(std::size_t i) {
  std::uint64_t most = 0, outputs = 0;
  std::set<std::size_t> seen;
  std::vector<std::size_t> left{i};
  while (!left.empty()) {
    const std::size_t one = left.back();
    const DagNode& node = dag_.nodes[one];
    left.pop_back();
    for (const auto& [port, edge] : node.inputs) {
      const OutputEntry* entry = find_output(result_.nodes[edge.node].outputs, edge.port);
      if (entry != nullptr && !is_at_hand(edge, *entry) && seen.insert(edge.node).second)
        left.push_back(edge.node);
    }
    const std::uint64_t read = input_bytes(one);
    most = std::max(most, node.kind.memory().for_inputs_of(read));
    outputs += one == i ? output_claim(i, read) : bytes_of(result_.nodes[one].outputs);
  }
  return most + outputs;
}

std::uint64_t Runner::Impl::input_bytes(std::size_t i) const {
  std::uint64_t bytes = 0;
  for (const auto& [port, edge] : dag_.nodes[i].inputs) {
    const OutputEntry* entry = find_output(result_.nodes[edge.node].outputs, edge.port);
    if (entry != nullptr) bytes += entry->bytes;
  }
  return bytes;
}

/// What the outputs of the node will take in memory: as its entry says when it is forced, as nodes of its
/// type took in this run, as it took in the run before; else such a share of the budget that one on every
/// thread leave half of it.
std::uint64_t Runner::Impl::output_claim(std::size_t i, std::uint64_t read) {
  if (is_forced(i)) {
    if (const auto entry = known_entry(i)) return bytes_of(entry->outputs);
  }
  if (const auto seen = output_sizes_.expect(dag_.nodes[i].kind.type(), read)) return *seen;
  if (const auto before = earlier_.find(dag_.nodes[i].path); before != earlier_.end()) {
    const auto entry = entry_of_manifest(*store_, before->second);
    if (entry) return bytes_of(entry->outputs);
  }
  return budget_->bytes() / (2 * std::uint64_t{options_.threads});
}

bool Runner::Impl::adopt(std::size_t i, const ActionEntry& entry, const std::string& reason) {
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
  return settle(i, NodeStatus::hit, reason);
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

/// The node has its final status: tells followers and consumers, frees what nobody needs any more. Always
/// true.
bool Runner::Impl::settle(std::size_t i, NodeStatus status, const std::string& reason) {
  {
    const std::lock_guard lock(mutex_);
    result_.nodes[i].status = status;
    result_.nodes[i].reason = reason;
    if (status == NodeStatus::failed && !options_.keep_going) stop_starting_ = true;
  }
  const bool good = status == NodeStatus::hit || status == NodeStatus::run;
  if (good) compare_with_equals(i);
  // Before any consumer can start: one that needs the artifact again writes to the result.
  Event event{Event::Kind::node_finished, i};
  event.result = &result_.nodes[i];
  emit(std::move(event));

  std::vector<std::size_t> followers, ready, done_with;
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
    for (const std::size_t twin : states_[i]->twins) {
      if (--states_[twin]->consumers_left == 0) done_with.push_back(twin);
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
  if (states_[i]->consumers.empty() && states_[i]->twins.empty()) done_with.push_back(i);
  for (const std::size_t node : done_with) forget(node);
  for (const std::size_t consumer : ready) {
    if (!stopping() && !stop_starting_.load()) dispatch(consumer);
  }
  return true;
}

/// One run never mixes two results of one key: where nodes of equal keys got different ones, the newer holds
/// and everything is looked at again.
void Runner::Impl::compare_with_equals(std::size_t i) {
  if (!states_[i]->key) return;
  const NodeResult& mine = result_.nodes[i];
  {
    const std::lock_guard lock(mutex_);
    Flight& flight = flights_.try_emplace(*states_[i]->key).first->second;
    if (flight.settled == nobody) {
      flight.settled = i;
      return;
    }
    const NodeResult& other = result_.nodes[flight.settled];
    if (same_digests(other.outputs, mine.outputs)) return;
    const NodeResult& newer = mine.status == NodeStatus::run ? mine : other;
    replaced_[*states_[i]->key] = {newer.manifest, newer.outputs, newer.warnings, newer.cost_seconds,
                                   newer.cpu_seconds};
  }
  tell_disagreement(i);
  void_ = true;
  stop_ = true;
}

/// Gives a node what another one with the same key has computed or found in this round.
bool Runner::Impl::follow(std::size_t i, std::size_t leader) {
  result_.nodes[i].outputs = result_.nodes[leader].outputs;
  result_.nodes[i].warnings = result_.nodes[leader].warnings;
  result_.nodes[i].cost_seconds = result_.nodes[leader].cost_seconds;
  {
    const std::scoped_lock lock(states_[leader]->mutex, states_[i]->mutex);
    states_[i]->held = states_[leader]->held;
    for (const auto& [port, artifact] : states_[i]->held) budget_->share(artifact);
  }
  {
    const std::lock_guard lock(mutex_);
    force_.erase(i);
  }
  return settle(i, NodeStatus::hit, "same computation as " + dag_.nodes[leader].path);
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
