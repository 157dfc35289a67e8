#include "document/graph_json.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/quote.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

using json_text::Member;
using json_text::Value;

std::optional<Json> Template::evaluate(const std::vector<std::optional<Json>>& params) const {
  if (broken) return std::nullopt;
  if (fixed) return *fixed;
  for (const Part& part : parts) {
    if (part.param && !params[*part.param]) return std::nullopt;
  }
  if (parts.size() == 1 && parts[0].param) return params[*parts[0].param];
  std::string text;
  for (const Part& part : parts) text += part.param ? plain_text(*params[*part.param]) : part.text;
  return Json(std::move(text));
}

namespace {

template <class Item, class Key>
const Item* find_sorted(const std::vector<Item>& items, const std::string& name, Key key) {
  const auto place =
      std::lower_bound(items.begin(), items.end(), name,
                       [&](const Item& item, const std::string& wanted) { return item.*key < wanted; });
  return place != items.end() && (*place).*key == name ? &*place : nullptr;
}

}  // namespace

const GraphNode::Input* GraphNode::input(const std::string& port) const {
  return find_sorted(inputs, port, &Input::port);
}
const GraphNode::Param* GraphNode::param(const std::string& wanted) const {
  return find_sorted(params, wanted, &Param::name);
}
const GraphNode::Param* GraphNode::Loop::param(const std::string& wanted) const {
  return find_sorted(params, wanted, &Param::name);
}

void Findings::error(const GraphFile& file, Offset offset, std::string message, std::string hint) {
  add(json_text::finding(file.source, file.root, offset, std::move(message), std::move(hint)));
}

void Findings::warning(const GraphFile& file, Offset offset, std::string message, std::string hint) {
  add(json_text::finding(file.source, file.root, offset, std::move(message), std::move(hint),
                         Diagnostic::Severity::warning));
}

void Findings::add(Diagnostic finding) {
  const std::string key = finding.file + '\0' + std::to_string(finding.line) + ':' +
                          std::to_string(finding.column) + '\0' + finding.message;
  if (!keys_.insert(key).second) return;
  failed_ = failed_ || finding.severity == Diagnostic::Severity::error;
  all_.push_back(std::move(finding));
}

