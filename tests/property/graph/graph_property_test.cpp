// Random graphs of toy nodes: what a graph means depends on its content alone.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "ballflow/graph.hpp"
#include "test_data.hpp"
#include "toy_nodes.hpp"

namespace ballflow {
namespace {

const Registry& registry() {
  static const Registry toy = test::toy_registry();
  return toy;
}

/// What a graph file says, made up independently of the parser.
struct ModelNode {
  std::string name;
  const NodeDeclaration* decl = nullptr;
  std::map<std::string, std::pair<std::size_t, std::string>> inputs;  // port -> producer, its port
  std::map<std::string, Json> params;                                 // only those that are written
};
using Model = std::vector<ModelNode>;

Json random_value(const ParamDecl& param) {
  switch (param.kind) {
    case ParamKind::number: {
      const double low = param.minimum.value_or(param.exclusive_minimum.value_or(-50) + 0.125);
      const double high = param.maximum.value_or(low + 50);
      return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0;
    }
    case ParamKind::integer:
      return *rc::gen::inRange<std::int64_t>(static_cast<std::int64_t>(*param.minimum),
                                             static_cast<std::int64_t>(*param.maximum) + 1);
    case ParamKind::boolean:
      return *rc::gen::arbitrary<bool>();
    case ParamKind::choice:
      return param.choices[*rc::gen::inRange<std::size_t>(0, param.choices.size())].first;
    default:
      return "t" + *rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab \"\\/\n\t$}.")));
  }
}

Model random_model() {
  const std::size_t wanted = *rc::gen::inRange<std::size_t>(1, 14);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < wanted; ++i)
    names.push_back("n" + std::to_string(i * 7919 % 97) + (i % 2 == 0 ? "-x" : ""));
  Model model;
  std::vector<const NodeDeclaration*> all;
  for (const auto& [id, decl] : registry().nodes()) all.push_back(&decl);
  while (model.size() < wanted) {
    const NodeDeclaration* decl = model.empty() ? registry().node("Load") : *rc::gen::elementOf(all);
    ModelNode node;
    node.name = names[model.size()];
    node.decl = decl;
    bool complete = true;
    for (const PortDecl& port : decl->inputs) {
      std::vector<std::pair<std::size_t, std::string>> sources;
      for (std::size_t i = 0; i < model.size(); ++i) {
        for (const PortDecl& out : model[i].decl->outputs) {
          if (out.type == port.type) sources.emplace_back(i, out.name);
        }
      }
      if (sources.empty() || (port.optional && *rc::gen::arbitrary<bool>())) {
        complete = complete && port.optional;
        continue;
      }
      node.inputs[port.name] = *rc::gen::elementOf(sources);
    }
    if (!complete) {
      node.inputs.clear();
      node.decl = decl = registry().node("Load");
    }
    for (const ParamDecl& param : decl->params) {
      if (param.required || *rc::gen::arbitrary<bool>()) node.params[param.name] = random_value(param);
    }
    model.push_back(std::move(node));
  }
  return model;
}

