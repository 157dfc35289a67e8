// What "ballflow run" does, for commands that run a graph of their own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "commands/commands.hpp"

namespace ballflow::cli {

struct RunArguments {
  GraphArguments graph;
  RunSettings settings;
  std::string out, report, trace;
  std::vector<std::string> formats;
  bool json = false, quiet = false;
  bool table = true;       // prints what every node did, and what matters; else totals
  bool sweep = false;      // the command is "sweep"
  std::string shard;       // "2/5": the second of five parts of the variants; empty: all
  bool no_record = false;  // in the history
};

/// Called after outputs are written and before anything is printed, when the run has results.
using AfterRun =
    std::function<void(const Dag&, const RunResult&, const std::function<ArtifactPtr(const EdgeRef&)>& load)>;

/// Reads, checks and runs the graph. Returns the exit code.
int run_graph(const Common& common, const RunArguments& arguments, const AfterRun& after = {});

}  // namespace ballflow::cli