std::vector<Diagnostic> Findings::take(const std::vector<std::string>& files) {
  std::map<std::string, std::size_t> rank;
  for (const std::string& file : files) rank.try_emplace(file, rank.size());
  const auto key = [&](const Diagnostic& d) {
    const auto file = rank.find(d.file);
    return std::make_tuple(file == rank.end() ? rank.size() : file->second, std::cref(d.file), d.line,
                           d.column, std::cref(d.message));
  };
  std::sort(all_.begin(), all_.end(),
            [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  return std::move(all_);
}

bool known_keys(const GraphFile& file, Findings& findings, const Value& object, const std::string& what,
                const std::vector<std::string>& known) {
  bool good = true;
  for (const Member& member : object.members) {
    if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
    std::string hint = did_you_mean(member.key, known);
    findings.error(file, member.offset, "unknown key " + in_quotes(member.key),
                   hint.empty() ? what + " has the keys " + listed(known) : std::move(hint));
    good = false;
  }
  return good;
}

namespace {

/// Names of nodes: also - inside, because paths and edges only use / and . as separators.
bool is_node_name(std::string_view text) {
  if (text.empty() || text.size() > 200 || text[0] == '-') return false;
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '-' || is_identifier(std::string("_") + c); });
}

class Reader {
 public:
  Reader(GraphFile& file, Findings& findings) : file_(file), findings_(findings) {}

  void read() {
    const Value& root = file_.root;
    known_keys(root, "a graph", {"$schema", "doc", "params", "inputs", "nodes", "outputs", "sweep", "map"});
    for (const Member& member : root.members) {
      if (member.key == "$schema") text(member, ignored_);
      if (member.key == "doc") text(member, file_.doc);
    }
    // Parameters, inputs and node names first: everything else refers to them.
    each(root, "params", [&](const Member& member) { read_param(member); });
    each(root, "inputs", [&](const Member& member) { read_input(member); });
    each(root, "nodes", [&](const Member& member) { declare_node(member); });
    if (root.find("nodes") == nullptr)
      error(root.offset, "a graph has \"nodes\"", "\"nodes\": { \"name\": { \"type\": \"...\" } }");
    std::size_t index = 0;
    each(root, "nodes", [&](const Member& member) { read_node(member, file_.nodes[index++]); });
    each(root, "outputs", [&](const Member& member) { read_output(member); });
    read_sweep(file_, findings_);
    warn_unused();
  }

 private:
  void error(Offset offset, std::string message, std::string hint = {}) {
    findings_.error(file_, offset, std::move(message), std::move(hint));
  }

  bool known_keys(const Value& object, const std::string& what, const std::vector<std::string>& known) {
    return ballflow::known_keys(file_, findings_, object, what, known);
  }

  bool text(const Member& member, std::string& to) {
    if (member.value.is_string()) {
      to = member.value.string();
      return true;
    }
    error(member.value.offset, in_quotes(member.key) + " must be a text, " + described(member.value.scalar));
    return false;
  }

  bool object(const Member& member) {
    if (member.value.is_object()) return true;
    error(member.value.offset,
          in_quotes(member.key) + " must be an object, " + described(member.value.scalar));
    return false;
  }

  template <class Function>
  void each(const Value& owner, const char* key, Function function) {
    for (const Member& member : owner.members) {
      if (member.key != key) continue;
      if (!member.value.is_object()) {
        if (sections_complained_.insert(member.offset).second) object(member);
        continue;
      }
      for (const Member& item : member.value.members) function(item);
    }
  }

  void read_param(const Member& member) {
    GraphParam param;
    param.offset = member.offset;
    param.decl.name = member.key;
    param.broken = !read_param_fields(member, param.decl);
    if (param.decl.kind == ParamKind::artifact) {
      GraphInput input;
      input.name = member.key;
      input.type = param.decl.type;
      input.offset = input.type_offset = member.offset;
      if (const Value* type = member.value.find("type")) input.type_offset = type->offset;
      input.broken = param.broken;
      input.param = file_.params.size();
      file_.input_index.emplace(member.key, file_.inputs.size());
      file_.inputs.push_back(std::move(input));
    }
    file_.param_index.emplace(member.key, file_.params.size());
    file_.params.push_back(std::move(param));
  }

  bool read_param_fields(const Member& member, ParamDecl& decl) {
    bool good = true;
    if (!is_identifier(member.key)) {
      error(member.offset, in_quotes(member.key) + " is no name of a parameter",
            "use letters, digits and _, no digit first");
      good = false;
    }
    if (!member.value.is_object()) {
      error(member.value.offset,
            "parameter " + in_quotes(member.key) + " must be an object, " + described(member.value.scalar),
            "{ \"kind\": \"number\", \"default\": 0, \"doc\": \"...\" }");
      return false;
    }
    good = known_keys(member.value, "a parameter",
                      {"kind", "default", "minimum", "maximum", "choices", "unit", "doc", "type"}) &&
           good;
    const Value* kind = member.value.find("kind");
    if (kind == nullptr) {
      error(member.offset, "parameter " + in_quotes(member.key) + " has no \"kind\"",
            "kinds are number, integer, boolean, string, choice, file and artifact");
      return false;
    }
    if (!kind->is_string() || !kind_from_name(kind->string(), decl.kind)) {
      std::string hint = kind->is_string()
                             ? did_you_mean(kind->string(), {"number", "integer", "boolean", "string",
                                                             "choice", "file", "artifact"})
                             : "";
      error(kind->offset,
            kind->is_string() ? "unknown kind " + in_quotes(kind->string())
                              : "\"kind\" must be a text, " + described(kind->scalar),
            hint.empty() ? "kinds are number, integer, boolean, string, choice, file and artifact" : hint);
      return false;
    }
    const Value* default_value = nullptr;
    const Member* choices = nullptr;
    for (const Member& field : member.value.members) {
      if (field.key == "doc") good = text(field, decl.doc) && good;
      if (field.key == "unit") good = text(field, decl.unit) && good;
      if (field.key == "minimum") good = bound(field, decl, decl.minimum) && good;
      if (field.key == "maximum") good = bound(field, decl, decl.maximum) && good;
      if (field.key == "choices") good = read_choices(*(choices = &field), decl) && good;
      if (field.key == "default") default_value = &field.value;
      if (field.key == "type") good = artifact_type(field, decl) && good;
    }
    if (decl.kind == ParamKind::artifact && decl.type.empty()) {
      if (good)
        error(member.offset, "parameter " + in_quotes(member.key) + " is an artifact without \"type\"",
              "\"type\": \"PointSet\"");
      return false;
    }
    if (decl.kind == ParamKind::choice && choices == nullptr) {
      error(member.offset, "parameter " + in_quotes(member.key) + " is a choice without \"choices\"",
            "\"choices\": [\"a\", \"b\"]");
      return false;
    }
    decl.required = default_value == nullptr;
    if (default_value == nullptr || !good) return good;
    if (std::string why = decl.refuse(default_value->scalar); !why.empty()) {
      error(default_value->offset, "the default of " + in_quotes(member.key) + " " + why,
            choice_hint(decl, default_value->scalar));
      return false;
    }
    decl.default_value = normalised(decl, default_value->scalar);
    return true;
  }

  bool artifact_type(const Member& field, ParamDecl& decl) {
    if (decl.kind != ParamKind::artifact) {
      error(field.offset, std::string("\"type\" is for the kind artifact, the parameter is of kind ") +
                              kind_name(decl.kind));
      return false;
    }
    return text(field, decl.type);
  }

  bool bound(const Member& field, const ParamDecl& decl, std::optional<double>& to) {
    if (decl.kind != ParamKind::number && decl.kind != ParamKind::integer) {
      error(field.offset,
            in_quotes(field.key) + " is for numbers, the parameter is of kind " + kind_name(decl.kind));
      return false;
    }
    if (!field.value.scalar.is_number()) {
      error(field.value.offset, in_quotes(field.key) + " must be a number, " + described(field.value.scalar));
      return false;
    }
    to = field.value.scalar.get<double>();
    return true;
  }

  bool read_choices(const Member& field, ParamDecl& decl) {
    if (decl.kind != ParamKind::choice) {
      error(field.offset, std::string("\"choices\" are for the kind choice, the parameter is of kind ") +
                              kind_name(decl.kind));
      return false;
    }
    if (!field.value.is_array() || field.value.members.empty()) {
      error(field.value.offset, "\"choices\" must be a list of texts",
            "[\"a\", \"b\"] or [{ \"value\": \"a\", \"doc\": \"...\" }]");
      return false;
    }
    bool good = true;
    for (const Member& item : field.value.members) {
      const Value* value = &item.value;
      std::string doc;
      if (item.value.is_object()) {
        good = known_keys(item.value, "a choice", {"value", "doc"}) && good;
        for (const Member& part : item.value.members) {
          if (part.key == "doc") good = text(part, doc) && good;
        }
        value = item.value.find("value");
      }
      if (value == nullptr || !value->is_string()) {
        error(item.offset, "a choice must be a text", "\"a\" or { \"value\": \"a\", \"doc\": \"...\" }");
        good = false;
        continue;
      }
      const auto same = [&](const auto& choice) { return choice.first == value->string(); };
      if (std::any_of(decl.choices.begin(), decl.choices.end(), same)) {
        error(value->offset, "the choice " + in_quotes(value->string()) + " is listed twice");
        good = false;
      }
      decl.choices.emplace_back(value->string(), doc);
    }
    return good;
  }

  static std::string choice_hint(const ParamDecl& decl, const Json& value) {
    if (decl.kind != ParamKind::choice || !value.is_string()) return {};
    std::vector<std::string> names;
    for (const auto& choice : decl.choices) names.push_back(choice.first);
    return did_you_mean(value.get<std::string>(), names);
  }

  void read_input(const Member& member) {
    GraphInput input;
    input.name = member.key;
    input.offset = input.type_offset = member.offset;
    input.broken = true;
    if (!is_identifier(member.key)) {
      error(member.offset, in_quotes(member.key) + " is no name of an input",
            "use letters, digits and _, no digit first");
    } else if (file_.input_index.contains(member.key)) {
      error(member.offset, "the parameter " + in_quotes(member.key) + " is an input of this name already",
            "remove one of them");
    } else if (!member.value.is_object()) {
      error(member.value.offset,
            "input " + in_quotes(member.key) + " must be an object, " + described(member.value.scalar),
            "{ \"type\": \"PointSet\", \"doc\": \"...\" }");
    } else {
      known_keys(member.value, "an input", {"type", "optional", "doc"});
      for (const Member& field : member.value.members) {
        if (field.key == "type" && text(field, input.type)) {
          input.type_offset = field.value.offset;
          input.broken = false;
        }
        if (field.key == "doc") text(field, ignored_);
        if (field.key == "optional") {
          if (field.value.scalar.is_boolean()) {
            input.optional = field.value.scalar.get<bool>();
          } else {
            error(field.value.offset, "\"optional\" must be true or false, " + described(field.value.scalar));
          }
        }
      }
      if (member.value.find("type") == nullptr)
        error(member.offset, "input " + in_quotes(member.key) + " has no \"type\"");
    }
    file_.input_index.emplace(member.key, file_.inputs.size());
    file_.inputs.push_back(std::move(input));
  }

  void declare_node(const Member& member) {
    GraphNode node;
    node.name = member.key;
    node.offset = member.offset;
    if (member.key == "inputs") {
      error(member.offset, "no node can be named \"inputs\"", "\"inputs.x\" means the input x of the graph");
      node.broken = true;
    } else if (!is_node_name(member.key)) {
      error(member.offset, in_quotes(member.key) + " is no name of a node", "use letters, digits, _ and -");
      node.broken = true;
    }
    file_.node_index.emplace(member.key, file_.nodes.size());
    file_.nodes.push_back(std::move(node));
  }

  void read_node(const Member& member, GraphNode& node) {
    if (!member.value.is_object()) {
      error(member.value.offset,
            "node " + in_quotes(member.key) + " must be an object, " + described(member.value.scalar),
            "{ \"type\": \"...\", \"inputs\": { }, \"params\": { } }");
      node.broken = true;
      return;
    }
    const bool keys_known = known_keys(
        member.value, "a node",
        {"type", "graph", "loop", "inputs", "params", "until", "max_iterations", "at_limit", "doc"});
    const char* kind = nullptr;
    for (const char* const key : {"type", "graph", "loop"}) {
      const Value* value = member.value.find(key);
      if (value == nullptr) continue;
      if (kind != nullptr) {
        error(value->offset,
              "node " + in_quotes(node.name) + " has both " + in_quotes(kind) + " and " + in_quotes(key),
              "keep one of them");
        node.broken = true;
      }
      kind = key;
    }
    if (kind == nullptr) {
      // With an unknown key the missing one is probably that one, which was reported.
      if (keys_known) {
        error(node.offset, "node " + in_quotes(node.name) + " has no \"type\", \"graph\" or \"loop\"",
              "\"type\" names a node type, \"graph\" the file of a subgraph, \"loop\" that of the body of a "
              "loop");
      }
      node.broken = true;
    }
    const bool is_loop = member.value.find("loop") != nullptr;
    if (is_loop && member.value.find("until") == nullptr)
      error(node.offset, "loop " + in_quotes(node.name) + " has no \"until\"",
            "\"until\": \"state.field == 0\", a field of the summary of a state");
    std::vector<GraphNode::Param> loop_params;
    for (const Member& field : member.value.members) {
      if (field.key == "doc") text(field, ignored_);
      if (field.key == "until" || field.key == "max_iterations" || field.key == "at_limit") {
        if (is_loop) {
          loop_params.push_back({field.key, field.offset, read_template(field.value)});
        } else {
          error(field.offset,
                in_quotes(field.key) + " is for loops, node " + in_quotes(node.name) + " is none",
                "\"loop\": \"body.json\" makes a node a loop");
        }
      }
      if (field.key == "type" || field.key == "graph" || field.key == "loop") {
        std::string written;
        if (!text(field, written)) {
          node.broken = true;
        } else if (field.key == "type") {
          node.kind = GraphNode::Declared{std::move(written), field.value.offset};
        } else if (field.key == "graph") {
          node.kind = GraphNode::Subgraph{read_template(field.value)};
        } else {
          node.kind = GraphNode::Loop{read_template(field.value), {}};
        }
      }
      if (field.key == "inputs" && object(field)) {
        for (const Member& item : field.value.members) {
          if (!item.value.is_array()) {
            node.inputs.push_back({item.key, item.offset, read_reference(item.value, &node), std::nullopt});
            continue;
          }
          for (std::size_t i = 0; i < item.value.members.size(); ++i)
            node.inputs.push_back(
                {item.key, item.offset, read_reference(item.value.members[i].value, &node), i});
        }
      }
      if (field.key == "params" && object(field)) {
        for (const Member& item : field.value.members) {
          node.params.push_back({item.key, item.offset, read_template(item.value)});
        }
      }
    }
    const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
    std::stable_sort(node.inputs.begin(), node.inputs.end(),
                     [](const auto& a, const auto& b) { return a.port < b.port; });
    std::sort(node.params.begin(), node.params.end(), by_name);
    std::sort(loop_params.begin(), loop_params.end(), by_name);
    if (auto* loop = std::get_if<GraphNode::Loop>(&node.kind)) loop->params = std::move(loop_params);
    if (node.broken) node.kind = {};
  }

  Template read_template(const Value& value) {
    Template result;
    result.offset = value.offset;
    if (!value.is_string()) {
      result.fixed = value.scalar;
      return result;
    }
    const std::string& source = value.string();
    std::string plain;
    for (std::size_t at = 0; at < source.size();) {
      if (source.compare(at, 3, "$${") == 0) {
        plain += "${";
        at += 3;
      } else if (source.compare(at, 2, "${") == 0) {
        const std::size_t close = source.find('}', at);
        if (close == std::string::npos) {
          error(value.offset, "\"${\" without \"}\" in " + in_quotes(source), "write $${ for a literal ${");
          result.broken = true;
          return result;
        }
        const std::string name = source.substr(at + 2, close - at - 2);
        const auto found = file_.param_index.find(name);
        if (found == file_.param_index.end()) {
          std::string hint =
              did_you_mean(name, names_of(file_.params, [](const GraphParam& p) { return p.decl.name; }));
          error(value.offset, "the graph has no parameter " + in_quotes(name),
                hint.empty() ? "declare it under \"params\"" : hint);
          result.broken = true;
        } else {
          file_.params[found->second].used = true;
          if (file_.params[found->second].decl.kind == ParamKind::artifact) {
            error(value.offset, "parameter " + in_quotes(name) + " is an artifact, which is no value",
                  "connect it to an input of a node: \"${" + name + "}\"");
            result.broken = true;
          }
          if (!plain.empty()) result.parts.push_back({std::move(plain), std::nullopt});
          plain.clear();
          result.parts.push_back({"", found->second});
        }
        at = close + 1;
      } else {
        plain += source[at++];
      }
    }
    if (result.parts.empty()) {
      result.fixed = Json(std::move(plain));
    } else if (!plain.empty()) {
      result.parts.push_back({std::move(plain), std::nullopt});
    }
    return result;
  }

  /// "${balls}"
  Reference read_parameter_edge(const Value& value, Reference result) {
    const std::string& source = value.string();
    result.port = source.substr(2, source.size() - 3);
    const auto found = file_.param_index.find(result.port);
    if (found == file_.param_index.end()) {
      std::string hint =
          did_you_mean(result.port, names_of(file_.params, [](const GraphParam& p) { return p.decl.name; }));
      error(value.offset, "the graph has no parameter " + in_quotes(result.port),
            hint.empty() ? "declare it under \"params\"" : hint);
      return result;
    }
    GraphParam& param = file_.params[found->second];
    param.used = true;
    if (param.decl.kind != ParamKind::artifact) {
      if (!param.broken)
        error(value.offset, "parameter " + in_quotes(result.port) + " is of kind " +
                                kind_name(param.decl.kind) + ", an edge needs an artifact");
      return result;
    }
    result.kind = Reference::Kind::input;
    result.index = file_.input_index.at(result.port);
    file_.inputs[result.index].used = true;
    return result;
  }

  Reference read_reference(const Value& value, const GraphNode* consumer) {
    Reference result;
    result.offset = value.offset;
    if (!value.is_string()) {
      error(value.offset, "an edge must be a text \"node.port\", " + described(value.scalar));
      return result;
    }
    const std::string& source = value.string();
    if (source.starts_with("${") && source.ends_with('}'))
      return read_parameter_edge(value, std::move(result));
    const std::size_t dot = source.find('.');
    const std::string owner = source.substr(0, dot);
    result.port = dot == std::string::npos ? std::string() : source.substr(dot + 1);
    if (result.port.empty()) {
      error(value.offset, "an edge must be \"node.port\", " + described(value.scalar),
            file_.node_index.contains(owner) ? "name the output port too: \"" + owner + ".<port>\""
                                             : std::string());
      return result;
    }
    if (owner == "inputs") {
      const auto found = file_.input_index.find(result.port);
      if (found == file_.input_index.end()) {
        const auto names = names_of(file_.inputs, [](const GraphInput& i) { return i.name; });
        std::string hint = did_you_mean(result.port, names);
        if (hint.empty())
          hint = names.empty() ? "the graph declares no \"inputs\"" : "inputs are " + listed(names);
        error(value.offset, "the graph has no input " + in_quotes(result.port), std::move(hint));
        return result;
      }
      file_.inputs[found->second].used = true;
      result.kind = Reference::Kind::input;
      result.index = found->second;
      return result;
    }
    const auto found = file_.node_index.find(owner);
    if (found == file_.node_index.end()) {
      const auto names = names_of(file_.nodes, [](const GraphNode& n) { return n.name; });
      std::string hint = did_you_mean(owner, names);
      error(value.offset, "the graph has no node " + in_quotes(owner),
            hint.empty() ? "nodes are " + listed(names) : hint);
      return result;
    }
    GraphNode& producer = file_.nodes[found->second];
    if (&producer != consumer) producer.used = true;
    result.kind = Reference::Kind::node;
    result.index = found->second;
    return result;
  }

  void read_output(const Member& member) {
    GraphOutput output;
    output.name = member.key;
    output.offset = member.offset;
    if (!is_identifier(member.key)) {
      error(member.offset, in_quotes(member.key) + " is no name of an output",
            "use letters, digits and _, no digit first");
    }
    if (member.value.is_object()) {
      known_keys(member.value, "an output", {"from", "doc"});
      for (const Member& field : member.value.members) {
        if (field.key == "doc") text(field, output.doc);
        if (field.key == "from") output.from = read_reference(field.value, nullptr);
      }
      if (member.value.find("from") == nullptr) {
        error(member.offset, "output " + in_quotes(member.key) + " has no \"from\"",
              "\"from\": \"node.port\"");
      }
    } else {
      output.from = read_reference(member.value, nullptr);
    }
    file_.output_index.emplace(member.key, file_.outputs.size());
    file_.outputs.push_back(std::move(output));
  }

  void warn_unused() {
    for (const GraphParam& param : file_.params) {
      if (!param.used && !param.broken) {
        findings_.warning(file_, param.offset, "parameter " + in_quotes(param.decl.name) + " is not used");
      }
    }
    for (const GraphInput& input : file_.inputs) {
      if (!input.used && !input.broken && !input.param)
        findings_.warning(file_, input.offset, "input " + in_quotes(input.name) + " is not used");
    }
    for (const GraphNode& node : file_.nodes) {
      if (!node.used && !node.broken) {
        findings_.warning(file_, node.offset, "nothing uses the outputs of node " + in_quotes(node.name),
                          "name one of them under \"outputs\", or remove the node");
      }
    }
  }

  /// Names to suggest. Bounded, so that a large file full of misspellings stays fast.
  template <class Item, class Name>
  std::vector<std::string> names_of(const std::vector<Item>& items, Name name) const {
    std::vector<std::string> names;
    const std::size_t most = findings_.size() < 200 ? 10'000 : 20;
    for (std::size_t i = 0; i < items.size() && i < most; ++i) names.push_back(name(items[i]));
    return names;
  }

  GraphFile& file_;
  Findings& findings_;
  std::set<Offset> sections_complained_;
  std::string ignored_;
};

}  // namespace

std::unique_ptr<GraphFile> read_graph_file(json_text::Source source, Findings& findings) {
  auto file = std::make_unique<GraphFile>(std::move(source));
  std::vector<Diagnostic> problems;
  const bool complete = json_text::parse(file->source, file->root, problems);
  for (Diagnostic& problem : problems) findings.add(std::move(problem));
  if (!complete) return nullptr;
  if (!file->root.is_object()) {
    findings.error(*file, file->root.offset, "a graph must be an object, " + described(file->root.scalar),
                   "{ \"nodes\": { } }");
    return nullptr;
  }
  Reader(*file, findings).read();
  return file;
}

}  // namespace ballflow
