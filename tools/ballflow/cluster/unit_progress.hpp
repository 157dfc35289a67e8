// Says while a unit runs which of its nodes have ended.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "ballflow/run.hpp"
#include "cluster/submission.hpp"

namespace ballflow {

/// Passes the events of a run on, and hands the nodes that have ended to `write` every `interval` in which
/// one did; never before the first interval is over, so that a short unit writes nothing. What `write` throws
/// costs only what it would have said.
class UnitProgress final : public EventSink {
 public:
  using Write = std::function<void(const std::vector<NodeState>&)>;

  /// Nodes of `dag` before `first` are not of the unit.
  UnitProgress(EventSink& next, const Dag& dag, std::size_t first, Write write,
               std::chrono::milliseconds interval = std::chrono::seconds(10));
  ~UnitProgress() override;

  void on(const Event& event) override;

 private:
  struct Ended {
    std::size_t node;
    NodeStatus status;
    std::string manifest, cause;
  };
  void watch();
  void tell(const std::vector<Ended>& ended);

  EventSink& next_;
  const Dag& dag_;
  const std::size_t first_;
  const Write write_;
  const std::chrono::milliseconds interval_;
  std::vector<NodeState> told_;  // of the thread alone
  std::mutex mutex_;             // guards what follows
  std::condition_variable wake_;
  bool stop_ = false;
  std::vector<Ended> ended_;  // since the last time
  std::thread thread_;
};

}  // namespace ballflow
