// What a submitted graph leaves in the shared store:
//
//   <store>/submissions/<run>/submission.json    what was submitted, and the ids of the jobs
//   <store>/submissions/<run>/units/<unit>.json  (units.hpp)
//   <store>/submissions/<run>/status/<unit>.json what became of the nodes of a unit, written by its job at
//                                                its end
//   <store>/submissions/<run>/status/<unit>.part what has become of them so far, written every few seconds
//                                                and removed at the end
//   <store>/submissions/<run>/log/<unit>.out     what the job printed
//   <store>/submissions/<run>/job.sh             the script of all jobs
//   <store>/submissions/of-<hash>                the latest run of the same command: a text, its name
//
// Units are called "<array>-<task>". None of this is needed to use results: those are in the store, and
// whether a node is done is known by its entry there alone.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/units.hpp"

namespace ballflow {

struct SubmittedArray {
  std::size_t units = 0;
  std::uint64_t memory = 0;  // bytes, of a task
  unsigned minutes = 0, threads = 1;
  double seconds = 0;  // predicted, of all
  std::string job;     // its id
};

/// More than was predicted, after a job ran out of it.
struct Growth {
  double memory = 1, time = 1;
};

struct Submission {
  std::string run, command, folder, graph;   // `folder`: of the submitter
  std::string same;                          // of submissions of the same graph and parameters
  std::size_t known = 0;                     // nodes whose results were there before
  std::map<std::string, std::size_t> types;  // nodes to run by type
  std::vector<SubmittedArray> arrays;
  std::map<std::string, Growth> grown;  // by node path

  std::vector<std::string> jobs() const;
};

/// What a job says of a node.
struct NodeState {
  std::string path, type, status;  // run, hit, failed, cancelled, skipped, missing (an input)
  std::optional<Digest> key;
  std::string cause, text;  // of a failure; the whole of what is printed
  double seconds = 0;       // that it ran
};

struct UnitStatus {
  int exit_code = 0;
  double seconds = 0;
  bool out_of_time = false;  // it was told that its time is nearly over, and ended
  std::string host, job;
  std::size_t of = 0;  // nodes that the unit has
  std::vector<NodeState> nodes;
};

struct SubmissionsCollected {
  std::size_t removed = 0, left = 0;  // runs; removed: or would be
  std::string why;                    // of the first that could not be removed
};

/// The folder of submissions of a store.
class Submissions {
 public:
  explicit Submissions(const std::string& store);

  std::string folder(const std::string& run) const { return root_ + '/' + run; }
  /// Makes the folders of a run.
  void make(const std::string& run) const;
  void write(const Submission& submission) const;
  /// By the name of the run or its beginning, "latest" for the last. Throws Error (code usage) when there is
  /// none.
  Submission read(const std::string& run) const;
  /// Throws Error (code store) when its file is not there or damaged.
  Unit unit(const std::string& run, const std::string& name, const Registry& registry) const;
  std::optional<Submission> latest_of(const std::string& same) const;
  /// What a node took on the average in earlier submissions of anybody, by type: of some units of the newest
  /// runs, at most 100, so that it costs the same for any number of them.
  std::map<std::string, double> usual_seconds() const;
  /// Removes what is kept of runs of which nothing was written for `older_than` seconds. `is_active`: whether
  /// jobs of it wait or run; it stays then. Links are neither followed nor removed.
  SubmissionsCollected collect(std::int64_t older_than, bool dry_run,
                               const std::function<bool(const Submission&)>& is_active) const;

 private:
  std::string root_;
};

std::string unit_name(std::size_t array, std::size_t task);

/// Of a job that ends.
void write_status(const std::string& run_folder, const std::string& unit, const UnitStatus& status);
/// Nothing when the job has not ended by itself.
std::optional<UnitStatus> read_status(const std::string& run_folder, const std::string& unit);
/// The nodes that have ended so far, of a job that runs. Never over what an ended one has written: of two
/// copies of a job one may go on for longer.
void write_progress(const std::string& run_folder, const std::string& unit, const UnitStatus& status);
/// Nothing when the job has ended by itself, or has just begun. A job that was killed leaves it.
std::optional<UnitStatus> read_progress(const std::string& run_folder, const std::string& unit);
/// The last lines of what the job printed, at most `lines`.
std::string log_tail(const std::string& run_folder, const std::string& unit, std::size_t lines);

}  // namespace ballflow
