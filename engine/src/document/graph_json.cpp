#include "document/graph_json.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/quote.hpp"

namespace ballflow {

using json_text::Member;
using json_text::Value;

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

bool read_text(const GraphFile& file, Findings& findings, const Member& member, std::string& to) {
  if (member.value.is_string()) {
    to = member.value.string();
    return true;
  }
  findings.error(file, member.value.offset,
                 in_quotes(member.key) + " must be a text, " + described(member.value.scalar));
  return false;
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
    each(root, "params", [&](const Member& member) { add_param(member); });
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

  bool text(const Member& member, std::string& to) { return read_text(file_, findings_, member, to); }

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

  void add_param(const Member& member) {
    GraphParam param = read_param(file_, findings_, member);
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
    for (const GraphParam& other : file_.params) {
      if (other.alias == member.key)
        error(member.offset,
              in_quotes(member.key) + " is the alias of " + in_quotes(other.decl.name) + " already");
    }
    file_.param_index.emplace(member.key, file_.params.size());
    file_.params.push_back(std::move(param));
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
    const bool keys_known = known_keys(member.value, "a node",
                                       {"type", "graph", "loop", "map", "over", "index", "inputs", "params",
                                        "until", "max_iterations", "at_limit", "doc"});
    const char* kind = nullptr;
    for (const char* const key : {"type", "graph", "loop", "map"}) {
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
        error(
            node.offset, "node " + in_quotes(node.name) + " has no \"type\", \"graph\", \"loop\" or \"map\"",
            "\"type\" names a node type, \"graph\" the file of a subgraph, \"loop\" and \"map\" that of the "
            "body of a loop or map");
      }
      node.broken = true;
    }
    const bool is_loop = member.value.find("loop") != nullptr;
    if (is_loop && member.value.find("until") == nullptr)
      error(node.offset, "loop " + in_quotes(node.name) + " has no \"until\"",
            "\"until\": \"state.field == 0\", a field of the summary of a state");
    const bool is_map = member.value.find("map") != nullptr;
    if (is_map && member.value.find("over") == nullptr)
      error(node.offset, "map " + in_quotes(node.name) + " has no \"over\"",
            "\"over\": { \"parameter\": \"${list}\" }, a parameter of the body and the list it goes through");
    std::vector<GraphNode::Param> loop_params, over;
    std::string index;
    Offset index_offset = 0;
    for (const Member& field : member.value.members) {
      if (field.key == "doc") text(field, ignored_);
      if (field.key == "until" || field.key == "max_iterations" || field.key == "at_limit") {
        if (is_loop) {
          loop_params.push_back({field.key, field.offset, read_template(file_, findings_, field.value)});
        } else {
          error(field.offset,
                in_quotes(field.key) + " is for loops, node " + in_quotes(node.name) + " is none",
                "\"loop\": \"body.json\" makes a node a loop");
        }
      }
      if (field.key == "index" && !is_map) {
        error(field.offset, "\"index\" is for maps, node " + in_quotes(node.name) + " is none",
              "\"map\": \"body.json\" makes a node a map");
      } else if (field.key == "index" && text(field, index)) {
        index_offset = field.value.offset;
      }
      if (field.key == "over" && !is_map) {
        error(field.offset, "\"over\" is for maps, node " + in_quotes(node.name) + " is none",
              "\"map\": \"body.json\" makes a node a map");
      } else if (field.key == "over" && object(field)) {
        for (const Member& item : field.value.members)
          over.push_back({item.key, item.offset, read_template(file_, findings_, item.value)});
        if (over.empty())
          error(field.value.offset, "map " + in_quotes(node.name) + " goes over nothing",
                "\"over\": { \"parameter\": \"${list}\" }");
      }
      if (field.key == "type" || field.key == "graph" || field.key == "loop" || field.key == "map") {
        std::string written;
        if (!text(field, written)) {
          node.broken = true;
        } else if (field.key == "type") {
          node.kind = GraphNode::Declared{std::move(written), field.value.offset};
        } else if (field.key == "graph") {
          node.kind = GraphNode::Subgraph{read_template(file_, findings_, field.value)};
        } else if (field.key == "loop") {
          node.kind = GraphNode::Loop{read_template(file_, findings_, field.value), {}};
        } else {
          node.kind = GraphNode::Map{read_template(file_, findings_, field.value), {}};
        }
      }
      if (field.key == "inputs" && object(field)) {
        for (const Member& item : field.value.members) {
          if (!item.value.is_array()) {
            node.inputs.push_back(
                {item.key, item.offset, read_reference(file_, findings_, item.value, &node), std::nullopt});
            continue;
          }
          for (std::size_t i = 0; i < item.value.members.size(); ++i)
            node.inputs.push_back({item.key, item.offset,
                                   read_reference(file_, findings_, item.value.members[i].value, &node), i});
        }
      }
      if (field.key == "params" && object(field)) {
        for (const Member& item : field.value.members) {
          node.params.push_back({item.key, item.offset, read_template(file_, findings_, item.value)});
        }
      }
    }
    const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
    std::stable_sort(node.inputs.begin(), node.inputs.end(),
                     [](const auto& a, const auto& b) { return a.port < b.port; });
    std::sort(node.params.begin(), node.params.end(), by_name);
    std::sort(loop_params.begin(), loop_params.end(), by_name);
    if (auto* loop = std::get_if<GraphNode::Loop>(&node.kind)) loop->params = std::move(loop_params);
    if (auto* map = std::get_if<GraphNode::Map>(&node.kind)) {
      map->over = std::move(over);
      map->index = std::move(index);
      map->index_offset = index_offset;
      if (map->over.empty()) node.broken = true;  // reported
    }
    if (node.broken) node.kind = {};
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
        if (field.key == "from") output.from = read_reference(file_, findings_, field.value, nullptr);
      }
      if (member.value.find("from") == nullptr) {
        error(member.offset, "output " + in_quotes(member.key) + " has no \"from\"",
              "\"from\": \"node.port\"");
      }
    } else {
      output.from = read_reference(file_, findings_, member.value, nullptr);
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
      // Of a loop's body: the state at the beginning, which an iteration may replace without a look at it.
      // A graph without nodes is the choice to do nothing, among others that need what it is given.
      if (file_.output_index.contains(input.name) || file_.nodes.empty()) continue;
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
