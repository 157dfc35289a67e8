#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "cluster/slurm.hpp"
#include "commands/submit_command.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;
using Verdict = NodePlan::Verdict;

/// What is asked for beyond the prediction, which may be of another machine.
constexpr double time_margin = 3;
constexpr unsigned least_minutes = 5;

bool has_to_run(const NodePlan& plan) {
  return plan.verdict == Verdict::run || plan.verdict == Verdict::maybe;
}

std::string gibibytes(std::uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g GB", static_cast<double>(bytes) / (1u << 30));
  return text;
}

/// The words that make the same libraries available elsewhere.
std::string surroundings(const Common& common) {
  std::error_code ignored;
  std::string words;
  for (const std::string& plugin : common.plugins)
    words += " --plugin " + shell_word(fs::absolute(plugin, ignored).string());
  return words;
}

std::string program_path() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? "ballflow" : self.string();
}

}  // namespace

Submitter::Submitter(const Common& common, const SubmitArguments& arguments, const Registry& registry,
                     const Dag& dag, std::shared_ptr<Store> store)
    : common_(common),
      arguments_(arguments),
      registry_(registry),
      dag_(dag),
      store_(std::move(store)),
      submissions_(arguments.store),
      given_up_(dag.nodes.size(), false),
      alone_(dag.nodes.size(), false) {
  std::error_code ignored;
  const std::string where = fs::current_path(ignored).string();
  same_ = sha256(where + '\n' + arguments.graph.words() + '\n' + std::to_string(arguments.seed))
              .hex()
              .substr(0, 32);
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) index_[dag.nodes[i].path] = i;
}

bool Submitter::plan_round() {
  plans_ = plan(dag_, *store_, arguments_.seed, {});
  done_ = to_run_ = 0;
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    if (plans_[i].verdict == Verdict::hit) ++done_;
    if (!has_to_run(plans_[i])) continue;
    bool given_up = given_up_[i];
    for (const auto& [slot, edge] : dag_.nodes[i].inputs) given_up = given_up || given_up_[edge.node];
    given_up_[i] = given_up;
    if (given_up) {
      plans_[i].verdict = Verdict::unneeded;
    } else {
      ++to_run_;
    }
  }
  return to_run_ != 0;
}

void Submitter::pack_round(const slurm::Limits& limits) {
  PackOptions options;
  options.unit_seconds = arguments_.unit_seconds;
  options.most_units = static_cast<std::size_t>(std::max<std::uint64_t>(limits.array_size, 1));
  options.alone = alone_;
  for (std::size_t i = 0; i < plans_.size() && !usual_seconds_; ++i) {
    if (has_to_run(plans_[i]) && !plans_[i].seconds) usual_seconds_ = submissions_.usual_seconds();
  }
  if (usual_seconds_) options.usual_seconds = *usual_seconds_;
  if (!grown_.empty()) {
    options.memory_factor.assign(dag_.nodes.size(), 1);
    options.time_factor = options.memory_factor;
    for (const auto& [path, growth] : grown_) {
      const auto node = index_.find(path);
      if (node == index_.end()) continue;
      options.memory_factor[node->second] = growth.memory;
      options.time_factor[node->second] = growth.time;
    }
  }
  // Others submit too: at most half of what the cluster may know.
  for (;; options.unit_seconds *= 2) {
    arrays_ = pack(dag_, plans_, options);
    std::size_t units = 0;
    for (const UnitArray& array : arrays_) units += array.units.size();
    if (units <= std::max<std::uint64_t>(limits.jobs / 2, 1) || options.unit_seconds > 1e9) break;
  }

  submission_ = {};
  submission_.run = new_run_id(arguments_.graph.file());
  submission_.command = "ballflow submit " + arguments_.graph.words();
  if (arguments_.seed != 0) submission_.command += " --seed " + std::to_string(arguments_.seed);
  std::error_code ignored;
  submission_.folder = fs::current_path(ignored).string();
  submission_.graph = arguments_.graph.file();
  submission_.same = same_;
  submission_.known = done_;
  submission_.grown = grown_;
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    if (has_to_run(plans_[i])) ++submission_.types[dag_.nodes[i].kind.type()];
  }
  std::vector<std::vector<std::string>> rows = {
      {"array", "units", "nodes", "after", "threads", "memory", "limit", "predicted"}};
  double total = 0;
  bool unknown = false;
  for (std::size_t a = 0; a < arrays_.size(); ++a) {
    const UnitArray& array = arrays_[a];
    SubmittedArray& to = submission_.arrays.emplace_back();
    std::size_t nodes = 0;
    for (const PackedUnit& unit : array.units) {
      to.seconds += unit.seconds;
      nodes += unit.nodes.size();
    }
    to.units = array.units.size();
    to.memory = array.memory;
    to.threads = arguments_.threads;
    const double minutes = std::ceil(array.longest() * time_margin / 60) * array.time_factor;
    to.minutes = std::max(least_minutes, static_cast<unsigned>(std::min(minutes, 5e5)));
    if (array.unknown)
      to.minutes = std::max(to.minutes, static_cast<unsigned>(arguments_.minutes * array.time_factor));
    std::string after;
    for (const std::size_t need : array.needs) after += (after.empty() ? "" : ",") + std::to_string(need);
    if (array.one_to_one) after += " (one to one)";
    rows.push_back({std::to_string(a), grouped(static_cast<std::int64_t>(to.units)),
                    grouped(static_cast<std::int64_t>(nodes)), after.empty() ? "-" : after,
                    std::to_string(to.threads), gibibytes(to.memory), std::to_string(to.minutes) + " min",
                    (array.unknown ? "?" : "~") + duration(to.seconds)});
    total += to.seconds;
    unknown = unknown || array.unknown;
  }
  print_table(rows);
  std::printf("\n%s nodes are done, %s to run in %zu arrays: ~%.2g hours predicted%s\n",
              grouped(static_cast<std::int64_t>(done_)).c_str(),
              grouped(static_cast<std::int64_t>(to_run_)).c_str(), arrays_.size(), total / 3600,
              unknown ? ", of nodes that never ran here by what their like took in "
                        "earlier submissions, else a second"
                      : "");
}

