#include <cstdio>

#include "ballflow/schema.hpp"
#include "ballflow/shipped_graphs.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {
namespace {

struct NodesArguments {
  std::string describe;
  std::string graphs;
  bool schema = false, graph_schema = false, markdown = false;
};

std::string range(const ParamDecl& param) {
  std::string text;
  const auto add = [&text](const char* relation, const std::optional<double>& bound) {
    if (!bound) return;
    text += (text.empty() ? "" : ", ") + std::string(relation) + " " + Json(*bound).dump();
  };
  add(">=", param.minimum);
  add(">", param.exclusive_minimum);
  add("<=", param.maximum);
  add("<", param.exclusive_maximum);
  return text;
}

void describe_node(const Registry& registry, const NodeDeclaration& node) {
  std::printf("%s (behaviour version %d)\n  %s\n", node.id.c_str(), node.version, node.summary.c_str());
  if (!node.doc.empty()) std::printf("\n%s\n", node.doc.c_str());
  if (!node.avoid_when.empty()) std::printf("\nWhen not to use it: %s\n", node.avoid_when.c_str());
  const auto ports = [&registry](const char* title, const std::vector<PortDecl>& list) {
    if (list.empty()) return;
    std::printf("\n%s\n", title);
    for (const PortDecl& port : list) {
      std::printf("  %s: %s%s%s\n      %s\n", port.name.c_str(), port.type.c_str(),
                  port.list ? ", several in order" : "", port.optional ? ", optional" : "", port.doc.c_str());
      const TypeDeclaration* type = registry.type(port.type);
      if (type == nullptr) continue;
      std::string fields;
      for (const auto& [field, doc] : type->summary) fields += (fields.empty() ? "" : ", ") + field;
      if (!fields.empty()) std::printf("      summary: %s\n", fields.c_str());
    }
  };
  ports("Inputs", node.inputs);
  ports("Outputs", node.outputs);
  if (!node.params.empty()) std::printf("\nParameters\n");
  for (const ParamDecl& param : node.params) {
    std::printf("  %s = %s", param.name.c_str(),
                param.required ? "(required)" : plain(param.default_value).c_str());
    if (!param.unit.empty()) std::printf("  [%s]", param.unit.c_str());
    if (const std::string bounds = range(param); !bounds.empty()) std::printf("  %s", bounds.c_str());
    std::printf("\n      %s\n", param.doc.c_str());
    for (const auto& [value, doc] : param.choices) std::printf("      %s: %s\n", value.c_str(), doc.c_str());
  }
  if (!node.cites.empty()) std::printf("\nSources\n");
  for (const Citation& citation : node.cites)
    std::printf("  %s, %s\n", citation.key.c_str(), citation.where.c_str());
  std::printf("\nFrom %s\n", node.plugin_path.c_str());
}

int show_nodes(const Common& common, const NodesArguments& arguments) {
  const auto registry = common.registry();
  if (arguments.schema) {
    std::printf("%s\n", nodes_schema(*registry).dump(2).c_str());
  } else if (arguments.graph_schema) {
    std::printf("%s\n", graph_schema(*registry).dump(2).c_str());
  } else if (arguments.markdown) {
    const std::string graphs = arguments.graphs.empty() ? shipped_graphs_folder() : arguments.graphs;
    std::printf("%s", nodes_markdown(*registry, find_examples(graphs, *registry)).c_str());
  } else if (!arguments.describe.empty()) {
    const NodeDeclaration* node = registry->node(arguments.describe);
    if (node == nullptr) {
      std::vector<std::string> names;
      for (const auto& [id, declaration] : registry->nodes().unparsed()) names.push_back(id);
      const std::string near = nearest(arguments.describe, names);
      throw Error(ExitCode::usage, "there is no node type \"" + arguments.describe + "\"",
                  near.empty() ? "\"ballflow nodes\" lists them" : "did you mean \"" + near + "\"?");
    }
    describe_node(*registry, *node);
  } else {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [id, node] : registry->nodes()) rows.push_back({id, node.summary});
    print_table(rows);
    for (const PluginCandidate& candidate : registry->candidates()) {
      if (!candidate.refused.empty()) {
        std::fprintf(stderr, "not loaded: %s: %s\n", candidate.path.c_str(), candidate.refused.c_str());
      }
    }
  }
  return 0;
}

}  // namespace

void add_nodes(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand("nodes", "list the node types, or describe one");
  const auto arguments = std::make_shared<NodesArguments>();
  command
      .option("type", arguments->describe,
              "describe this node type: ports, parameters, units, ranges, sources")
      .type_name("TYPE");
  command.flag("--schema", arguments->schema, "print the JSON schema of all node types");
  command.flag("--graph-schema", arguments->graph_schema, "print the JSON schema of graph files");
  command.flag("--markdown", arguments->markdown, "print the documentation of all node types");
  command
      .option("--graphs", arguments->graphs,
              "folder of the graphs that examples are taken from (default: the installed ones)")
      .type_name("DIR");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return show_nodes(common, *arguments); };
  });
}

}  // namespace ballflow::cli
