#include "cluster/unit_progress.hpp"

#include <utility>

#include "ballflow/key.hpp"

namespace ballflow {

UnitProgress::UnitProgress(EventSink& next, const Dag& dag, std::size_t first, Write write,
                           std::chrono::milliseconds interval)
    : next_(next), dag_(dag), first_(first), write_(std::move(write)), interval_(interval) {
  thread_ = std::thread([this] { watch(); });
}

UnitProgress::~UnitProgress() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void UnitProgress::on(const Event& event) {
  next_.on(event);
  if (event.kind != Event::Kind::node_finished || event.node < first_) return;
  const NodeResult& result = *event.result;
  const std::lock_guard lock(mutex_);
  ended_.push_back({event.node, result.status, result.manifest, result.cause});
}

void UnitProgress::watch() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval_, [this] { return stop_; })) {
    if (ended_.empty()) continue;
    const std::vector<Ended> ended = std::exchange(ended_, {});
    lock.unlock();
    tell(ended);
    lock.lock();
  }
}

void UnitProgress::tell(const std::vector<Ended>& ended) {
  try {
    for (const Ended& one : ended) {
      const DagNode& node = dag_.nodes[one.node];
      NodeState& state = told_.emplace_back();
      state.path = node.path;
      state.type = node.kind.type();
      state.status = std::string(to_string(one.status));
      state.cause = one.cause;
      if (one.status == NodeStatus::run || one.status == NodeStatus::hit) state.key = key_of(one.manifest);
    }
    write_(told_);
  } catch (const std::exception&) {
  }
}

}  // namespace ballflow
