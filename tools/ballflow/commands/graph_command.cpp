#include <cstdio>

#include "ballflow/dot.hpp"
#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/shipped_graphs.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/viewer_page.hpp"
#include "show/page/page.hpp"

namespace ballflow::cli {
namespace {

struct DrawArguments {
  GraphArguments graph;
  std::uint64_t seed = 0;
  bool status = false, list = false, json = false;
  std::string html;
};

/// The graphs that come with ballflow.
int list_graphs(bool json) {
  const std::vector<ShippedGraph> graphs = shipped_graphs();
  if (json) {
    Json list = Json::array();
    for (const ShippedGraph& graph : graphs)
      list.push_back({{"name", graph.name}, {"doc", graph.doc}, {"file", graph.file}});
    std::printf("%s\n", list.dump(1, ' ', false, Json::error_handler_t::replace).c_str());
    return 0;
  }
  std::vector<std::vector<std::string>> rows;
  for (const ShippedGraph& graph : graphs) rows.push_back({graph.name, graph.doc});
  print_table(rows);
  return 0;
}

int draw(const Common& common, const DrawArguments& arguments) {
  if (arguments.list) return list_graphs(arguments.json);
  if (arguments.json) throw Error(ExitCode::usage, "--json goes with --list", "a graph file is JSON itself");
  if (arguments.graph.graph.empty())
    throw Error(ExitCode::usage, "no graph was named", "--list lists those that come with ballflow");
  const std::string page_template = arguments.html.empty() ? "" : viewer_template(common);
  common.places->writes("--html", arguments.html);
  const auto registry = common.registry();
  const Dag dag = arguments.graph.load(common, *registry);
  std::vector<NodePlan> plans;
  if (arguments.status) {
    const auto store = common.store();
    plans = plan(dag, *store, arguments.seed, latest_manifests(*store, arguments.graph.file()));
  }
  if (arguments.html.empty()) {
    std::fputs(dot(dag, plans).c_str(), stdout);
    return 0;
  }
  show::Page page(*registry, show::default_page_bytes);
  page.add_graph(dag, plans);
  write_atomically(arguments.html, page.html(page_template, BALLFLOW_VERSION));
  std::printf("wrote %s (%zu nodes)\n", printable(arguments.html).c_str(), dag.nodes.size());
  return 0;
}

}  // namespace

void add_graph(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "graph",
      "draw the expanded graph, as text for Graphviz (DOT) or as a page; list those that come with ballflow");
  const auto arguments = std::make_shared<DrawArguments>();
  arguments->graph.add_to(command);
  command.find("graph").required(false);
  command
      .flag("--list", arguments->list, "list the graphs that come with ballflow: names, and what they make")
      .excludes(command.find("graph"));
  command.flag("--json", arguments->json, "with --list: a JSON list of name, doc and file");
  command.flag("--status", arguments->status, "show what a run would take from the cache (HIT) or run");
  command
      .option("--html", arguments->html,
              "write a page instead: nodes that can be clicked, with their parameters")
      .type_name("PAGE.html");
  command.option("--cache", common.cache, "cache folder, for --status").type_name("DIR");
  command.option("--seed", arguments->seed, "seed of the nodes that use random numbers, for --status");
  command.footer("  ballflow graph medial_axis | dot -Tsvg > medial_axis.svg");
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return draw(common, *arguments); }; });
}

}  // namespace ballflow::cli
