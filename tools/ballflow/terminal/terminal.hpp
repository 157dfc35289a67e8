// What a run looks like while it runs: a live block on a terminal, plain lines in a pipe.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"

namespace ballflow::cli {

/// "35 676".
std::string grouped(std::int64_t number);
/// "0.012 s", "1.24 s", "2 min 05 s".
std::string duration(double seconds);
/// Bytes of this process in memory; 0 where the system does not say.
std::uint64_t resident_bytes();
/// What an output is, in words: "35 676 inner balls".
std::string describe(const OutputEntry& output);
/// The outputs of a node in one line.
std::string describe(const std::vector<OutputEntry>& outputs);

/// What is known of a run before it ends.
struct Expectations {
  std::vector<bool> needed;  // as Dag::nodes: what will be looked at
  /// Called once, from another thread, when the run has taken a while: what it would do, as it was at the
  /// start. May be empty.
  std::function<std::vector<NodePlan>()> plan;
};

/// Shows the events of a run on standard error: plain lines, and with `live` below them a block that is
/// redrawn: the nodes that run, with the part that is done and the time that is left (from their progress,
/// else from what they took before), and a line for the whole run.
std::unique_ptr<EventSink> progress_display(const Dag& dag, bool live, Expectations expectations = {});
/// Shows nothing.
std::unique_ptr<EventSink> no_display();

}  // namespace ballflow::cli