/// What was given to the graph has to be where the jobs look.
void Submitter::give_artifacts() {
  for (const DagNode& node : dag_.nodes) {
    const Given* const given = node.kind.given();
    if (given == nullptr || store_->put_blob(*given->artifact, true)) continue;
    throw Error(ExitCode::store, "the artifact of " + node.path + " cannot be put into " + arguments_.store,
                "choose a store that can be written");
  }
}

void Submitter::write_units(const std::string& folder) {
  give_artifacts();
  std::vector<std::string> unit_of(dag_.nodes.size());
  for (std::size_t a = 0; a < arrays_.size(); ++a) {
    for (std::size_t u = 0; u < arrays_[a].units.size(); ++u) {
      for (const std::size_t i : arrays_[a].units[u].nodes) unit_of[i] = unit_name(a, u);
    }
  }
  for (std::size_t a = 0; a < arrays_.size(); ++a) {
    for (std::size_t u = 0; u < arrays_[a].units.size(); ++u) {
      Unit unit = make_unit(dag_, plans_, arrays_[a].units[u].nodes, unit_of);
      unit.run = submission_.run;
      unit.name = unit_name(a, u);
      unit.seed = arguments_.seed;
      unit.threads = arguments_.threads;
      unit.seconds = 60.0 * submission_.arrays[a].minutes;
      write_atomically(folder + "/units/" + unit.name + ".json", unit_text(unit));
    }
  }
}

std::string Submitter::unit_command() const {
  std::error_code ignored;
  return shell_word(program_path()) + surroundings(common_) + " exec-node --upstream " +
         shell_word(fs::absolute(arguments_.store, ignored).string()) + " --patience " +
         std::to_string(arguments_.patience);
}

void Submitter::submit_round() {
  submissions_.make(submission_.run);
  const std::string folder = submissions_.folder(submission_.run);
  write_units(folder);
  // What comes from the store lies on the disk of the node that runs the job, for the jobs that follow.
  const std::string script =
      "#!/bin/sh\n"
      "# Runs one unit: job.sh ARRAY, in a task of a job array.\n"
      ": \"${BALLFLOW_CACHE:=${TMPDIR:-/tmp}/ballflow-$(id -u)}\"\n"
      "export BALLFLOW_CACHE\n"
      "exec " +
      unit_command() + " --unit " + shell_word(folder) + "/units/\"$1-$SLURM_ARRAY_TASK_ID\".json\n";
  write_atomically(folder + "/job.sh", script);
  submissions_.write(submission_);
  for (std::size_t a = 0; a < arrays_.size(); ++a) {
    SubmittedArray& array = submission_.arrays[a];
    slurm::Array job;
    job.name = "ballflow-" + std::to_string(a);
    job.comment = submission_.run;
    job.folder = submission_.folder;
    job.log = folder + "/log/" + std::to_string(a) + "-%a.out";
    job.script = folder + "/job.sh";
    job.script_arguments = {std::to_string(a)};
    job.more = arguments_.more;
    job.tasks = array.units;
    job.threads = array.threads;
    job.memory = array.memory;
    job.minutes = array.minutes;
    for (const std::size_t need : arrays_[a].needs) job.after.push_back(submission_.arrays[need].job);
    job.one_to_one = arrays_[a].one_to_one;
    array.job = slurm::submit(job);
    submissions_.write(submission_);  // at once: whoever asks later has to find the job
  }
  std::printf("submitted %s: %zu arrays, jobs", submission_.run.c_str(), submission_.arrays.size());
  for (const std::string& job : submission_.jobs()) std::printf(" %s", job.c_str());
  std::printf("\n  ballflow status %s --store %s\n", submission_.run.c_str(),
              shell_word(arguments_.store).c_str());
}

