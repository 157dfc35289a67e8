// Runs of graphs, for Python: they go on without the interpreter's lock, and are told what happens.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "artifacts.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/run.hpp"
#include "ballflow/store.hpp"

namespace ballflow::python {

/// What is asked of a run; names as on the command line.
struct RunSettings {
  unsigned threads = 0;
  std::string memory;
  std::uint64_t seed = 0;
  bool keep_going = false, strict = false;
  std::vector<std::string> until, only, force;
};

/// A graph that was read and checked, with what it refers to.
struct Plan {
  std::shared_ptr<const Registry> registry;
  Dag dag;
};

/// A finished run.
class FinishedRun {
 public:
  /// Runs the graph while other Python threads go on. Called with the GIL, by any thread; `progress` (or
  /// None) is called by that thread with a dict for every event, and ends the run by returning False. So do a
  /// signal handler that raises, and `progress` when it raises: what is finished is kept, and the exception
  /// goes on to the caller. Everything else that goes wrong in nodes is in the report.
  /// `collect_above`: bytes that the cache may have, as --cache-size says it; empty: the default. `command`:
  /// a command line that repeats the run, for its report; empty where there is none.
  FinishedRun(std::shared_ptr<const Plan> plan, std::shared_ptr<Store> store, const RunSettings& settings,
              const std::string& collect_above, const std::string& command, const py::object& progress);
  ~FinishedRun();
  FinishedRun(const FinishedRun&) = delete;
  FinishedRun& operator=(const FinishedRun&) = delete;

  const std::string& id() const { return id_; }
  bool recorded() const { return recorded_; }
  /// As schemas/run_report.schema.json says.
  std::string report() const { return report_; }
  std::string trouble() const { return store_->trouble(); }

  /// What a node gave: from memory or the cache, else made again. Throws Error.
  ArtifactPtr artifact(const std::string& path, const std::string& port);

 private:
  std::shared_ptr<const Plan> plan_;
  std::shared_ptr<Store> store_;
  std::map<std::string, std::size_t> by_path_;
  std::string id_, report_;
  bool recorded_ = false;
  std::atomic<bool> cancel_{false};  // the runner may look at it whenever it makes an artifact again
  std::unique_ptr<EventSink> sink_;
  std::unique_ptr<Runner> runner_;
};

}  // namespace ballflow::python
