#include "show/page/graph_json.hpp"

#include <map>

namespace ballflow::show {
namespace {

using Value = nlohmann::json;

const Value& member(const Value& object, const std::string& name) {
  static const Value null;
  if (!object.is_object()) return null;
  const auto found = object.find(name);
  return found == object.end() ? null : *found;
}

std::string text_at(const Value& object, const std::string& name) {
  const Value& value = member(object, name);
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// An object, also when there is none.
const Value& object_at(const Value& object, const std::string& name) {
  static const Value empty = Value::object();
  const Value& value = member(object, name);
  return value.is_object() ? value : empty;
}

bool is_list_of_texts(const Value& value) {
  if (!value.is_array()) return false;
  for (const Value& element : value) {
    if (!element.is_string()) return false;
  }
  return true;
}

Json output_json(const Value& output) {
  const Value& bytes = member(output, "bytes");
  return {{"type", text_at(output, "type")},
          {"digest", text_at(output, "digest")},
          {"bytes", bytes.is_number_unsigned() ? bytes.get<std::uint64_t>() : 0},
          {"summary", object_at(output, "summary")}};
}

void copy_texts(const Value& from, std::initializer_list<const char*> names, Json& to) {
  for (const char* name : names) {
    if (const Value& value = member(from, name); value.is_string()) to[name] = value;
  }
}

void copy_numbers(const Value& from, std::initializer_list<const char*> names, Json& to) {
  for (const char* name : names) {
    if (const Value& value = member(from, name); value.is_number()) to[name] = value;
  }
}

Json node_json(const std::string& path, const Value& node) {
  Json json = {{"path", path}, {"name", base_path(path)}, {"type", text_at(node, "type")}};
  copy_texts(node, {"status", "reason"}, json);
  copy_numbers(node, {"seconds", "cpu_seconds", "cost_seconds", "iterations"}, json);
  json["params"] = object_at(node, "params");
  json["inputs"] = Json::object();
  for (const auto& [port, from] : object_at(node, "inputs").items()) {
    if (from.is_string()) json["inputs"][port] = from;
  }
  json["outputs"] = Json::object();
  for (const auto& [port, output] : object_at(node, "outputs").items())
    json["outputs"][port] = output_json(output);
  for (const char* list : {"body", "warnings"}) {
    if (const Value& value = member(node, list); is_list_of_texts(value)) json[list] = value;
  }
  if (const Value& error = member(node, "error"); error.is_object()) {
    json["error"] = {{"cause", text_at(error, "cause")}, {"hint", text_at(error, "hint")}};
  }
  return json;
}

Json variant_output(const std::string& name, const Value& output) {
  return {{"name", name},
          {"from", text_at(output, "from")},
          {"digest", text_at(output, "digest")},
          {"type", text_at(output, "type")}};
}

}  // namespace

RunJson run_json(const RunRecord& run, std::size_t number) {
  const Value& report = run.report;
  Json graph = {{"name", text_at(report, "graph")}, {"run", run.id}};
  copy_texts(report, {"started", "status"}, graph);
  copy_numbers(report, {"seconds", "cpu_seconds"}, graph);
  graph["params"] = object_at(report, "params");
  graph["nodes"] = Json::array();
  std::map<std::string, std::size_t> numbers;
  for (const auto& [path, node] : object_at(report, "nodes").items()) {
    numbers[path] = graph["nodes"].size();
    graph["nodes"].push_back(node_json(path, node));
  }
  const Value& outputs = object_at(report, "outputs");
  Json variants = Json::array();
  const Value& listed = member(report, "variants");
  if (!listed.is_array()) {
    Json variant = {{"graph", number}, {"name", ""}, {"values", Json::object()}, {"nodes", Json::array()}};
    for (std::size_t i = 0; i < graph["nodes"].size(); ++i) variant["nodes"].push_back(i);
    variant["outputs"] = Json::array();
    for (const auto& [name, output] : outputs.items())
      variant["outputs"].push_back(variant_output(name, output));
    variants.push_back(std::move(variant));
  } else {
    for (const Value& one : listed) {
      const std::string name = text_at(one, "name");
      Json variant = {
          {"graph", number}, {"name", name}, {"values", Json::object()}, {"nodes", Json::array()}};
      // In the order of the axes, which the parameters have lost.
      const Value& params = object_at(one, "params");
      const Value& axes = member(report, "axes");
      if (is_list_of_texts(axes)) {
        for (const Value& axis : axes)
          variant["values"][axis.get<std::string>()] = member(params, axis.get<std::string>());
      }
      if (const Value& nodes = member(one, "nodes"); is_list_of_texts(nodes)) {
        for (const Value& path : nodes) {
          if (const auto found = numbers.find(path.get<std::string>()); found != numbers.end())
            variant["nodes"].push_back(found->second);
        }
      }
      variant["outputs"] = Json::array();
      // Sorted by name: those of a variant are one after the other.
      const std::string prefix = name + "/";
      const auto& items = outputs.get_ref<const Value::object_t&>();
      for (auto item = items.lower_bound(prefix); item != items.end() && item->first.starts_with(prefix);
           ++item)
        variant["outputs"].push_back(variant_output(item->first.substr(prefix.size()), item->second));
      variants.push_back(std::move(variant));
    }
  }
  return {std::move(graph), std::move(variants)};
}

Json graph_json(const Dag& dag, const std::vector<NodePlan>& plans) {
  Json graph = {{"name", dag.file}, {"doc", dag.doc}, {"params", Json::object()}, {"nodes", Json::array()}};
  for (const auto& [name, value] : dag.params) graph["params"][name] = value;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const DagNode& node = dag.nodes[i];
    Json json = {{"path", node.path}, {"name", base_path(node.path)}, {"type", node.kind.type()}};
    if (i < plans.size()) {
      json["status"] = to_string(plans[i].verdict);
      json["reason"] = plans[i].reason;
      if (plans[i].seconds) json["cost_seconds"] = *plans[i].seconds;
    }
    json["params"] = Json::object();
    for (const auto& [name, value] : node.params) json["params"][name] = value;
    json["inputs"] = Json::object();
    for (const auto& [port, edge] : node.inputs)
      json["inputs"][port] = dag.nodes[edge.node].path + "." + edge.port;
    json["outputs"] = Json::object();
    for (const PortDecl& port : node.kind.outputs()) json["outputs"][port.name] = {{"type", port.type}};
    if (const Loop* loop = node.kind.loop()) {
      json["body"] = Json::array();
      for (const DagNode& inner : loop->body.nodes) json["body"].push_back(inner.path);
    }
    graph["nodes"].push_back(std::move(json));
  }
  return graph;
}

Json variants_json(const Dag& dag, std::size_t number) {
  std::map<std::string, Json> outputs;  // by variant
  for (const DagOutput& output : dag.outputs) {
    const DagNode& node = dag.nodes[output.from.node];
    const PortDecl* port = node.kind.output(output.from.port);
    const std::size_t slash = output.name.rfind('/');
    const std::string variant = slash == std::string::npos ? "" : output.name.substr(0, slash);
    outputs[variant].push_back({{"name", output.base_name()},
                                {"from", node.path + "." + output.from.port},
                                {"type", port == nullptr ? "" : port->type}});
  }
  Json variants = Json::array();
  const auto add = [&](const std::string& name, Json values, const std::vector<std::size_t>& nodes) {
    Json& of_variant = outputs[name];
    if (of_variant.is_null()) of_variant = Json::array();
    variants.push_back({{"graph", number},
                        {"name", name},
                        {"values", std::move(values)},
                        {"nodes", nodes},
                        {"outputs", of_variant}});
  };
  for (const Variant& variant : dag.variants) {
    Json values = Json::object();
    for (const auto& [axis, value] : variant.values) values[axis] = value;
    add(variant.name, std::move(values), variant.nodes);
  }
  if (dag.variants.empty()) {
    std::vector<std::size_t> all(dag.nodes.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    add("", Json::object(), all);
  }
  return variants;
}

}  // namespace ballflow::show
