// The one stream of events of a run; progress on a terminal, JSON lines and reports are made from it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/store.hpp"

namespace ballflow {

enum class NodeStatus { pending, hit, run, failed, skipped, cancelled };

std::string_view to_string(NodeStatus status);

struct NodeResult;

struct Event {
  enum class Kind { run_started, node_started, node_progress, node_message, node_finished, run_finished };
  Kind kind;
  std::size_t node = 0;                // index into Dag::nodes
  double fraction = 0;                 // node_progress
  bool warning = false;                // node_message
  std::string text;                    // node_message
  const NodeResult* result = nullptr;  // node_finished; valid during the call
};

/// Receives events one at a time, from any thread.
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void on(const Event& event) = 0;
};

}  // namespace ballflow