/// Joins members in a random order with random white space and comments between tokens.
std::string shuffled_object(std::vector<std::string> members) {
  const auto gap = [] {
    return *rc::gen::elementOf(std::vector<std::string>{"", "", " ", "\n", "\r\n\t", "/* , } */", "// {\n"});
  };
  std::string text = "{" + gap();
  for (std::size_t left = members.size(); left > 0; --left) {
    const std::size_t pick = *rc::gen::inRange<std::size_t>(0, left);
    text += members[pick] + gap() + (left > 1 ? "," : "") + gap();
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  return text + "}";
}

std::string member(const std::string& key, const std::string& value) {
  return Json(key).dump() + ":" + value;
}

/// The members of the graph object.
std::vector<std::string> print(const Model& model) {
  std::vector<std::string> nodes;
  for (const ModelNode& node : model) {
    std::vector<std::string> inputs, params, fields = {member("type", Json(node.decl->id).dump())};
    for (const auto& [port, source] : node.inputs)
      inputs.push_back(member(port, Json(model[source.first].name + "." + source.second).dump()));
    for (const auto& [name, value] : node.params) params.push_back(member(name, value.dump()));
    if (!inputs.empty()) fields.push_back(member("inputs", shuffled_object(inputs)));
    if (!params.empty()) fields.push_back(member("params", shuffled_object(params)));
    nodes.push_back(member(node.name, shuffled_object(fields)));
  }
  // "${" in a value would be a substitution; the alphabet of random texts has no "{".
  return {member("nodes", shuffled_object(nodes)),
          member("outputs", "{\"first\":\"" + model[0].name + ".points\"}")};
}

/// The whole meaning of a DAG as text, without the places where it was written.
std::string meaning(const Dag& dag, std::size_t skip = 0) {
  std::string text;
  for (const DagNode& node : dag.nodes) {
    text += node.path.substr(skip) + " " + node.kind.type() + "(";
    for (const auto& [name, value] : node.params) text += name + "=" + value.dump() + ",";
    text += ") <-";
    for (const auto& [port, edge] : node.inputs)
      text += " " + port + ":" + std::to_string(edge.node) + "." + edge.port;
    text += "\n";
  }
  for (const DagOutput& output : dag.outputs)
    text += output.name + ":" + std::to_string(output.from.node) + "." + output.from.port + "\n";
  return text;
}

/// A DAG as the text of a flat graph.
std::string print(const Dag& dag) {
  Json graph = {{"nodes", Json::object()}};
  for (const DagNode& node : dag.nodes) {
    Json& json = graph["nodes"][node.path];
    json["type"] = node.kind.type();
    for (const auto& [name, value] : node.params) json["params"][name] = value;
    for (const auto& [port, edge] : node.inputs)
      json["inputs"][port] = dag.nodes[edge.node].path + "." + edge.port;
  }
  for (const DagOutput& output : dag.outputs)
    graph["outputs"][output.name] = dag.nodes[output.from.node].path + "." + output.from.port;
  return graph.dump(1);
}

Dag parse(const std::string& text) { return parse_graph(text, "g.json", registry()); }

RC_GTEST_PROP(graph_property, a_dag_says_what_the_graph_says, ()) {
  const Model model = random_model();
  const Dag dag = parse(shuffled_object(print(model)));
  RC_ASSERT(dag.nodes.size() == model.size());
  for (const ModelNode& node : model) {
    const DagNode* found = dag.find(node.name);
    RC_ASSERT(found != nullptr);
    RC_ASSERT(found->kind.declared() == node.decl);
    RC_ASSERT(found->inputs.size() == node.inputs.size());
    for (const auto& [port, source] : node.inputs) {
      RC_ASSERT(dag.nodes[found->inputs.at(port).node].path == model[source.first].name);
      RC_ASSERT(found->inputs.at(port).port == source.second);
    }
    for (const ParamDecl& param : node.decl->params) {
      const auto written = node.params.find(param.name);
      RC_ASSERT(found->params.at(param.name) ==
                (written != node.params.end() ? written->second : param.default_value));
    }
  }
}

RC_GTEST_PROP(graph_property, the_order_of_members_and_white_space_mean_nothing, ()) {
  const Model model = random_model();
  RC_ASSERT(meaning(parse(shuffled_object(print(model)))) == meaning(parse(shuffled_object(print(model)))));
}

RC_GTEST_PROP(graph_property, a_printed_dag_reads_as_the_same_dag, ()) {
  const Dag dag = parse(shuffled_object(print(random_model())));
  RC_ASSERT(meaning(parse(print(dag))) == meaning(dag));
}

RC_GTEST_PROP(graph_property, a_subgraph_means_what_its_file_means, ()) {
  const std::string text = shuffled_object(print(random_model()));
  static const test::TempFolder folder;
  test::write_file(folder.file("sub.json"), text);
  const Dag flat = parse(text);
  const Dag nested = parse_graph(R"({"nodes":{"s":{"graph":"sub.json"}},"outputs":{"first":"s.first"}})",
                                 folder.file("top.json"), registry());
  RC_ASSERT(meaning(nested, 2) == meaning(flat));
}

RC_GTEST_PROP(graph_property, nodes_come_in_topological_order_smallest_path_first, ()) {
  const Dag dag = parse(shuffled_object(print(random_model())));
  std::set<std::size_t> done;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    // Of all nodes whose inputs are there, this one has the smallest path.
    for (std::size_t k = i; k < dag.nodes.size(); ++k) {
      const bool ready = std::all_of(dag.nodes[k].inputs.begin(), dag.nodes[k].inputs.end(),
                                     [&](const auto& input) { return done.contains(input.second.node); });
      RC_ASSERT(k != i || ready);
      RC_ASSERT(!ready || dag.nodes[i].path <= dag.nodes[k].path);
    }
    done.insert(i);
  }
}

}  // namespace
}  // namespace ballflow
