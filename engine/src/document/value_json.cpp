// What stands in a graph file for something else: "${name}" for the value of a parameter, "node.port" for
// what a node gives.
#include <utility>

#include "base/quote.hpp"
#include "document/graph_json.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {
namespace {

using json_text::Value;

class ValueReader {
 public:
  ValueReader(GraphFile& file, Findings& findings) : file_(file), findings_(findings) {}

  Template read_template(const Value& value) {
    Template result;
    result.offset = value.offset;
    if (value.is_array()) return read_list(value, std::move(result));
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
          } else if (is_list(file_.params[found->second].decl.kind) &&
                     (at != 0 || close + 1 != source.size())) {
            error(value.offset, "parameter " + in_quotes(name) + " is a list, which is no part of a text",
                  "let it stand alone: \"${" + name + "}\"");
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

  /// A list as it stands; parameters inside are not looked for.
  Template read_list(const Value& value, Template result) {
    for (const json_text::Member& entry : value.members) {
      if (!entry.value.is_string() || entry.value.string().find("${") == std::string::npos) continue;
      error(entry.value.offset, "a list cannot have parameters in it",
            "declare the whole list as a parameter of kind list");
      result.broken = true;
    }
    result.fixed = value.json();
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

 private:
  void error(Offset offset, std::string message, std::string hint = {}) {
    findings_.error(file_, offset, std::move(message), std::move(hint));
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
};

}  // namespace

Template read_template(GraphFile& file, Findings& findings, const Value& value) {
  return ValueReader(file, findings).read_template(value);
}

Reference read_reference(GraphFile& file, Findings& findings, const Value& value, const GraphNode* consumer) {
  return ValueReader(file, findings).read_reference(value, consumer);
}

}  // namespace ballflow