bool Submitter::watch_round() {
  const std::atomic<bool>& stop = cancel_on_signals();
  const std::vector<std::string> jobs = submission_.jobs();
  std::size_t units = 0;
  for (const SubmittedArray& array : submission_.arrays) units += array.units;
  std::string told;
  while (!stop) {
    const slurm::Tasks tasks = slurm::tasks(jobs);
    if (tasks.held + tasks.hopeless > 0) slurm::release(jobs);
    const std::string line = std::to_string(tasks.running) + " running, " + std::to_string(tasks.pending) +
                             " waiting, " +
                             std::to_string(units - std::min(units, tasks.active() + tasks.held)) + " of " +
                             std::to_string(units) + " units ended";
    if (line != told) std::fprintf(stderr, "%s\n", line.c_str());
    told = line;
    if (tasks.active() + tasks.held == 0) return true;
    // More seldom for many tasks: the answer of the scheduler is a line for each.
    const auto pause = std::chrono::milliseconds(1000 + units / 5);
    for (auto waited = pause * 0; waited < pause && !stop; waited += std::chrono::milliseconds(100))
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

void Submitter::learn_from(const Submission& submission, bool give_up_failed) {
  const std::string folder = submissions_.folder(submission.run);
  const std::map<std::string, std::string> ends = slurm::ends(submission.jobs());
  grown_ = submission.grown;
  gets_more_ = false;
  for (std::size_t a = 0; a < submission.arrays.size(); ++a) {
    for (std::size_t u = 0; u < submission.arrays[a].units; ++u) {
      const std::string unit = unit_name(a, u);
      const auto status = read_status(folder, unit);
      if (status) {
        for (const NodeState& node : status->nodes) {
          if (!give_up_failed || node.status != "failed") continue;
          const auto found = index_.find(node.path);
          if (found == index_.end() || given_up_[found->second]) continue;
          given_up_[found->second] = true;
          failed_.push_back(node);
        }
      }
      // It was killed, or it ended early because its time was nearly over.
      const double limit = 60.0 * submission.arrays[a].minutes;
      const bool ended = status && status->exit_code != static_cast<int>(ExitCode::cancelled);
      if (ended) continue;
      const std::string log = log_tail(folder, unit, 20);
      const auto says = [&log](const char* words) { return log.find(words) != std::string::npos; };
      const auto end = ends.find(submission.arrays[a].job + '_' + std::to_string(u));
      const auto is = [&](const char* state) { return end != ends.end() && end->second == state; };
      // Where Slurm kills by its own polling (OverMemoryKill) the state is FAILED, and the log alone says
      // why.
      const bool memory = is("OUT_OF_MEMORY") || says("exceeded memory limit") || says("oom-kill") ||
                          says("oom_kill") || says("Out Of Memory");
      const bool time = is("TIMEOUT") || says("DUE TO TIME LIMIT") ||
                        (status && (status->out_of_time || status->seconds > limit - 90));
      // A node that ends the process takes its unit with it: next time each piece runs alone.
      const bool died = !memory && !time && !status && !log.empty() && !says("CANCELLED AT") &&
                        !says("ballflow: error");  // it has told what was wrong itself
      if (!memory && !time && !died) continue;
      const Unit lost = submissions_.unit(submission.run, unit, registry_);
      for (const DagNode& node : lost.nodes) {
        const auto found = index_.find(node.path);
        if (found == index_.end() || !has_to_run(plans_[found->second])) continue;
        if (died) {
          gets_more_ = gets_more_ || (lost.nodes.size() > 1 && !alone_[found->second]);
          alone_[found->second] = true;
          continue;
        }
        Growth& growth = grown_[node.path];
        if (memory) growth.memory *= 2;
        if (time) growth.time *= 2;
        gets_more_ = true;
      }
    }
  }
}

}  // namespace ballflow::cli
