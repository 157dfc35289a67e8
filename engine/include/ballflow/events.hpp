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
  enum class Kind {
    run_started,
    node_waiting,  // for memory, or for another process that computes the same
    node_started,
    node_progress,
    node_message,
    cache_read,   // an artifact was taken from the store
    cache_write,  // an artifact was written to the store
    node_finished,
    run_finished
  };
  Kind kind;
  std::size_t node = 0;                // index into Dag::nodes; of a read the node that needs the artifact
  double fraction = 0;                 // node_progress
  bool warning = false;                // node_message
  std::string text = {};               // node_message; node_waiting: for what; cache_*: "node.port"
  const NodeResult* result = nullptr;  // node_finished; valid during the call
  std::uint64_t bytes = 0;             // cache_*: of the artifact
  double seconds = 0;                  // cache_*: how long it took
  double time = 0;                     // seconds since the run began
  std::uint64_t memory = 0;  // what running nodes claim, and outputs that are held (RunOptions::memory_bytes)
};

/// "node_started", as in schemas/run_events.schema.json.
std::string_view to_string(Event::Kind kind);

/// Receives events one at a time, from any thread.
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void on(const Event& event) = 0;
};

}  // namespace ballflow
