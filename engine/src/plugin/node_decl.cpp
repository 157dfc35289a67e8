#include "ballflow/node_decl.hpp"

#include <cmath>
#include <set>
#include <tuple>

#include "base/json_text.hpp"
#include "base/quote.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

namespace {

/// Reads the fields of one JSON object of a declaration; every complaint says where in the declaration.
class Fields {
 public:
  Fields(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail("is no JSON object");
  }

  std::string text(const char* name, bool may_be_absent = false) {
    const Json* value = get(name, may_be_absent);
    if (value == nullptr) return {};
    if (!value->is_string()) fail_field(name, "is no text");
    return value->get<std::string>();
  }
  std::string identifier(const char* name) {
    const std::string value = text(name);
    if (!is_identifier(value))
      fail_field(name, in_quotes(value) + " is no name (letters, digits and _, no digit first)");
    return value;
  }
  /// Of a node or an artifact type: identifiers joined by dots, "Offset" or "acme.Offset".
  std::string type_id(const char* name) {
    constexpr std::size_t longest = 200;  // the file of an artifact names its type
    const std::string value = text(name);
    if (!is_type_id(value) || value.size() > longest) {
      fail_field(name, in_quotes(value) +
                           " is no name of a type (letters, digits and _, no digit first; after a namespace "
                           "and a dot: acme.Offset)");
    }
    return value;
  }
  int version(const char* name) {
    const Json* value = get(name, false);
    if (!value->is_number_integer() || *value < 1 || *value > 1'000'000)
      fail_field(name, "is no version (1, 2, ...)");
    return value->get<int>();
  }
  bool boolean(const char* name, bool otherwise) {
    const Json* value = get(name, true);
    if (value == nullptr) return otherwise;
    if (!value->is_boolean()) fail_field(name, "is neither true nor false");
    return value->get<bool>();
  }
  std::optional<double> number(const char* name) {
    const Json* value = get(name, true);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number()) fail_field(name, "is no number");
    return value->get<double>();
  }
  const Json& list(const char* name) {
    static const Json none = Json::array();
    const Json* value = get(name, true);
    if (value == nullptr) return none;
    if (!value->is_array()) fail_field(name, "is no list");
    return *value;
  }
  const Json* get(const char* name, bool may_be_absent) {
    known_.insert(name);
    const auto found = json_.find(name);
    if (found != json_.end()) return &*found;
    if (!may_be_absent) fail(std::string("has no ") + in_quotes(name));
    return nullptr;
  }
  /// Call after all fields were read.
  void refuse_unknown() const {
    for (const auto& [name, value] : json_.items()) {
      if (!known_.contains(name)) fail("has a field " + in_quotes(name) + " that this version does not know");
    }
  }

  [[noreturn]] void fail(const std::string& why) const { throw Error(ExitCode::plugin, where_ + " " + why); }
  [[noreturn]] void fail_field(const std::string& name, const std::string& why) const {
    throw Error(ExitCode::plugin, where_ + ": " + in_quotes(name) + " " + why);
  }
  const std::string& where() const { return where_; }
  void rename(std::string where) { where_ = std::move(where); }

 private:
  const Json& json_;
  std::string where_;
  std::set<std::string, std::less<>> known_;
};

Json parse_text(std::string_view json, const char* what) {
  const json_text::Source source(what, std::string(json));
  json_text::Value root;
  std::vector<Diagnostic> findings;
  if (!json_text::parse(source, root, findings) || !findings.empty()) {
    throw Error(ExitCode::plugin, findings.front().text());
  }
  return root.json();
}

template <class Named>
void refuse_twice(const Fields& fields, const std::vector<Named>& items, const char* what) {
  std::set<std::string> names;
  for (const Named& item : items) {
    if (!names.insert(item.name).second)
      fields.fail(std::string("has two ") + what + " " + in_quotes(item.name));
  }
}

PortDecl parse_port(const Json& json, const std::string& where) {
  Fields fields(json, where);
  PortDecl port;
  port.name = fields.identifier("name");
  fields.rename(where + " " + in_quotes(port.name));
  port.type = fields.type_id("type");
  port.type_version = fields.version("type_version");
  port.doc = fields.text("doc");
  port.optional = fields.boolean("optional", false);
  port.list = fields.boolean("list", false);
  fields.refuse_unknown();
  return port;
}

