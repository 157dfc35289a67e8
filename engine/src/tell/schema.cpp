#include "ballflow/schema.hpp"

#include "base/quote.hpp"
#include "tell/join.hpp"

namespace ballflow {

namespace {

const char* const draft = "http://json-schema.org/draft-07/schema#";
const char* const substitution = "\\$\\{[A-Za-z_][A-Za-z0-9_]*\\}";
const char* const identifier = "^[A-Za-z_][A-Za-z0-9_]*$";
const char* const node_name = "^[A-Za-z0-9_][A-Za-z0-9_-]*$";
// "node.port", or a parameter of kind artifact.
const char* const edge =
    "^([A-Za-z0-9_][A-Za-z0-9_-]*\\.[A-Za-z_][A-Za-z0-9_]*|\\$\\{[A-Za-z_][A-Za-z0-9_]*\\})$";

Json edge_schema(const std::string& doc) {
  return {{"type", "string"}, {"pattern", edge}, {"description", doc}};
}

/// Accepts what ParamDecl::refuse accepts, and "${name}".
/// Of a parameter of another graph: a value, or the entries of a list.
Json value_or_list() {
  return {{"type", {"number", "boolean", "string", "array"}},
          {"items", {{"type", {"number", "boolean", "string"}}}}};
}

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
    case ParamKind::list:  // of graphs only, like those below
    case ParamKind::files:
    case ParamKind::artifact:
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
          {"additionalProperties", value_or_list()}}}}}};
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
          {"additionalProperties", value_or_list()}}}}}};
  for (const ParamDecl& param : loop_params())
    definitions["loop"]["properties"][param.name] = param_schema(param);
  rules.push_back({{"if", {{"required", {"loop"}}}}, {"then", {{"$ref", "#/definitions/loop"}}}});
  definitions["map"] = {
      {"title", "map"},
      {"description",
       "The graph of another file, once for every entry of a list; its outputs are lists in that order."},
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"map", "over"}},
      {"properties",
       {{"map",
         {{"type", "string"},
          {"minLength", 1},
          {"description", "path of the file of the body, relative to this file"}}},
        {"over",
         {{"type", "object"},
          {"minProperties", 1},
          {"description",
           "parameters of the body and the lists that they go through; the first names the copies"},
          {"additionalProperties",
           {{"anyOf",
             {{{"type", "string"}, {"pattern", std::string("^") + substitution + "$"}},
              {{"type", "array"},
               {"minItems", 1},
               {"items", {{"type", {"number", "boolean", "string"}}}}}}}}}}},
        {"index",
         {{"type", "string"},
          {"pattern", identifier},
          {"description", "the parameter of the body that gets the place of its entry, from 0 on"}}},
        {"doc", {{"type", "string"}}},
        {"inputs",
         {{"type", "object"},
          {"description", "the same for every entry"},
          {"additionalProperties", edge_schema("edge to an input of the body")}}},
        {"params",
         {{"type", "object"},
          {"description", "values for the parameters of the body, the same for every entry"},
          {"additionalProperties", value_or_list()}}}}}};
  rules.push_back({{"if", {{"required", {"map"}}}}, {"then", {{"$ref", "#/definitions/map"}}}});
  Json properties = Json::object();
  if (!types.empty()) properties["type"] = {{"description", "node type"}, {"oneOf", std::move(types)}};
  properties["graph"] = {{"type", "string"}};
  properties["loop"] = {{"type", "string"}};
  properties["map"] = {{"type", "string"}};
  properties["doc"] = {{"type", "string"}};
  properties["inputs"] = {{"type", "object"}};
  properties["params"] = {{"type", "object"}};
  return {{"type", "object"},
          {"oneOf",
           {{{"required", {"type"}}},
            {{"required", {"graph"}}},
            {{"required", {"loop"}}},
            {{"required", {"map"}}}}},
          {"properties", std::move(properties)},
          {"allOf", std::move(rules)}};
}

Json graph_param_schema() {
  const Json text = {{"type", "string"}};
  return {
      {"type", "object"},
      {"additionalProperties", false},
      {"required", {"kind"}},
      {"properties",
       {{"kind",
         {{"enum",
           {"number", "integer", "boolean", "string", "choice", "file", "list", "files", "artifact"}}}},
        {"default",
         {{"type", {"number", "boolean", "string", "array"}},
          {"items", {{"type", {"number", "boolean", "string"}}}},
          {"description", "without it the parameter must be given; an array for the kinds list and files"}}},
        {"alias",
         {{"type", "string"},
          {"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"},
          {"description", "a former name of the parameter, by which it can still be set"}}},
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

}  // namespace ballflow
