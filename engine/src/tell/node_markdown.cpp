// The documentation of nodes and types: Markdown from their declarations.
#include "ballflow/schema.hpp"
#include "base/quote.hpp"
#include "plugin/param_value.hpp"
#include "tell/join.hpp"

namespace ballflow {
namespace {

std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string range_text(const ParamDecl& param) {
  if (param.kind == ParamKind::choice) {
    std::string names;
    for (const auto& choice : param.choices) names = join(names, "`" + choice.first + "`", ", ");
    return names;
  }
  std::string text;
  if (param.minimum) text = join(text, ">= " + shortest(*param.minimum), ", ");
  if (param.exclusive_minimum) text = join(text, "> " + shortest(*param.exclusive_minimum), ", ");
  if (param.maximum) text = join(text, "<= " + shortest(*param.maximum), ", ");
  if (param.exclusive_maximum) text = join(text, "< " + shortest(*param.exclusive_maximum), ", ");
  return text;
}

/// For nodes that no graph at hand uses.
Json made_up_example(const NodeDeclaration& node) {
  Json json = {{"type", node.id}};
  for (const PortDecl& port : node.inputs) {
    if (port.optional) continue;
    const std::string source = port.name + "_source." + port.name;
    json["inputs"][port.name] = port.list ? Json{source, "other_" + source} : Json(source);
  }
  for (const ParamDecl& param : node.params) {
    if (!param.required) {
      json["params"][param.name] = param.default_value;
    } else if (param.kind == ParamKind::number || param.kind == ParamKind::integer) {
      json["params"][param.name] = normalised(param, param.minimum.value_or(param.maximum.value_or(1)));
    } else if (param.kind == ParamKind::boolean) {
      json["params"][param.name] = false;
    } else if (param.kind == ParamKind::choice) {
      json["params"][param.name] = param.choices.front().first;
    } else {
      json["params"][param.name] = "${" + param.name + "}";
    }
  }
  return {{"node", std::move(json)}};
}

std::string command(const NodeExample& example) {
  std::string text = "ballflow run graphs/" + example.graph;
  for (const Setting& set : example.settings) text += " --set " + set.name + "=" + set.value;
  return text;
}

void ports_table(std::string& text, const char* title, const std::vector<PortDecl>& ports) {
  if (ports.empty()) return;
  text += "\n| " + std::string(title) + " | type | meaning |\n|---|---|---|\n";
  for (const PortDecl& port : ports) {
    text += "| `" + port.name + "`" + (port.optional ? " (optional)" : "") + " | " + port.type +
            (port.list ? ", several" : "") + " | " + cell(port.doc) + " |\n";
  }
}

/// What GitHub makes of a heading: lower case, without dots.
std::string anchor(const std::string& id) {
  std::string text;
  for (const char c : id) {
    if (c != '.') text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

std::string type_markdown(const TypeDeclaration& type) {
  std::string text =
      "### " + type.id + "\n\n" + type.doc + " Version " + std::to_string(type.version) + ".\n";
  if (!type.arrays.empty()) text += "\n| array | dtype | shape | meaning |\n|---|---|---|---|\n";
  for (const ArrayDecl& array : type.arrays) {
    std::string shape;
    for (const Json& length : array.shape) shape = join(shape, plain_text(length), " x ");
    text += "| `" + array.name + "`" + (array.optional ? " (optional)" : "") + " | " + array.dtype + " | " +
            (shape.empty() ? "one number" : shape) + " | " + cell(array.doc) + " |\n";
  }
  if (!type.summary.empty()) text += "\n| summary field | meaning |\n|---|---|\n";
  for (const auto& [field, doc] : type.summary) text += "| `" + field + "` | " + cell(doc) + " |\n";
  return text;
}

}  // namespace

std::string node_markdown(const NodeDeclaration& node, const NodeExample* example) {
  std::string text = "### " + node.id + "\n\n" + node.summary + "\n";
  if (!node.doc.empty()) text += "\n" + node.doc + "\n";
  if (!node.avoid_when.empty()) text += "\nAvoid when: " + node.avoid_when + "\n";
  ports_table(text, "input", node.inputs);
  ports_table(text, "output", node.outputs);
  if (!node.params.empty()) {
    text += "\n| parameter | kind | default | range | unit | meaning |\n|---|---|---|---|---|---|\n";
    for (const ParamDecl& param : node.params) {
      const std::string standard = param.required ? "required" : "`" + param.default_value.dump() + "`";
      text += "| `" + param.name + "` | " + kind_name(param.kind) + " | " + cell(standard) + " | " +
              cell(range_text(param)) + " | " + cell(param.unit) + " | " + cell(param.doc) +
              (param.hashed ? "" : " Not part of the cache key.") + " |\n";
    }
    for (const ParamDecl& param : node.params) {
      if (param.choices.empty()) continue;
      text += "\nChoices of `" + param.name + "`:\n\n";
      for (const auto& [value, doc] : param.choices) text += "- `" + value + "`: " + doc + "\n";
    }
  }
  text += "\n```json\n" + (example == nullptr ? made_up_example(node) : example->entry).dump(2) + "\n```\n";
  if (example != nullptr) {
    text += "\nFrom [" + example->file + "](../graphs/" + example->file + "); `" + command(*example) +
            "` runs it.\n";
  }
  std::string facts = "Behaviour version " + std::to_string(node.version) + ".";
  if (node.uses_seed) facts += " The result depends on the seed.";
  for (const auto& [library, version] : node.libraries)
    facts += " Computed with " + library + " " + version + ".";
  text += "\n" + facts + "\n";
  for (const Citation& cite : node.cites) text += "\nSource: [" + cite.key + "] " + cite.where + ".\n";
  return text;
}

std::string nodes_markdown(const Registry& registry, const std::map<std::string, NodeExample>& examples) {
  std::string text = "# Nodes\n\n| node | inputs | outputs | |\n|---|---|---|---|\n";
  const auto types_of = [](const std::vector<PortDecl>& ports) {
    std::string types;
    for (const PortDecl& port : ports) types = join(types, port.type, ", ");
    return types;
  };
  for (const auto& [id, node] : registry.nodes()) {
    text += "| [" + id + "](#" + anchor(id) + ") | " + types_of(node.inputs) + " | " +
            types_of(node.outputs) + " | " + cell(node.summary) + " |\n";
  }
  for (const auto& [id, node] : registry.nodes()) {
    const auto example = examples.find(id);
    text += "\n" + node_markdown(node, example == examples.end() ? nullptr : &example->second);
  }
  text += "\n# Types\n";
  for (const auto& [id, type] : registry.types()) text += "\n" + type_markdown(type);
  return text;
}

}  // namespace ballflow
