#include "commands/submit_command.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "ballflow/text.hpp"
#include "cluster/slurm.hpp"
#include "commands/run_command.hpp"

namespace ballflow::cli {
namespace {

constexpr int most_rounds = 6;

/// Outputs, records and pages are those of a run on this machine, which finds everything in the store.
int write_results(const Common& common, const SubmitArguments& arguments) {
  RunArguments run;
  run.graph = arguments.graph;
  run.settings.seed = arguments.seed;
  run.settings.keep_going = true;
  run.out = arguments.out;
  return run_graph(common, run);
}

Error nothing_came_of(const Submitter& submitter, const std::string& store) {
  constexpr std::uintmax_t little = 16u << 20;  // bytes
  const std::string& run = submitter.current().run;
  std::error_code failed;
  const std::filesystem::space_info disk = std::filesystem::space(store, failed);
  if (!failed && disk.available < little) {
    return {ExitCode::store, "nothing came of the jobs of " + run + ": No space left on the disk of " + store,
            "make room there, then submit the same again"};
  }
  return {ExitCode::store, "nothing came of the jobs of " + run,
          "see what they printed in " + submitter.submissions().folder(run) + "/log"};
}

int submit(Common& common, const SubmitArguments& arguments) {
  common.upstream = arguments.store;
  const auto registry = common.registry();
  const Dag dag = arguments.graph.load(common, *registry);
  const auto store = common.shared_store();
  Submitter submitter(common, arguments, *registry, dag, store);
  // Jobs of an earlier submission may be at it: they are freed where they are held, and waited for.
  const auto before = submitter.submissions().latest_of(submitter.same());
  if (before && !before->jobs().empty() && !arguments.dry_run) {
    slurm::release(before->jobs());
    if (const slurm::Tasks tasks = slurm::tasks(before->jobs()); tasks.active() > 0 && !arguments.watch) {
      std::printf(
          "run %s is still going: %zu units run, %zu wait; \"ballflow status %s --store %s\" says more\n",
          before->run.c_str(), tasks.running, tasks.pending, before->run.c_str(),
          shell_word(arguments.store).c_str());
      return 0;
    } else if (tasks.active() > 0) {
      submitter.follow(*before);
      if (!submitter.watch_round()) return static_cast<int>(ExitCode::cancelled);
    }
  }
  bool missing = submitter.plan_round();
  if (missing && before) submitter.learn_from(*before, false);
  for (int round = 0; missing && round < most_rounds; ++round) {
    submitter.pack_round(slurm::limits());
    if (arguments.dry_run) return 0;
    const std::size_t done = submitter.done();
    submitter.submit_round();
    if (!arguments.watch) return 0;
    if (!submitter.watch_round()) {
      std::fprintf(stderr, "the jobs go on; submit the same again to see what is missing\n");
      return static_cast<int>(ExitCode::cancelled);
    }
    missing = submitter.plan_round();
    const std::size_t failed = submitter.failed().size();
    submitter.learn_from(submitter.current(), true);
    missing = submitter.plan_round();
    if (missing && submitter.done() == done && submitter.failed().size() == failed &&
        !submitter.gets_more()) {
      throw nothing_came_of(submitter, arguments.store);
    }
  }
  for (const NodeState& node : submitter.failed()) std::fprintf(stderr, "\n%s", node.text.c_str());
  if (missing) {
    throw Error(ExitCode::store,
                std::to_string(submitter.to_run()) + " nodes are still missing after " +
                    std::to_string(most_rounds) + " rounds",
                "submit the same again to go on");
  }
  if (!submitter.failed().empty()) {
    std::fprintf(stderr, "\n%zu nodes failed; everything that does not need them is done\n",
                 submitter.failed().size());
    return static_cast<int>(ExitCode::node_failed);
  }
  std::printf("nothing to submit: %zu nodes are done\n", submitter.done());
  if (arguments.dry_run || arguments.out.empty()) return 0;
  return write_results(common, arguments);
}

struct RunOfStore {
  std::string run = "latest", store;
};

std::string store_of(const RunOfStore& arguments) {
  const char* const variable = std::getenv("BALLFLOW_UPSTREAM");
  if (!arguments.store.empty()) return arguments.store;
  if (variable != nullptr) return variable;
  throw Error(ExitCode::usage, "which store?",
              "name the one of the submission with --store or $BALLFLOW_UPSTREAM");
}

int status(const RunOfStore& arguments) {
  const Submissions submissions(store_of(arguments));
  const Submission run = submissions.read(arguments.run);
  const std::string folder = submissions.folder(run.run);
  std::map<std::string, std::size_t> good, bad;
  std::vector<std::pair<std::string, NodeState>> failures;
  std::size_t units = 0, ended = 0, killed = 0, begun = 0, begun_done = 0, begun_nodes = 0;
  std::vector<std::string> silent;
  for (std::size_t a = 0; a < run.arrays.size(); ++a) {
    units += run.arrays[a].units;
    for (std::size_t u = 0; u < run.arrays[a].units; ++u) {
      auto state = read_status(folder, unit_name(a, u));
      const bool at_its_end = state.has_value();
      if (!at_its_end) {
        if (!log_tail(folder, unit_name(a, u), 1).empty()) silent.push_back(unit_name(a, u));
        state = read_progress(folder, unit_name(a, u));
        if (!state) continue;
        ++begun;
        begun_nodes += state->of;
      } else {
        ++ended;
      }
      for (const NodeState& node : state->nodes) {
        const bool done = node.status == "run" || node.status == "hit";
        ++(done ? good : bad)[node.type];
        if (done && !at_its_end) ++begun_done;
        // What is printed of a failure, its unit writes at the end.
        if (node.status == "failed" && at_its_end) failures.emplace_back(unit_name(a, u), node);
      }
    }
  }
  std::printf("%s\n%s\nin %s\n\n", run.run.c_str(), printable(run.command).c_str(),
              printable(run.folder).c_str());
  std::vector<std::vector<std::string>> rows = {{"type", "", "done", "of", "not"}};
  for (const auto& [type, count] : run.types) {
    constexpr std::size_t width = 30;
    const std::size_t full = width * good[type] / std::max<std::size_t>(count, 1);
    rows.push_back({type, std::string(full, '#') + std::string(width - std::min(width, full), '.'),
                    grouped(static_cast<std::int64_t>(good[type])), grouped(static_cast<std::int64_t>(count)),
                    bad[type] == 0 ? "" : grouped(static_cast<std::int64_t>(bad[type]))});
  }
  print_table(rows);
  std::string going;
  try {
    const slurm::Tasks tasks = slurm::tasks(run.jobs());
    if (tasks.active() == 0) killed = units - ended;
    going = ", " + std::to_string(tasks.running) + " running, " + std::to_string(tasks.pending) + " waiting";
    if (tasks.held + tasks.hopeless > 0)
      going +=
          ", " + std::to_string(tasks.held + tasks.hopeless) + " held: submit the same again to free them";
  } catch (const Error& error) {
    going = "; " + std::string(error.what());
  }
  std::printf("\n%zu of %zu units ended%s\n", ended, units, going.c_str());
  if (begun > 0) {
    std::printf("%s of %s nodes are done in %zu %s not ended\n",
                grouped(static_cast<std::int64_t>(begun_done)).c_str(),
                grouped(static_cast<std::int64_t>(begun_nodes)).c_str(), begun,
                begun == 1 ? "unit that has" : "units that have");
  }
  if (killed > 0) {
    std::printf("%zu units ended without a word: killed, cancelled or lost; submit the same again\n", killed);
    for (std::size_t i = 0; i < std::min<std::size_t>(silent.size(), 5); ++i)
      std::printf("\nunit %s, last lines of %s/log/%s.out:\n%s", silent[i].c_str(), folder.c_str(),
                  silent[i].c_str(), log_tail(folder, silent[i], 5).c_str());
  }
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(failures.size(), most); ++i)
    std::printf("\nunit %s: %s", failures[i].first.c_str(), failures[i].second.text.c_str());
  if (failures.size() > most) std::printf("\nand %zu failures more\n", failures.size() - most);
  return failures.empty() ? 0 : static_cast<int>(ExitCode::node_failed);
}

int cancel(const RunOfStore& arguments) {
  const Submission run = Submissions(store_of(arguments)).read(arguments.run);
  slurm::cancel(run.jobs());
  std::printf("cancelled %s; what was finished is in the store\n", run.run.c_str());
  return 0;
}

}  // namespace