ParamDecl parse_param(const Json& json, const std::string& where) {
  Fields fields(json, where);
  ParamDecl param;
  param.name = fields.identifier("name");
  fields.rename(where + " " + in_quotes(param.name));
  const std::string kind = fields.text("kind");
  if (!kind_from_name(kind, param.kind)) fields.fail_field("kind", in_quotes(kind) + " is unknown");
  if (is_list(param.kind)) fields.fail_field("kind", "is " + kind + ": lists are parameters of graphs");
  if (param.kind == ParamKind::artifact)
    fields.fail_field("kind", "is artifact: a node takes artifacts as inputs");
  param.doc = fields.text("doc");
  param.unit = fields.text("unit", true);
  param.hashed = fields.boolean("hashed", true);
  param.required = fields.boolean("required", false);
  param.minimum = fields.number("minimum");
  param.maximum = fields.number("maximum");
  param.exclusive_minimum = fields.number("exclusive_minimum");
  param.exclusive_maximum = fields.number("exclusive_maximum");
  const bool ranged = param.minimum || param.maximum || param.exclusive_minimum || param.exclusive_maximum;
  if (ranged && param.kind != ParamKind::number && param.kind != ParamKind::integer) {
    fields.fail("has a range but is of kind " + kind);
  }
  for (const Json& choice : fields.list("choices")) {
    Fields choice_fields(choice, fields.where() + ": a choice");
    param.choices.emplace_back(choice_fields.text("value"), choice_fields.text("doc"));
    choice_fields.refuse_unknown();
  }
  if ((param.kind == ParamKind::choice) == param.choices.empty()) {
    fields.fail(param.choices.empty() ? "is a choice without choices" : "has choices but is of kind " + kind);
  }
  for (const Json& scheme : fields.list("schemes")) {
    if (!scheme.is_string() || param.kind != ParamKind::file)
      fields.fail_field("schemes", "are texts of a file parameter");
    param.schemes.push_back(scheme.get<std::string>());
  }
  const Json* value = fields.get("default", true);
  fields.refuse_unknown();
  if (param.required == (value != nullptr)) {
    fields.fail(param.required ? "is required but has a default" : "is not required but has no default");
  }
  if (value != nullptr) {
    const std::string why = param.refuse(*value);
    if (!why.empty()) fields.fail_field("default", why);
    param.default_value = normalised(param, *value);
  }
  return param;
}

}  // namespace

std::string list_slot(std::string_view port, std::size_t index) {
  return std::string(port) + "[" + std::to_string(index) + "]";
}

std::string_view port_of_slot(std::string_view slot) { return slot.substr(0, slot.find('[')); }

const PortDecl* find_input(const std::vector<PortDecl>& inputs, std::string_view slot) {
  const std::string_view name = port_of_slot(slot);
  for (const PortDecl& port : inputs) {
    if (port.name == name && port.list == (name.size() != slot.size())) return &port;
  }
  return nullptr;
}

const PortDecl* NodeDeclaration::input(std::string_view name) const {
  for (const PortDecl& port : inputs) {
    if (port.name == name) return &port;
  }
  return nullptr;
}

const PortDecl* NodeDeclaration::output(std::string_view name) const {
  for (const PortDecl& port : outputs) {
    if (port.name == name) return &port;
  }
  return nullptr;
}

