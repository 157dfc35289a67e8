#include "ballflow/schema.hpp"

#include "base/quote.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

namespace {

const char* const draft = "http://json-schema.org/draft-07/schema#";
const char* const substitution = "\\$\\{[A-Za-z_][A-Za-z0-9_]*\\}";
const char* const identifier = "^[A-Za-z_][A-Za-z0-9_]*$";
const char* const node_name = "^[A-Za-z0-9_][A-Za-z0-9_-]*$";
// "node.port", or a parameter of kind artifact.
const char* const edge =
    "^([A-Za-z0-9_][A-Za-z0-9_-]*\\.[A-Za-z_][A-Za-z0-9_]*|\\$\\{[A-Za-z_][A-Za-z0-9_]*\\})$";

std::string join(const std::string& a, const std::string& b, const char* between) {
  return a.empty() || b.empty() ? a + b : a + between + b;
}

Json edge_schema(const std::string& doc) {
  return {{"type", "string"}, {"pattern", edge}, {"description", doc}};
}

/// Accepts what ParamDecl::refuse accepts, and "${name}".
Json param_schema(const ParamDecl& param) {
  Json schema = Json::object();
  std::string description = param.doc;
  if (!param.unit.empty()) description = join(description, "Unit: " + param.unit + ".", " ");
  schema["description"] = description;
  if (!param.required) schema["default"] = param.default_value;

  Json value = Json::object();
  switch (param.kind) {
    case ParamKind::number:
    case ParamKind::integer:
      value["type"] = param.kind == ParamKind::number ? "number" : "integer";
      if (param.minimum) value["minimum"] = *param.minimum;
      if (param.maximum) value["maximum"] = *param.maximum;
      if (param.exclusive_minimum) value["exclusiveMinimum"] = *param.exclusive_minimum;
      if (param.exclusive_maximum) value["exclusiveMaximum"] = *param.exclusive_maximum;
      break;
    case ParamKind::boolean:
      value["type"] = "boolean";
      break;
    case ParamKind::choice:
      value["oneOf"] = Json::array();
      for (const auto& [name, doc] : param.choices)
        value["oneOf"].push_back({{"const", name}, {"description", doc}});
      break;
    case ParamKind::string:
    case ParamKind::file:
    case ParamKind::artifact:  // of graphs only
      // A text may contain substitutions anyway.
      schema["type"] = "string";
      if (param.kind == ParamKind::file && param.required) schema["minLength"] = 1;
      return schema;
  }
  // A choice may be put together from parts, a number or a boolean is one parameter as a whole.
  const std::string pattern =
      param.kind == ParamKind::choice ? substitution : std::string("^") + substitution + "$";
  schema["anyOf"] = {std::move(value), {{"type", "string"}, {"pattern", pattern}}};
  return schema;
}

Json node_definition(const NodeDeclaration& node) {
  Json inputs = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required_inputs = Json::array();
  for (const PortDecl& port : node.inputs) {
    Json wanted = edge_schema(port.type + (port.list ? ", several" : "") +
                              (port.optional ? ", optional: " : ": ") + port.doc);
    if (port.list) {
      Json list = {{"type", "array"}, {"items", edge_schema("one of them, in order")}};
      if (!port.optional) list["minItems"] = 1;
      wanted = {{"anyOf", {std::move(wanted), std::move(list)}}};
    }
    inputs["properties"][port.name] = std::move(wanted);
    if (!port.optional) required_inputs.push_back(port.name);
  }
  Json params = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
  Json required_params = Json::array();
  for (const ParamDecl& param : node.params) {
    params["properties"][param.name] = param_schema(param);
    if (param.required) required_params.push_back(param.name);
  }
  Json required = {"type"};
  if (!required_inputs.empty()) {
    inputs["required"] = std::move(required_inputs);
    required.push_back("inputs");
  }
  if (!required_params.empty()) {
    params["required"] = std::move(required_params);
    required.push_back("params");
  }
  return {{"title", node.id},
          {"description", join(node.summary, node.doc, "\n")},
          {"type", "object"},
          {"additionalProperties", false},
          {"required", std::move(required)},
          {"properties",
           {{"type", {{"const", node.id}}},
            {"doc", {{"type", "string"}}},
            {"inputs", std::move(inputs)},
            {"params", std::move(params)}}}};
}

/// Adds one definition per node type to `definitions`; returns the schema of an entry of "nodes".
Json any_node(const Registry& registry, Json& definitions) {
  Json types = Json::array();
  Json rules = Json::array();
  for (const auto& [id, node] : registry.nodes()) {
    definitions[id] = node_definition(node);
    types.push_back({{"const", id}, {"description", node.summary}});
    rules.push_back({{"if", {{"required", {"type"}}, {"properties", {{"type", {{"const", id}}}}}}},
                     {"then", {{"$ref", "#/definitions/" + id}}}});
  }
  definitions["subgraph"] = {
      {"title", "subgraph"},
      {"description", "The graph of another file, as a node."},
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"graph"}},
      {"properties",
       {{"graph",
         {{"type", "string"}, {"minLength", 1}, {"description", "path of the file, relative to this file"}}},
        {"doc", {{"type", "string"}}},
        {"inputs",
         {{"type", "object"}, {"additionalProperties", edge_schema("edge to an input of the subgraph")}}},
        {"params",
         {{"type", "object"},
          {"description", "values for the parameters of the subgraph"},
          {"additionalProperties", {{"type", {"number", "boolean", "string"}}}}}}}}};
  rules.push_back({{"if", {{"required", {"graph"}}}}, {"then", {{"$ref", "#/definitions/subgraph"}}}});
  definitions["loop"] = {
      {"title", "loop"},
      {"description",
       "The graph of another file, run again and again: its outputs go to its inputs of the same names. "
       "Nothing is "
       "stored but the final state."},
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"loop", "until"}},
      {"properties",
       {{"loop",
         {{"type", "string"},
          {"minLength", 1},
          {"description", "path of the file of the body, relative to this file"}}},
        {"doc", {{"type", "string"}}},
        {"inputs",
         {{"type", "object"},
          {"description", "the first states, and what stays the same"},
          {"additionalProperties", edge_schema("edge to an input of the body")}}},
        {"params",
         {{"type", "object"},
          {"description", "values for the parameters of the body"},
          {"additionalProperties", {{"type", {"number", "boolean", "string"}}}}}}}}};
  for (const ParamDecl& param : loop_params())
    definitions["loop"]["properties"][param.name] = param_schema(param);
  rules.push_back({{"if", {{"required", {"loop"}}}}, {"then", {{"$ref", "#/definitions/loop"}}}});
  Json properties = Json::object();
  if (!types.empty()) properties["type"] = {{"description", "node type"}, {"oneOf", std::move(types)}};
  properties["graph"] = {{"type", "string"}};
  properties["loop"] = {{"type", "string"}};
  properties["doc"] = {{"type", "string"}};
  properties["inputs"] = {{"type", "object"}};
  properties["params"] = {{"type", "object"}};
  return {{"type", "object"},
          {"oneOf", {{{"required", {"type"}}}, {{"required", {"graph"}}}, {{"required", {"loop"}}}}},
          {"properties", std::move(properties)},
          {"allOf", std::move(rules)}};
}

