// The events of a run for programs: JSON lines (schemas/run_events.schema.json) and Chrome's trace format.
#pragma once

#include <memory>
#include <string>

#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"

namespace ballflow::cli {

/// Writes every event as one line of JSON to the standard output, as it happens.
std::unique_ptr<EventSink> event_lines(const Dag& dag);

/// One line of JSON on the standard output.
void print_line(const Json& json);

/// Collects a trace that Perfetto (ui.perfetto.dev) and chrome://tracing open: nodes on lanes, one for each
/// that runs at the same time, with what they read from and write to the cache; waits; the estimates of the
/// running nodes and the resident memory.
class Trace : public EventSink {
 public:
  /// The whole file; after the run.
  virtual std::string text() const = 0;
};
std::unique_ptr<Trace> trace(const Dag& dag);

}  // namespace ballflow::cli
