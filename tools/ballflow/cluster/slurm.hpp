// Slurm as its users see it: sbatch, squeue, scancel, scontrol. Nothing of it needs rights of an
// administrator or accounting. Tried with 22.05.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ballflow::slurm {

struct Limits {
  std::uint64_t array_size = 1000;  // indices 0 to array_size - 1
  std::uint64_t jobs = 10'000;      // that the whole cluster may know, tasks of arrays counted
};

/// What the cluster says of itself. Throws Error (code store) when there is none.
Limits limits();

struct Array {
  std::string name, comment, folder, log, script;   // script: with its arguments
  std::vector<std::string> script_arguments, more;  // more: options of sbatch as the user gave them
  std::size_t tasks = 1;
  unsigned threads = 1;
  std::uint64_t memory = 0;  // bytes, of a task
  unsigned minutes = 60;
  std::vector<std::string> after;  // ids of jobs
  bool one_to_one = false;         // task i waits for task i of the one job in `after`, else for all of all
};

/// The words of the sbatch call.
std::vector<std::string> submit_words(const Array& array);
/// The id of the job. Throws Error (code store) with what sbatch said.
std::string submit(const Array& array);

struct Tasks {
  std::size_t pending = 0, running = 0, held = 0, hopeless = 0;  // the latter two wait for ever as they are
  std::size_t active() const { return pending + running; }
};

/// How tasks of these jobs ended, by "<job>_<task>": "OUT_OF_MEMORY", "TIMEOUT", "FAILED", ... Of those that
/// the scheduler remembers, which is some minutes; of none when it does not answer.
std::map<std::string, std::string> ends(const std::vector<std::string>& jobs);

/// Of these jobs, what has not ended. Throws Error when the scheduler does not answer.
Tasks tasks(const std::vector<std::string>& jobs);
/// Jobs that were held after a failed launch run again; what waits for what never comes is cancelled.
void release(const std::vector<std::string>& jobs);
void cancel(const std::vector<std::string>& jobs);

}  // namespace ballflow::slurm