const ParamDecl* NodeDeclaration::param(std::string_view name) const {
  for (const ParamDecl& candidate : params) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

bool NodeDeclaration::same_content(const NodeDeclaration& other) const {
  const auto content = [](const NodeDeclaration& d) {
    return std::tie(d.id, d.version, d.summary, d.doc, d.avoid_when, d.cites, d.libraries, d.uses_seed,
                    d.memory_fixed, d.memory_per_input_byte, d.inputs, d.outputs, d.params);
  };
  return content(*this) == content(other);
}

bool TypeDeclaration::same_content(const TypeDeclaration& other) const {
  const auto content = [](const TypeDeclaration& d) {
    return std::tie(d.id, d.version, d.doc, d.arrays, d.summary);
  };
  return content(*this) == content(other);
}

NodeDeclaration parse_node_declaration(std::string_view text) {
  const Json json = parse_text(text, "declaration of a node");
  Fields fields(json, "declaration of a node");
  NodeDeclaration node;
  node.id = fields.type_id("id");
  fields.rename("node " + in_quotes(node.id));
  const std::set<std::string> reserved = {"artifact", "graph",     "loop",    "map",
                                          "node",     "parameter", "subgraph"};
  if (reserved.contains(node.id)) fields.fail_field("id", "is reserved; put a namespace in front of it");
  node.version = fields.version("version");
  node.summary = fields.text("summary");
  node.doc = fields.text("doc");
  node.avoid_when = fields.text("avoid_when", true);
  for (const Json& cite : fields.list("cites")) {
    Fields cite_fields(cite, fields.where() + ": a citation");
    node.cites.push_back({cite_fields.text("key"), cite_fields.text("where")});
    cite_fields.refuse_unknown();
  }
  if (const Json* libraries = fields.get("libraries", true)) {
    if (!libraries->is_object()) fields.fail_field("libraries", "is no JSON object");
    for (const auto& [name, version] : libraries->items()) {
      if (!version.is_string())
        fields.fail_field("libraries", "gives " + in_quotes(name) + " a version that is no text");
      node.libraries[name] = version.get<std::string>();
    }
  }
  node.uses_seed = fields.boolean("uses_seed", false);
  if (const Json* memory = fields.get("memory", true)) {
    Fields memory_fields(*memory, fields.where() + ": \"memory\"");
    const double fixed = memory_fields.number("fixed").value_or(0);
    const double per_byte = memory_fields.number("per_input_byte").value_or(0);
    memory_fields.refuse_unknown();
    if (!(fixed >= 0 && fixed < 0x1p63) || !(per_byte >= 0))
      fields.fail_field("memory", "is negative or too large");
    node.memory_fixed = static_cast<std::uint64_t>(fixed);
    node.memory_per_input_byte = per_byte;
  }
  for (const Json& port : fields.list("inputs"))
    node.inputs.push_back(parse_port(port, fields.where() + ": input"));
  for (const Json& port : fields.list("outputs"))
    node.outputs.push_back(parse_port(port, fields.where() + ": output"));
  for (const Json& param : fields.list("params"))
    node.params.push_back(parse_param(param, fields.where() + ": parameter"));
  fields.refuse_unknown();
  refuse_twice(fields, node.inputs, "inputs");
  refuse_twice(fields, node.outputs, "outputs");
  refuse_twice(fields, node.params, "parameters");
  for (const PortDecl& port : node.outputs) {
    if (port.list)
      fields.fail("has an output " + in_quotes(port.name) + " that is a list; only inputs may be lists");
    if (port.optional)
      fields.fail("has an optional output " + in_quotes(port.name) + "; only inputs may be optional");
  }
  return node;
}

TypeDeclaration parse_type_declaration(std::string_view text) {
  const Json json = parse_text(text, "declaration of a type");
  Fields fields(json, "declaration of a type");
  TypeDeclaration type;
  type.id = fields.type_id("id");
  fields.rename("type " + in_quotes(type.id));
  type.version = fields.version("version");
  type.doc = fields.text("doc");
  for (const Json& item : fields.list("arrays")) {
    Fields array_fields(item, fields.where() + ": array");
    ArrayDecl array;
    array.name = array_fields.identifier("name");
    array_fields.rename(fields.where() + ": array " + in_quotes(array.name));
    array.dtype = array_fields.text("dtype");
    const std::set<std::string> dtypes = {"f64", "f32", "i64", "i32", "u32", "u16", "u8"};
    if (!dtypes.contains(array.dtype))
      array_fields.fail_field("dtype", in_quotes(array.dtype) + " is unknown");
    array.doc = array_fields.text("doc", true);
    array.optional = array_fields.boolean("optional", false);
    const Json& shape = array_fields.list("shape");
    if (shape.size() > BALLFLOW_MAX_RANK) array_fields.fail_field("shape", "has more than 4 dimensions");
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const bool named = shape[i].is_string() && !shape[i].get_ref<const std::string&>().empty();
      const bool fixed = shape[i].is_number_integer() && shape[i] >= 0;
      if (!(fixed || (named && i == 0)))
        array_fields.fail_field("shape", "holds fixed lengths and at most a name in front");
      array.shape.push_back(shape[i]);
    }
    array_fields.refuse_unknown();
    type.arrays.push_back(std::move(array));
  }
  for (const Json& item : fields.list("summary")) {
    Fields field(item, fields.where() + ": a field of the summary");
    type.summary.emplace_back(field.text("name"), field.text("doc"));
    field.refuse_unknown();
  }
  fields.refuse_unknown();
  refuse_twice(fields, type.arrays, "arrays");
  return type;
}

}  // namespace ballflow