void add_submit(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("submit", "run a graph on a cluster; what is in the store is not computed again");
  const auto arguments = std::make_shared<SubmitArguments>();
  arguments->graph.add_to(command);
  command.option("--to", arguments->to, "the scheduler").one_of({"slurm"}).shows_default();
  command
      .option("--store", arguments->store,
              "shared folder of results, an upstream, that every node of the cluster sees")
      .type_name("DIR")
      .required();
  command.option("--out", arguments->out, "folder that receives the outputs, once all is done")
      .type_name("DIR");
  command.flag("--dry-run", arguments->dry_run,
               "show units, arrays, resources and predicted hours; submit nothing");
  command.flag(
      "--watch", arguments->watch,
      "stay until all is done: submit again what was lost, with twice the memory or time where that ran out");
  command
      .option("--unit-seconds", arguments->unit_seconds,
              "put short nodes together until a unit is worth so much")
      .between(0.001, 1e6)
      .shows_default();
  command.option("--threads", arguments->threads, "processors of a unit").between(1, 4096).shows_default();
  command.option("--minutes", arguments->minutes, "time limit of units with nodes that never ran")
      .between(1, 1'000'000)
      .shows_default();
  command
      .option("--patience", arguments->patience,
              "seconds for which jobs look again for what must be in the store")
      .between(0.0, 3600.0)
      .shows_default();
  command
      .option("--sbatch", arguments->more,
              "an option for sbatch, as --sbatch=--partition=long; may be repeated")
      .type_name("OPTION")
      .one_at_a_time();
  command.option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command.option("--cache", common.cache, "cache folder of this machine").type_name("DIR");
  command.footer("Submit the same again to resume: only what is missing is sent. docs/cluster.md says more.");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return submit(common, *arguments); };
  });
}

void add_status(const Command& app, Common&, Action& action) {
  const Command command = app.subcommand("status", "how far a submitted run is, and what failed in it");
  const auto arguments = std::make_shared<RunOfStore>();
  command.option("run", arguments->run, "name of the run or its beginning (default: the latest)")
      .type_name("RUN");
  command.option("--store", arguments->store, "the store of the submission (default: $BALLFLOW_UPSTREAM)")
      .type_name("DIR");
  command.callback([&action, arguments] { action = [arguments] { return status(*arguments); }; });
}

void add_cancel(const Command& app, Common&, Action& action) {
  const Command command =
      app.subcommand("cancel", "cancel the jobs of a submitted run; finished results stay");
  const auto arguments = std::make_shared<RunOfStore>();
  command.option("run", arguments->run, "name of the run or its beginning").type_name("RUN").required();
  command.option("--store", arguments->store, "the store of the submission (default: $BALLFLOW_UPSTREAM)")
      .type_name("DIR");
  command.callback([&action, arguments] { action = [arguments] { return cancel(*arguments); }; });
}

}  // namespace ballflow::cli
