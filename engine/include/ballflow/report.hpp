// The record of a run: times live here and nowhere else. Schema: schemas/run_report.schema.json.
#pragma once

#include <string>

#include "ballflow/run.hpp"

namespace ballflow {

std::string_view to_string(ExitCode status);

/// Everything that happened in a run. `id` names the run (history.hpp).
Json run_report(const std::string& id, const Dag& dag, const RunResult& result);

/// What happened to one node: its part of run_report.
Json node_report(const DagNode& node, const NodeResult& result);

}  // namespace ballflow
