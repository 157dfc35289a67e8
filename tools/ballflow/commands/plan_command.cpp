#include <algorithm>
#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

struct PlanArguments {
  GraphArguments graph;
  std::uint64_t seed = 0;
};

int show_plan(const Common& common, const PlanArguments& arguments) {
  const auto registry = common.registry();
  const Dag dag = arguments.graph.load(common, *registry);
  const auto store = common.shared_store();
  const std::vector<NodePlan> plans =
      plan(dag, *store, arguments.seed, latest_manifests(*store, arguments.graph.file()));
  std::vector<std::vector<std::string>> rows = {{"node", "", "seconds", "memory", "why"}};
  double run_seconds = 0, maybe_seconds = 0, hit_seconds = 0;
  std::uint64_t memory = 0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    using Verdict = NodePlan::Verdict;
    const NodePlan& plan = plans[i];
    const double seconds = plan.seconds.value_or(0);
    std::string time, room, why = plan.reason;
    if (plan.verdict == Verdict::hit) {
      hit_seconds += seconds;
    } else if (plan.verdict != Verdict::unneeded) {
      const bool sure = plan.verdict == Verdict::run;
      (sure ? run_seconds : maybe_seconds) += seconds;
      time = plan.seconds ? "~" + duration(seconds) : "?";
      if (plan.seconds) why += " [time: " + plan.seconds_from + "]";
      if (!plan.seconds) ++unknown;
      if (plan.memory != 0) room = grouped(static_cast<std::int64_t>(plan.memory >> 20)) + " MB";
      memory = std::max(memory, plan.memory);
    }
    rows.push_back({dag.nodes[i].path, std::string(to_string(plan.verdict)), time, room, why});
  }
  print_table(rows);
  std::string total = "~" + duration(run_seconds) + " to compute, perhaps ~" + duration(maybe_seconds) +
                      " more; the cache saves " + duration(hit_seconds);
  if (unknown != 0)
    total += "; " + std::to_string(unknown) + (unknown == 1 ? " node" : " nodes") + " never ran";
  if (memory != 0)
    total +=
        "; up to " + grouped(static_cast<std::int64_t>(memory >> 20)) + " MB for one node by its estimate";
  std::printf("\n%s\n", total.c_str());
  tell_upstream(*store);
  return 0;
}

int check(const Common& common, const GraphArguments& arguments) {
  const auto registry = common.registry();
  const Dag dag = arguments.load(common, *registry);
  const auto counted = [](std::size_t n, const char* thing) {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
  };
  const std::string variants = dag.variants.empty() ? "" : counted(dag.variants.size(), "variant") + " with ";
  std::printf("%s: %s%s, %s, no errors\n", printable(arguments.graph).c_str(), variants.c_str(),
              counted(dag.nodes.size(), "node").c_str(), counted(dag.outputs.size(), "output").c_str());
  return 0;
}

}  // namespace

void add_plan(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("plan", "say what a run would take from the cache, what it would run, and why");
  const auto arguments = std::make_shared<PlanArguments>();
  arguments->graph.add_to(command);
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  add_upstream_options(command, common);
  command.option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return show_plan(common, *arguments); };
  });
}

void add_check(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("check", "check a graph without running it; reports all errors at once");
  const auto arguments = std::make_shared<GraphArguments>();
  arguments->add_to(command);
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return check(common, *arguments); }; });
}

}  // namespace ballflow::cli
