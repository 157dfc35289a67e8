#include <cstdio>

#include "ballflow/explain.hpp"
#include "ballflow/history.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {
namespace {

struct ExplainArguments {
  std::string node, against;
  GraphArguments graph;
  std::uint64_t seed = 0;
};

bool inside(const std::string& loop, const std::string& from) {
  return !loop.empty() && from.rfind(loop + "/", 0) == 0;
}

std::string words(const Explanation::Input& input, const std::string& loop) {
  using State = Explanation::Input::State;
  std::string text = "input " + input.port + ": ";
  switch (input.state) {
    case State::same:
      // What flows inside a body has no digest.
      return text + (inside(loop, input.from) ? "from the same port (" : "same content (") + input.from + ")";
    case State::other:
      return text + "other content (" + input.from + ")";
    case State::unknown:
      return text + "not known before " + input.from.substr(0, input.from.rfind('.')) + " has run";
    case State::added:
      return text + "is new (" + input.from + ")";
    case State::removed:
      return text + "is gone";
  }
  return text;
}

void say(const std::string& text) { std::printf("  %s\n", printable(text).c_str()); }

void print(const Explanation& explanation, const std::string& path, const std::string& now,
           const std::string& before) {
  std::printf("%s (%s): %s against run %s\n", printable(path).c_str(), explanation.type.c_str(),
              printable(now).c_str(), printable(before).c_str());
  if (!explanation.ran_before) return say("that run had no such node");
  for (const std::string& difference : explanation.differences) say(difference);
  for (const Explanation::Input& input : explanation.inputs) say(words(input, explanation.loop));
  for (const Explanation::Cause& cause : explanation.causes) {
    std::string text = "because of " + cause.path + ": ";
    for (const std::string& difference : cause.differences)
      text += (&difference == &cause.differences.front() ? "" : "; ") + difference;
    say(text);
  }
  if (!explanation.same()) return;
  say(explanation.loop.empty() ? "nothing differs: the key is the same"
                               : "nothing differs; the loop " + explanation.loop + " is what has a key");
}

/// The run before of the same graph file, which the middle part of an id stands for.
std::string run_before(Store& store, const std::string& id) {
  const auto graph = [](const std::string& run) {
    const std::size_t first = run.find('-');
    return first == std::string::npos ? run : run.substr(first, run.find('-', first + 1) - first);
  };
  for (const RunInfo& run : list_runs(store)) {
    if (run.id < id && graph(run.id) == graph(id)) return run.id;
  }
  throw Error(ExitCode::usage, "run " + id + " is the only one of its graph that is recorded",
              "name another run with --against, or a graph to explain its next run");
}

int explain_node(const Common& common, const ExplainArguments& arguments) {
  const auto store = common.store();
  if (store->root().empty()) {
    throw Error(ExitCode::usage, "there is no cache, so no run is recorded: " + store->why(),
                "name its folder with --cache or $BALLFLOW_CACHE");
  }
  const bool planned = !arguments.graph.graph.empty();
  NodeRecords now;
  std::string now_name = "the next run", latest_id;
  const std::string graph_file = planned ? arguments.graph.file() : std::string();
  if (planned) {
    const auto registry = common.registry();
    const Dag dag = arguments.graph.load(common, *registry);
    now = records_of(dag, plan(dag, *store, arguments.seed, {}));
  } else {
    const RunRecord latest = named_run(common, *store, "latest");
    now = records_of(latest.report, run_manifests(*store, latest.id));
    now_name = "run " + latest.id;
    latest_id = latest.id;
  }
  std::string against = arguments.against;
  if (planned && against.empty()) against = "latest";
  if (!planned && (against.empty() || against == "previous")) against = run_before(*store, latest_id);
  const RunRecord before = named_run(common, *store, against, graph_file);
  const Manifests manifests = run_manifests(*store, before.id);
  if (manifests.empty()) {
    throw Error(ExitCode::usage, "the keys of run " + before.id + " are not in the cache",
                "\"ballflow runs\" lists the runs that are");
  }
  print(explain(records_of(before.report, manifests), now, arguments.node), arguments.node, now_name,
        before.id);
  return 0;
}

}  // namespace

void add_explain(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("explain", "say what makes a node run again, field by field, and what caused it");
  const auto arguments = std::make_shared<ExplainArguments>();
  command.option("node", arguments->node, "path of the node (prune/greedy), also in the body of a loop")
      .required()
      .type_name("NODE");
  arguments->graph.add_to(command);
  command.find("graph").required(false).description(
      "graph file, or the name of a graph that comes with ballflow: explain what its next run would do;\n"
      "default: the latest run that was recorded");
  command
      .option("--against", arguments->against,
              "the run to compare with: latest, previous, an id from \"ballflow runs\", or a report file "
              "(default: the run before)")
      .type_name("RUN");
  command.option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return explain_node(common, *arguments); };
  });
}

}  // namespace ballflow::cli