Json graph_param_schema() {
  const Json text = {{"type", "string"}};
  return {{"type", "object"},
          {"additionalProperties", false},
          {"required", {"kind"}},
          {"properties",
           {{"kind", {{"enum", {"number", "integer", "boolean", "string", "choice", "file", "artifact"}}}},
            {"default",
             {{"type", {"number", "boolean", "string"}},
              {"description", "without it the parameter must be given"}}},
            {"minimum", {{"type", "number"}}},
            {"maximum", {{"type", "number"}}},
            {"choices",
             {{"type", "array"},
              {"minItems", 1},
              {"items",
               {{"anyOf",
                 {text,
                  {{"type", "object"},
                   {"additionalProperties", false},
                   {"required", {"value"}},
                   {"properties", {{"value", text}, {"doc", text}}}}}}}}}},
            {"unit", text},
            {"type", {{"type", "string"}, {"description", "of the artifact, for the kind artifact"}}},
            {"doc", text}}}};
}

Json sweep_schema() {
  const Json value = {{"type", {"number", "boolean", "string"}}};
  return {{"type", "object"},
          {"description", "run once for every combination of values; what they have in common runs once"},
          {"additionalProperties", false},
          {"required", {"axes"}},
          {"properties",
           {{"axes",
             {{"type", "object"},
              {"description", "values of parameters of the graph, or of a node (\"prune/greedy.mode\")"},
              {"additionalProperties",
               {{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}, {"items", value}}}}},
            {"mode",
             {{"default", "product"},
              {"oneOf",
               {{{"const", "product"}, {"description", "every combination, the last axis fastest"}},
                {{"const", "zip"},
                 {"description", "the first values of all axes, then the second ones, and so on"}}}}}},
            {"exclude",
             {{"type", "array"},
              {"description", "combinations that are left out"},
              {"items", {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", value}}}}}}}};
}

Json map_schema() {
  const Json pattern = {{"type", "string"}};
  return {
      {"type", "object"},
      {"description",
       "parameters of kind file that get every file that matches: a pattern with *, ? or [...], or a list of "
       "patterns and names, relative to the current directory"},
      {"propertyNames", {{"pattern", identifier}}},
      {"additionalProperties",
       {{"anyOf", {pattern, {{"type", "array"}, {"minItems", 1}, {"items", pattern}}}}}}};
}

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
  for (const Override& set : example.overrides) text += " --set " + set.name + "=" + set.value;
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

Json nodes_schema(const Registry& registry) {
  Json definitions = Json::object();
  Json schema = {{"$schema", draft}, {"title", "ballflow node"}};
  schema.update(any_node(registry, definitions));
  schema["definitions"] = std::move(definitions);
  return schema;
}

Json graph_schema(const Registry& registry) {
  Json definitions = Json::object();
  Json node = any_node(registry, definitions);
  Json types = Json::array();
  for (const auto& [id, type] : registry.types()) types.push_back({{"const", id}, {"description", type.doc}});
  Json type = {{"type", "string"}};
  if (!types.empty()) type["oneOf"] = std::move(types);
  const Json text = {{"type", "string"}};
  definitions["node"] = std::move(node);
  definitions["parameter"] = graph_param_schema();
  return {{"$schema", draft},
          {"title", "ballflow graph"},
          {"type", "object"},
          {"additionalProperties", false},
          {"required", {"nodes"}},
          {"properties",
           {{"$schema", text},
            {"doc", {{"type", "string"}, {"description", "what the graph computes, one sentence"}}},
            {"params",
             {{"type", "object"},
              {"propertyNames", {{"pattern", identifier}}},
              {"additionalProperties", {{"$ref", "#/definitions/parameter"}}}}},
            {"inputs",
             {{"type", "object"},
              {"description", "inputs of a subgraph, read as \"inputs.name\""},
              {"propertyNames", {{"pattern", identifier}}},
              {"additionalProperties",
               {{"type", "object"},
                {"additionalProperties", false},
                {"required", {"type"}},
                {"properties",
                 {{"type", std::move(type)}, {"optional", {{"type", "boolean"}}}, {"doc", text}}}}}}},
            {"nodes",
             {{"type", "object"},
              {"propertyNames", {{"pattern", node_name}, {"not", {{"const", "inputs"}}}}},
              {"additionalProperties", {{"$ref", "#/definitions/node"}}}}},
            {"sweep", sweep_schema()},
            {"map", map_schema()},
            {"outputs",
             {{"type", "object"},
              {"propertyNames", {{"pattern", identifier}}},
              {"additionalProperties",
               {{"anyOf",
                 {edge_schema("what is wanted"),
                  {{"type", "object"},
                   {"additionalProperties", false},
                   {"required", {"from"}},
                   {"properties", {{"from", edge_schema("what is wanted")}, {"doc", text}}}}}}}}}}}},
          {"definitions", std::move(definitions)}};
}

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
