// What a user is told about a node that failed, and how to run that node alone again.
#pragma once

#include <string>
#include <vector>

#include "ballflow/run.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {

/// The run in which it failed.
struct FailedRun {
  const Common& common;
  const Registry& registry;
  const Dag& dag;
  Store& store;
  std::uint64_t seed = 0;
  const std::vector<Setting>& settings;
};

/// Lines about node `i` of the run, each with its newline: path, type, cause, what to do, parameters, inputs
/// with their digests, and the "ballflow exec-node" command. For a node in the body of a loop the last three
/// are those of the iteration that failed.
std::string failure_text(const FailedRun& run, const RunResult& result, std::size_t i);

}  // namespace ballflow::cli
