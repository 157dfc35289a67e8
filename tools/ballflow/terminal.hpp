// What a run looks like while it runs: a live block on a terminal, plain lines in a pipe.
#pragma once

#include <memory>
#include <string>

#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"

namespace ballflow::cli {

/// "35 676".
std::string grouped(std::int64_t number);
/// "0.012 s", "1.24 s", "2 min 05 s".
std::string duration(double seconds);
/// What an output is, in words: "35 676 inner balls".
std::string describe(const OutputEntry& output);
/// The outputs of a node in one line.
std::string describe(const std::vector<OutputEntry>& outputs);

/// Shows the events of a run on standard error. `live`: redraw a block of running nodes.
std::unique_ptr<EventSink> progress_display(const Dag& dag, bool live);
/// Shows nothing.
std::unique_ptr<EventSink> no_display();

}  // namespace ballflow::cli
