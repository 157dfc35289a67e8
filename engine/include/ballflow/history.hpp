// What ran when: every run that uses a store that can be written leaves its record there.
//
//   <root>/runs/<id>/report.json      the report (schemas/run_report.schema.json); it is written last, so a
//   folder
//                                     without it is a run that is being recorded, or whose process was killed
//   <root>/runs/<id>/manifests.json   {"node path": "key manifest", ...}: what reasons and `explain` compare
//   with
//
// <id> is "20261122T141503.482-1f9b03c2-7e1d": when the run began (UTC), the beginning of the SHA-256 of the
// path of the graph file, and something random. So the names alone, listed once, give the latest run of a
// graph; there is no index that could be damaged or that processes would have to agree on.
//
// At most 220 runs are kept: beyond that all but the 200 that ended last go. The collector of the cache
// (gc.hpp) removes more of them, oldest first, when they take more than a twentieth of its limit.
//
// Recording never fails a run: a store that is full or read-only just has no record of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballflow/json.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

/// A name for a run of a graph file that begins now.
std::string new_run_id(const std::string& graph_file);

/// "2026-11-22T14:15:03.482Z" from the id of a run; empty when it is none.
std::string start_of_run(const std::string& id);

/// Records a finished run. False when the store cannot be written or has a run of this name.
bool save_run(Store& store, const std::string& id, const Manifests& manifests, const Json& report);

/// What the beginning of a report says.
struct RunInfo {
  std::string id, graph, status;  // status: "ok", "failed" or "cancelled"
  double seconds = 0;
};

/// The recorded runs, newest first, at most `limit` of them. Runs that were not recorded as a whole are left
/// out.
std::vector<RunInfo> list_runs(Store& store, std::size_t limit = SIZE_MAX);

/// A report that was read. nlohmann::json, since `Json` looks names up by linear search and reports of
/// sweeps name many thousand nodes.
struct RunRecord {
  std::string id;
  std::string source;  // where it was read from, for messages
  nlohmann::json report;
};

/// The run that `name` stands for:
///   "latest", "previous"   the newest run, and the one before it; of `graph_file` when that is not empty
///   an id, or the beginning of one id
///   a report file, or a folder with a "report.json" in it
/// Throws Error (code usage) that names the nearest ids when there is none, and (code store) when the file is
/// no run report.
RunRecord find_run(Store& store, const std::string& name, const std::string& graph_file = {});

/// The key manifests of a recorded run; empty when there are none (any more).
Manifests run_manifests(Store& store, const std::string& id);

/// The key manifests of the latest run of a graph file, whose reasons the next run names; empty when there is
/// none.
Manifests latest_manifests(Store& store, const std::string& graph_file);

}  // namespace ballflow
