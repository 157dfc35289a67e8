// What "ballflow submit" does in rounds: plan, pack, hand to the cluster, and look at what came of it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cluster/slurm.hpp"
#include "cluster/submission.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {

struct SubmitArguments {
  GraphArguments graph;
  std::uint64_t seed = 0;
  std::string to = "slurm", store, out;
  double unit_seconds = 300, patience = 60;
  unsigned threads = 1;
  int minutes = 60;  // for units with nodes that never ran
  std::vector<std::string> more;
  bool dry_run = false, watch = false;
};

/// Runs nodes of `dag` on the cluster; results go to the store alone.
class Submitter {
 public:
  Submitter(const Common& common, const SubmitArguments& arguments, const Registry& registry, const Dag& dag,
            std::shared_ptr<Store> store);

  /// Looks at the store. False when every node that is wanted is done, or fails.
  bool plan_round();
  /// Plans units of what is missing, within the limits of the cluster, and prints them.
  void pack_round(const slurm::Limits& limits);
  /// Writes the units and submits them.
  void submit_round();
  /// Watches the jobs of an earlier submission.
  void follow(const Submission& submission) { submission_ = submission; }
  /// Waits until no job is left. False when the user has had enough; the jobs go on.
  bool watch_round();
  /// What has ended in vain and why: nodes that ran out of something get more, nodes that failed are given
  /// up.
  void learn_from(const Submission& submission, bool give_up_failed);

  /// Writes the files of the units into `folder`/units.
  void write_units(const std::string& folder);
  /// The shell words that run a unit, but for its --unit.
  std::string unit_command() const;
  const std::vector<UnitArray>& arrays() const { return arrays_; }
  std::size_t done() const { return done_; }
  std::size_t to_run() const { return to_run_; }
  const Submission& current() const { return submission_; }
  /// Whether what comes next has more memory or time than the round before.
  bool gets_more() const { return gets_more_; }
  const std::vector<NodeState>& failed() const { return failed_; }
  const Submissions& submissions() const { return submissions_; }
  /// Of the same graph, parameters and seed.
  const std::string& same() const { return same_; }

 private:
  void give_artifacts();

  const Common& common_;
  const SubmitArguments& arguments_;
  const Registry& registry_;
  const Dag& dag_;
  std::shared_ptr<Store> store_;
  Submissions submissions_;
  std::string same_;
  std::map<std::string, std::size_t> index_;  // of nodes, by path
  std::vector<NodePlan> plans_;
  std::vector<UnitArray> arrays_;
  Submission submission_;
  std::map<std::string, Growth> grown_;
  std::vector<bool> given_up_;  // by node: it fails, or needs one that does
  std::vector<NodeState> failed_;
  std::optional<std::map<std::string, double>> usual_seconds_;  // by node type; once they are needed
  std::vector<bool> alone_;  // by node: the process that ran its unit ended, and nobody knows by which node
  bool gets_more_ = false;
  std::size_t done_ = 0, to_run_ = 0;
};

/// Writes the units of a graph and a Snakefile that runs them into a folder. Returns the exit code.
int export_snakemake(Common& common, const SubmitArguments& arguments, const std::string& folder);

}  // namespace ballflow::cli
