#include "document/variant_merger.hpp"

#include <set>
#include <string_view>
#include <utility>

#include "document/labels.hpp"

namespace ballflow {
namespace {

void append(std::string& to, std::string_view text) {
  to += std::to_string(text.size());
  to += ':';
  to += text;
}

/// What a node is but for its inputs.
void append_identity(std::string& to, const DagNode& node) {
  append(to, node.path);
  append(to, node.kind.type());
  for (const auto& [name, value] : node.params) {
    append(to, name);
    append(to, value.dump());
  }
  if (const Given* given = node.kind.given()) append(to, given->artifact->digest().hex());
  const Loop* const loop = node.kind.loop();
  if (loop == nullptr) return;
  const Dag& body = loop->body;
  for (const DagNode& inner : body.nodes) {
    append_identity(to, inner);
    for (const auto& [port, edge] : inner.inputs) {
      append(to, port);
      append(to, std::to_string(edge.node) + "." + edge.port);
    }
  }
  for (const DagOutput& output : body.outputs) {
    append(to, output.name);
    append(to, std::to_string(output.from.node) + "." + output.from.port);
  }
}

/// The value that a variant has for an axis, as a node gets it.
Json value_in(const Dag& variant, const PlacedSetting& setting) {
  const std::string target = setting_target(setting.name);
  const std::size_t dot = target.rfind('.');
  const std::string path = target.substr(0, dot), name = target.substr(dot + 1);
  if (path.empty()) {
    if (const auto value = variant.params.find(name); value != variant.params.end()) return value->second;
  }
  if (const DagNode* node = path.empty() ? nullptr : variant.find(path)) {
    if (const auto value = node->params.find(name); value != node->params.end()) return value->second;
  }
  return setting.value ? *setting.value : Json(setting.text);
}

}  // namespace

VariantMerger::VariantMerger(const Sweep& sweep) : sweep_(sweep) {}

void VariantMerger::add(Dag dag) {
  const std::size_t number = dag_.variants.size();
  const Sweep::Choice& choice = sweep_.variants[number];
  Variant& variant = dag_.variants.emplace_back();
  variant.name = sweep_.name_of(choice);
  for (std::size_t axis = 0; axis < choice.size(); ++axis) {
    const PlacedSetting& setting = sweep_.axes[axis].values[choice[axis]];
    variant.values.emplace_back(sweep_.axes[axis].name, value_in(dag, setting));
  }
  if (number == 0) {
    dag_.file = dag.file;
    dag_.doc = dag.doc;
    dag_.params = std::move(dag.params);
    for (const Sweep::Axis& axis : sweep_.axes) dag_.params.erase(axis.name);
  }
  variant.nodes.reserve(dag.nodes.size());
  for (DagNode& node : dag.nodes) {
    for (auto& [port, edge] : node.inputs) edge.node = variant.nodes[edge.node];
    std::string identity;
    append_identity(identity, node);
    for (const auto& [port, edge] : node.inputs) {
      append(identity, port);
      append(identity, std::to_string(edge.node) + "." + edge.port);
    }
    const auto [known, fresh] = known_.try_emplace(std::move(identity), dag_.nodes.size());
    variant.nodes.push_back(known->second);
    if (fresh) {
      dag_.nodes.push_back(std::move(node));
      shared_.push_back({number, std::vector<bool>(choice.size(), true)});
      continue;
    }
    Shared& shared = shared_[known->second];
    for (std::size_t axis = 0; axis < choice.size(); ++axis) {
      if (choice[axis] != sweep_.variants[shared.first][axis]) shared.common[axis] = false;
    }
  }
  variant.interfaces = std::move(dag.interfaces);
  for (DagOutput& output : variant.interfaces) output.from.node = variant.nodes[output.from.node];
  for (DagOutput& output : dag.outputs) {
    output.name = variant.name + "/" + output.name;
    output.from.node = variant.nodes[output.from.node];
    dag_.outputs.push_back(std::move(output));
  }
}

Dag VariantMerger::finish() {
  std::vector<bool> varies(sweep_.axes.size(), false);
  for (const Sweep::Choice& choice : sweep_.variants) {
    for (std::size_t axis = 0; axis < choice.size(); ++axis)
      varies[axis] = varies[axis] || choice[axis] != sweep_.variants[0][axis];
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    const Sweep::Choice& choice = sweep_.variants[shared_[i].first];
    std::string label;
    for (std::size_t axis = 0; axis < choice.size(); ++axis) {
      if (varies[axis] && shared_[i].common[axis])
        label += (label.empty() ? "" : ",") + sweep_.label_of(axis, choice[axis]);
    }
    std::string& path = dag_.nodes[i].path;
    std::string labelled = label.empty() ? path : "[" + cut(label, longest_variant_name) + "]/" + path;
    // Two nodes of different variants may have no value, or the same values, in common.
    if (!taken.insert(labelled).second) {
      labelled = "[" + dag_.variants[shared_[i].first].name + "]/" + path;
      taken.insert(labelled);
    }
    path = std::move(labelled);
  }
  return std::move(dag_);
}

}  // namespace ballflow
