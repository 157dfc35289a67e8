#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/report.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/failure.hpp"
#include "export/export.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

struct ExecNodeArguments {
  std::string type, body, unit;
  double patience = 60;
  std::vector<std::string> inputs, sets, outputs;
  unsigned threads = 0;
  std::uint64_t seed = 0;
  bool json = false;
};

/// Artifacts come from the cache or from anybody's file; nodes trust what they get.
std::map<std::string, ArtifactPtr> read_inputs(const Common& common, const Registry& registry,
                                               const std::shared_ptr<Store>& store,
                                               const ExecNodeArguments& arguments) {
  std::map<std::string, ArtifactPtr> inputs;
  for (const std::string& input : arguments.inputs) {
    const auto [port, name] = split_setting("--input", input, "balls=DIGEST");
    ArtifactPtr artifact = find_artifact(common, name, store);
    if (const TypeDeclaration* type = registry.type(artifact->type())) {
      const std::string broken = check_artifact(*type, *artifact);
      if (!broken.empty())
        throw Error(ExitCode::usage, "--input " + input + ": no valid " + type->id + ": " + broken);
    }
    if (!inputs.emplace(port, std::move(artifact)).second)
      throw Error(ExitCode::usage, "--input " + input + ": " + port + " has an artifact already");
  }
  return inputs;
}

/// The name of the node in the graph that is made for it: "acme.Offset" -> "Offset".
std::string node_name(const std::string& type) { return type.substr(type.rfind('.') + 1); }

/// The name of the input of that graph: "clouds[1]" -> "clouds_1".
std::string input_name(const std::string& slot) {
  std::string name = slot;
  std::replace(name.begin(), name.end(), '[', '_');
  std::erase(name, ']');
  return name;
}

/// A graph with one node, whose inputs are those of the graph.
std::string graph_text(const Registry& registry, const ExecNodeArguments& arguments,
                       const std::map<std::string, ArtifactPtr>& inputs) {
  Json node = Json::object();
  if (arguments.type == "loop") {
    node["loop"] = arguments.body;
    for (const std::string& set : arguments.sets) {  // a graph has to write "until" down
      const auto [name, value] = split_setting("--set", set, "epsilon=0.5");
      if (name == "until") node["until"] = value;
    }
  } else {
    node["type"] = arguments.type;
  }
  Json graph = {{"inputs", Json::object()}, {"nodes", Json::object()}};
  for (const auto& [slot, artifact] : inputs) {
    const std::string port(port_of_slot(slot));
    if (registry.type(artifact->type()) == nullptr) {
      throw Error(ExitCode::usage,
                  "input " + port + " is a " + artifact->type() + ", a type that no node library declares",
                  "name the library with --plugin");
    }
    graph["inputs"][input_name(slot)] = {{"type", artifact->type()}};
    if (slot == port) node["inputs"][port] = "inputs." + port;
  }
  // Of a list: in order, and without gaps.
  for (const auto& [slot, artifact] : inputs) {
    const std::string port(port_of_slot(slot));
    if (slot == port || node["inputs"].contains(port)) continue;
    node["inputs"][port] = Json::array();
    for (std::size_t i = 0; inputs.contains(list_slot(port, i)); ++i)
      node["inputs"][port].push_back("inputs." + input_name(list_slot(port, i)));
  }
  graph["nodes"][node_name(arguments.type)] = std::move(node);
  return graph.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<Setting> settings(const ExecNodeArguments& arguments) {
  std::vector<Setting> result;
  const std::string node = node_name(arguments.type);
  for (const std::string& set : arguments.sets) {
    auto [name, value] = split_setting("--set", set, "epsilon=0.5");
    const bool inner = name.find_first_of("./") != std::string::npos;  // a node in the body of a loop
    result.push_back({node + (inner ? "/" : ".") + name, std::move(value)});
  }
  return result;
}

/// The DAG of that graph; all outputs of the node are wanted. Nobody wrote the text of the graph, so messages
/// do not show places in it.
Dag node_dag(const Registry& registry, const ExecNodeArguments& arguments,
             const std::vector<Setting>& settings, const std::map<std::string, ArtifactPtr>& inputs) {
  constexpr const char* nowhere = "exec-node";
  try {
    std::map<std::string, ArtifactPtr> given;
    for (const auto& [slot, artifact] : inputs) given.emplace(input_name(slot), artifact);
    Dag dag = parse_graph(graph_text(registry, arguments, inputs), nowhere, registry, settings, {}, given);
    dag.files.erase(dag.files.begin());
    const std::size_t node = dag.nodes.size() - 1;  // behind its inputs
    for (const PortDecl& port : dag.nodes[node].kind.outputs())
      dag.outputs.push_back({port.name, port.doc, {node, port.name}});
    return dag;
  } catch (const GraphError& error) {
    std::vector<Diagnostic> findings = error.findings();
    std::erase_if(findings, [](const Diagnostic& f) { return f.severity == Diagnostic::Severity::warning; });
    for (Diagnostic& finding : findings) {
      if (finding.file != nowhere) continue;
      finding.line = finding.column = 0;
      finding.pointer.clear();
      finding.source_line.clear();
    }
    throw GraphError(std::move(findings));
  }
}

/// What the cache policy would leave out is stored all the same: somebody waits for it.
void keep_outputs(Store& store, const Dag& dag, const RunResult& result, Runner& runner) {
  for (const DagOutput& output : dag.outputs) {
    for (const OutputEntry& entry : result.nodes[output.from.node].outputs) {
      if (entry.port != output.from.port || store.has_blob(entry)) continue;
      if (store.put_blob(*runner.artifact(output.from), true)) continue;
      const std::string why = store.trouble().empty() ? store.why() : store.trouble();
      throw Error(ExitCode::store, "output " + entry.port + " cannot be stored: " + why,
                  "write it to a file with --output " + entry.port + "=FILE, and use --no-cache");
    }
  }
}

void print_outputs(const Dag& dag, const RunResult& result) {
  const NodeResult& node = result.nodes.back();
  std::vector<std::vector<std::string>> rows;
  for (const OutputEntry& output : node.outputs)
    rows.push_back({output.port, describe(output), output.digest.hex()});
  std::printf("%s %s\n", dag.nodes.back().kind.type().c_str(),
              node.status == NodeStatus::hit ? "HIT" : ("RUN " + duration(node.seconds)).c_str());
  print_table(rows);
}

int exec_node(const Common& common, const ExecNodeArguments& arguments) {
  if (arguments.type.empty() == arguments.unit.empty()) {
    throw Error(ExitCode::usage,
                arguments.unit.empty() ? "which node?"
                                       : "a unit has nodes of its own, " + arguments.type + " is one more",
                "name a node type, or the file of a unit with --unit");
  }
  if (!arguments.unit.empty()) return exec_unit(common, arguments.unit, arguments.patience);
  if ((arguments.type == "loop") == arguments.body.empty()) {
    throw Error(ExitCode::usage,
                arguments.body.empty() ? "a loop needs the file of its body" : "only a loop has a body",
                arguments.body.empty() ? "name it with --body" : "");
  }
  const auto registry = common.registry();
  const auto store = common.shared_store();
  const auto inputs = read_inputs(common, *registry, store, arguments);
  const std::vector<Setting> given = settings(arguments);
  const Dag dag = node_dag(*registry, arguments, given, inputs);
  const DagNode& node = dag.nodes.back();

  std::map<std::string, std::string> files;
  for (const std::string& output : arguments.outputs) {
    auto [port, file] = split_setting("--output", output, "balls=balls.ply");
    if (node.kind.output(port) == nullptr)
      throw Error(ExitCode::usage, "--output " + output + ": " + node.kind.type() + " has no output " + port);
    files[port] = std::move(file);
  }
  common.places->reads(dag);
  for (const auto& [port, file] : files) common.places->writes("--output " + port, file);
  if (!common.no_cache && !store->why().empty())
    std::fprintf(stderr, "warning: the cache is not written: %s\n", printable(store->why()).c_str());
  const KeepWithin collect_at_the_end(store, common.cache_limit(*store));

  RunOptions options;
  options.threads = arguments.threads;
  options.seed = arguments.seed;
  options.cancel = &cancel_on_signals();
  const auto display = arguments.json ? no_display() : progress_display(dag, isatty(STDERR_FILENO) != 0);
  Runner runner(dag, *registry, store, options, *display);
  const RunResult& result = runner.run();

  if (arguments.json) {
    std::printf("%s\n", run_report(new_run_id(dag.file), dag, result)
                            .dump(1, ' ', false, Json::error_handler_t::replace)
                            .c_str());
  }
  if (result.status == ExitCode::ok) {
    if (!arguments.json) print_outputs(dag, result);
    for (const DagOutput& output : dag.outputs) {
      if (const auto file = files.find(output.name); file != files.end())
        export_artifact(*runner.artifact(output.from), file->second, "");
    }
    if (!common.no_cache) keep_outputs(*store, dag, result, runner);
  }
  tell_upstream(*store);
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (result.nodes[i].status != NodeStatus::failed) continue;
    std::fprintf(stderr, "%s",
                 failure_text({common, *registry, dag, *store, arguments.seed, given}, result, i).c_str());
  }
  return static_cast<int>(result.status);
}

}  // namespace

