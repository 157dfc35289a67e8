// The record of a run: times live here and nowhere else. Schema: schemas/run_report.schema.json.
#pragma once

#include <string>

#include "ballflow/run.hpp"

namespace ballflow {

std::string_view to_string(ExitCode status);

/// Everything that happened in a run. `id` names the run.
Json run_report(const std::string& id, const Dag& dag, const RunResult& result);

/// Key manifests of the latest run of this graph file that used `store`; empty when there was none.
Manifests load_manifests(Store& store, const std::string& graph_file);

/// Keeps the manifests and the report of a run as the latest of its graph file. Quietly does nothing when
/// the store cannot be written.
void save_latest(Store& store, const std::string& graph_file, const RunResult& result, const Dag& dag,
                 const Json& report);

/// Writes a file so that readers see the old or the new content, never a part. Pipes and devices are written
/// to as they are. Throws Error (code store).
void write_atomically(const std::string& path, std::string_view content);

}  // namespace ballflow
