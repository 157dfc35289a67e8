#include "commands/failure.hpp"

#include <algorithm>
#include <cstdlib>

#include "ballflow/text.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

/// The call as the run recorded it, else, when the node failed before it ran, what it would have got.
FailedCall call_of(const Dag& dag, const RunResult& result, std::size_t i) {
  if (result.nodes[i].failed_call) return *result.nodes[i].failed_call;
  FailedCall call{&dag.nodes[i], {}};
  for (const auto& [port, edge] : dag.nodes[i].inputs) {
    for (const OutputEntry& entry : result.nodes[edge.node].outputs) {
      if (entry.port == edge.port) call.inputs[port] = entry;
    }
  }
  return call;
}

/// The options that make the same libraries and the same cache available, whatever the environment says then.
std::string surroundings(const FailedRun& run, const FailedCall& call) {
  std::string options;
  if (run.common.no_cache) {
    options += " --no-cache";
  } else if (!run.common.cache.empty() || std::getenv("BALLFLOW_CACHE") != nullptr) {
    options += " --cache " + shell_word(run.store.root());
  }
  if (!run.common.upstream.empty()) options += " --upstream " + shell_word(run.common.upstream);
  if (run.seed != 0 && call.node->kind.uses_seed()) options += " --seed " + std::to_string(run.seed);
  return options;
}

std::string plugins(const Registry& registry) {
  std::string options;
  const std::string own = Registry::default_folder() + "/";
  for (const PluginCandidate& candidate : registry.candidates()) {
    if (candidate.refused.empty() && candidate.path.rfind(own, 0) != 0)
      options += " --plugin " + shell_word(candidate.path);
  }
  return options;
}

std::string set(const std::string& name, const Json& value) {
  return " --set " + shell_word(name + "=" + plain(value));
}

/// --set of nodes inside a loop, by their names inside it.
std::string inner_settings(const FailedRun& run, const DagNode& loop) {
  std::string options;
  const std::string inside = base_path(loop.path) + "/";  // not the variant of a sweep
  for (const Setting& given : run.settings) {
    std::string name = given.name;
    std::replace(name.begin(), name.end(), '.', '/');
    if (name.rfind(inside, 0) != 0) continue;
    name = name.substr(inside.size());
    const std::size_t param = name.rfind('/');
    if (param == std::string::npos) continue;  // a parameter of the body
    options += set(name.substr(0, param) + "." + name.substr(param + 1), given.value);
  }
  return options;
}

std::string exec_node_line(const FailedRun& run, const FailedCall& call) {
  const DagNode& node = *call.node;
  std::string line =
      shell_word(run.common.program) + plugins(run.registry) + " exec-node " + node.kind.type();
  const Loop* const loop = node.kind.loop();
  if (loop != nullptr) line += " --body " + shell_word(loop->body.file);
  line += surroundings(run, call);
  for (const ParamDecl& param : node.kind.params()) {
    const Json& value = node.params.at(param.name);
    if (param.required || value != param.default_value) line += set(param.name, value);
  }
  if (loop != nullptr) {
    for (const auto& [name, value] : loop->body.params) line += set(name, value);
    line += inner_settings(run, node);
  }
  for (const auto& [port, entry] : call.inputs)
    line += " --input " + shell_word(port + "=" + entry.digest.hex());
  return line;
}

}  // namespace

std::string failure_text(const FailedRun& run, const RunResult& result, std::size_t i) {
  const DagNode& node = run.dag.nodes[i];
  const NodeResult& failed = result.nodes[i];
  const FailedCall call = call_of(run.dag, result, i);
  std::string text =
      "node " + node.path + " (" + node.kind.type() + ") failed: " + printable(failed.cause) + "\n";
  if (!failed.hint.empty()) text += "  what to do: " + printable(failed.hint) + "\n";
  const bool inside = call.node != &node;
  if (inside) text += "  in it: " + call.node->path + " (" + call.node->kind.type() + ")\n";
  for (const auto& [name, value] : call.node->params)
    text += "  param " + name + " = " + printable(plain(value)) + "\n";
  std::string missing;
  for (const auto& [port, entry] : call.inputs) {
    text += "  input " + port + " = ";
    const auto edge = node.inputs.find(port);
    if (!inside && edge != node.inputs.end())
      text += run.dag.nodes[edge->second.node].path + "." + edge->second.port + ", ";
    text += printable(describe(entry)) + ", sha256 " + entry.digest.hex() + "\n";
    if (missing.empty() && !run.store.has_blob(entry)) missing = port;
  }
  if (missing.empty()) return text + "  this node alone: " + exec_node_line(run, call) + "\n";
  const std::string why = run.common.no_cache            ? "--no-cache"
                          : !run.store.trouble().empty() ? run.store.trouble()
                                                         : run.store.why();
  return text + "  it cannot be run alone: its input " + missing + " is not stored" +
         (why.empty() ? "" : " (" + printable(why) + ")") + "\n";
}

}  // namespace ballflow::cli
