#include "ballflow/report.hpp"

#include "ballflow/history.hpp"

namespace ballflow {
namespace {

Json outputs_json(const std::vector<OutputEntry>& outputs) {
  Json json = Json::object();
  for (const OutputEntry& output : outputs) {
    Json summary = Json::parse(output.summary, nullptr, false);
    json[output.port] = {{"type", output.type},
                         {"digest", output.digest.hex()},
                         {"bytes", output.bytes},
                         {"summary", summary.is_discarded() ? Json::object() : std::move(summary)}};
  }
  return json;
}

Json interfaces_json(const Dag& dag, const std::vector<DagOutput>& interfaces) {
  Json json = Json::object();
  for (const DagOutput& output : interfaces) {
    json.get_ref<Json::object_t&>().emplace_back(output.name,
                                                 dag.nodes[output.from.node].path + "." + output.from.port);
  }
  return json;
}

/// "skipped": not all of it was computed, since another variant failed or the run was cancelled.
const char* status_of(const Variant& variant, const RunResult& result, const std::vector<bool>& needed) {
  bool complete = true;
  for (const std::size_t i : variant.nodes) {
    const NodeResult& node = result.nodes[i];
    if (node.status == NodeStatus::failed) return "failed";
    const bool there = node.status == NodeStatus::hit || node.status == NodeStatus::run;
    complete = complete && (there || !needed[i]);
  }
  return complete ? "ok" : "skipped";
}

}  // namespace

std::string_view to_string(ExitCode status) {
  switch (status) {
    case ExitCode::ok:
      return "ok";
    case ExitCode::usage:
      return "usage";
    case ExitCode::node_failed:
      return "failed";
    case ExitCode::cancelled:
      return "cancelled";
    case ExitCode::store:
      return "store";
    case ExitCode::plugin:
      return "plugin";
  }
  return "";
}

Json node_report(const DagNode& node, const NodeResult& r) {
  Json json = {{"type", node.kind.type()}, {"status", to_string(r.status)}, {"reason", r.reason},
               {"seconds", r.seconds},     {"cpu_seconds", r.cpu_seconds},  {"cost_seconds", r.cost_seconds}};
  if (r.iterations) json["iterations"] = *r.iterations;
  if (!r.deterministic) json["deterministic"] = false;
  json["params"] = Json::object();
  for (const auto& [name, value] : node.params) json["params"][name] = value;
  json["outputs"] = outputs_json(r.outputs);
  if (!r.warnings.empty()) json["warnings"] = r.warnings;
  if (r.status == NodeStatus::failed) json["error"] = {{"cause", r.cause}, {"hint", r.hint}};
  return json;
}

Json run_report(const std::string& id, const Dag& dag, const RunResult& result) {
  Json report = {{"run", id},
                 {"graph", dag.file},
                 {"status", to_string(result.status)},
                 {"seconds", result.seconds},
                 {"cpu_seconds", result.cpu_seconds},
                 {"peak_rss_bytes", result.peak_rss_bytes}};
  if (std::string start = start_of_run(id); !start.empty()) report["started"] = std::move(start);
  report["params"] = Json::object();
  for (const auto& [name, value] : dag.params) report["params"][name] = value;
  Json nodes = Json::object();
  // Appended unseen, because paths are unique and ordered_json would look for each by linear search.
  auto& members = nodes.get_ref<Json::object_t&>();
  members.reserve(dag.nodes.size());
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const DagNode& node = dag.nodes[i];
    const NodeResult& r = result.nodes[i];
    Json json = node_report(node, r);
    if (!node.inputs.empty()) json["inputs"] = Json::object();
    for (const auto& [port, edge] : node.inputs)
      json["inputs"][port] = dag.nodes[edge.node].path + "." + edge.port;
    if (const Loop* loop = node.kind.loop()) {
      json["body"] = Json::array();
      for (const DagNode& inner : loop->body.nodes) json["body"].push_back(inner.path);
    }
    members.emplace_back(node.path, std::move(json));
  }
  report["nodes"] = std::move(nodes);
  Json outputs = Json::object();
  for (const DagOutput& output : dag.outputs) {
    const NodeResult& r = result.nodes[output.from.node];
    for (const OutputEntry& entry : r.outputs) {
      if (entry.port != output.from.port) continue;
      Json one = outputs_json({entry})[entry.port];
      one["from"] = dag.nodes[output.from.node].path + "." + output.from.port;
      outputs.get_ref<Json::object_t&>().emplace_back(output.name, std::move(one));
    }
  }
  report["outputs"] = std::move(outputs);
  if (dag.variants.empty()) {
    report["subgraphs"] = interfaces_json(dag, dag.interfaces);
    return report;
  }
  report["axes"] = Json::array();
  for (const auto& [name, value] : dag.variants[0].values) report["axes"].push_back(name);
  report["variants"] = Json::array();
  const std::vector<bool> needed = needed_nodes(dag);
  for (const Variant& variant : dag.variants) {
    Json json = {{"name", variant.name}, {"status", status_of(variant, result, needed)}};
    json["params"] = Json::object();
    for (const auto& [name, value] : variant.values) json["params"][name] = value;
    json["nodes"] = Json::array();
    for (const std::size_t node : variant.nodes) json["nodes"].push_back(dag.nodes[node].path);
    json["subgraphs"] = interfaces_json(dag, variant.interfaces);
    report["variants"].push_back(std::move(json));
  }
  return report;
}

}  // namespace ballflow
