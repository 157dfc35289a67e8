#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/text.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace ballflow::cli {
namespace {

struct PlanArguments {
  GraphArguments graph;
  std::uint64_t seed = 0;
};

int show_plan(const Common& common, const PlanArguments& arguments) {
  const auto registry = common.registry();
  const Dag dag = load_graph(arguments.graph.file, *registry, arguments.graph.overrides());
  for (const Diagnostic& warning : dag.warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  const auto store = common.store();
  const std::vector<NodePlan> plans =
      plan(dag, *store, arguments.seed, latest_manifests(*store, arguments.graph.file));
  std::vector<std::vector<std::string>> rows = {{"node", "", "why"}};
  for (std::size_t i = 0; i < plans.size(); ++i) {
    using Verdict = NodePlan::Verdict;
    const char* verdict = plans[i].verdict == Verdict::hit     ? "HIT"
                          : plans[i].verdict == Verdict::run   ? "RUN"
                          : plans[i].verdict == Verdict::maybe ? "MAYBE"
                                                               : "-";
    rows.push_back({dag.nodes[i].path, verdict, plans[i].reason});
  }
  print_table(rows);
  return 0;
}

int check(const Common& common, const GraphArguments& arguments) {
  const auto registry = common.registry();
  const Dag dag = load_graph(arguments.file, *registry, arguments.overrides());
  for (const Diagnostic& warning : dag.warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  const auto counted = [](std::size_t n, const char* thing) {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
  };
  std::printf("%s: %s, %s, no errors\n", printable(arguments.file).c_str(),
              counted(dag.nodes.size(), "node").c_str(), counted(dag.outputs.size(), "output").c_str());
  return 0;
}

}  // namespace

void add_plan(CLI::App& app, Common& common, Action& action) {
  CLI::App* command =
      app.add_subcommand("plan", "say what a run would take from the cache, what it would run, and why");
  const auto arguments = std::make_shared<PlanArguments>();
  arguments->graph.add_to(*command);
  command->add_option("--cache", common.cache, "cache folder")->type_name("DIR");
  command->add_option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command->callback([&common, &action, arguments] {
    action = [&common, arguments] { return show_plan(common, *arguments); };
  });
}

void add_check(CLI::App& app, Common& common, Action& action) {
  CLI::App* command =
      app.add_subcommand("check", "check a graph without running it; reports all errors at once");
  const auto arguments = std::make_shared<GraphArguments>();
  arguments->add_to(*command);
  command->callback(
      [&common, &action, arguments] { action = [&common, arguments] { return check(common, *arguments); }; });
}

}  // namespace ballflow::cli