void add_exec_node(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "exec-node", "run one node alone, with artifacts as inputs; failing nodes print the command");
  const auto arguments = std::make_shared<ExecNodeArguments>();
  command.option("type", arguments->type, "node type, or \"loop\"").type_name("TYPE");
  command.option("--body", arguments->body, "graph file of the body of a loop").type_name("GRAPH.json");
  command
      .option("--input", arguments->inputs,
              "an input: the digest of an artifact in the cache (6 digits or more), or the file of one")
      .type_name("PORT=ARTIFACT")
      .one_at_a_time();
  command
      .option("--set", arguments->sets,
              "set a parameter of the node; of a loop: a setting, a parameter of its body, or of a node "
              "in it (reduce.steps=3)")
      .type_name("NAME=VALUE")
      .one_at_a_time();
  command
      .option("--output", arguments->outputs,
              "write an output to a file as well; the extension is the format (.safetensors: the artifact)")
      .type_name("PORT=FILE")
      .one_at_a_time();
  command
      .option("--unit", arguments->unit,
              "in place of a type: run the nodes of this file, which \"ballflow submit\" has written")
      .type_name("FILE");
  command.option("--patience", arguments->patience,
                 "seconds for which a unit looks again for inputs that must be in the store");
  command.option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command
      .option("--threads", arguments->threads,
              "number of threads; 0: all cores (the result never depends on it)")
      .between(0, 4096);
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.flag("--no-cache", common.no_cache, "neither read nor write a cache; inputs are files");
  add_upstream_options(command, common);
  command.flag("--json", arguments->json,
               "print a run report (schemas/run_report.schema.json) instead of a table");
  command.footer(
      "Keys, cache and checks are those of a graph with this one node. All outputs are stored, large ones "
      "too.");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return exec_node(common, *arguments); };
  });
}

}  // namespace ballflow::cli
