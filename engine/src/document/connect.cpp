// Which output each input reads, and whether the types agree.
#include "document/connect.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "ballflow/text.hpp"
#include "base/quote.hpp"

namespace ballflow {

namespace {

class Connector {
 public:
  Connector(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, References& references, Findings& findings)
      : expansion_(expansion), given_(given), references_(references), findings_(findings) {
    for (const auto& [id, type] : registry.types().unparsed()) type_names_.push_back(id);
    for (const auto& [id, node] : registry.nodes().unparsed()) {
      for (const PortOutline& port : node->ports) {
        if (!registry.types().unparsed().contains(port.type)) type_names_.push_back(port.type);
      }
    }
    std::sort(type_names_.begin(), type_names_.end());
    type_names_.erase(std::unique(type_names_.begin(), type_names_.end()), type_names_.end());
  }

  Edges run() {
    check_interfaces();
    check_given();
    edges_.resize(expansion_.leaves.size());
    for (std::size_t i = 0; i < expansion_.scopes.size(); ++i) connect_nodes(i);
    for (const GraphOutput& output : top().outputs) check_reference(0, output.from);
    for (const LoopBody& loop : expansion_.loops) check_states(loop.scope);
    return std::move(edges_);
  }

 private:
  const GraphFile& top() const { return expansion_.top(); }
  const GraphFile& file_of(std::size_t scope) const { return expansion_.file_of(scope); }

  struct PortType {
    std::string id;
    int version = 0;  // 0 where a graph input declares the type
    bool optional = false;
    bool list = false;  // several, from a map
  };

  void check_interfaces() {
    for (std::size_t i = 0; i < expansion_.scopes.size(); ++i) {
      const GraphFile& file = file_of(i);
      for (const GraphInput& input : file.inputs) {
        if (input.broken) continue;
        if (!std::binary_search(type_names_.begin(), type_names_.end(), input.type)) {
          std::string hint = did_you_mean(input.type, type_names_);
          findings_.error(file, input.type_offset, "unknown type " + in_quotes(input.type),
                          hint.empty() ? "types are " + listed(type_names_, 30) : hint);
        } else if (i == 0 && !input.optional && !input.param && !given_.contains(input.name)) {
          findings_.error(file, input.offset,
                          "input " + in_quotes(input.name) + " (" + input.type + ") is not connected",
                          "a graph with inputs is a subgraph: run a graph that includes it");
        }
      }
    }
    if (top().outputs.empty() && !top().nodes.empty()) {
      findings_.warning(top(), top().root.offset, "the graph has no \"outputs\"",
                        "name what is wanted: \"outputs\": { \"balls\": \"node.port\" }");
    }
  }

  void check_given() {
    std::vector<std::string> names;
    for (const GraphInput& input : top().inputs) names.push_back(input.name);
    for (const auto& [name, artifact] : given_) {
      const auto known = top().input_index.find(name);
      if (known == top().input_index.end()) {
        const std::string hint = did_you_mean(name, names);
        findings_.error(top(), top().root.offset, "the graph has no input " + in_quotes(name),
                        !hint.empty()   ? hint
                        : names.empty() ? "it has no inputs"
                                        : "inputs are " + listed(names));
        continue;
      }
      const GraphInput& input = top().inputs[known->second];
      if (!input.broken && input.type != artifact->type()) {
        findings_.error(top(), input.type_offset,
                        "input " + in_quotes(name) + " takes a " + input.type + ", but the artifact is a " +
                            printable(artifact->type()));
      }
    }
  }

  bool known_type(const std::string& id) const {
    return std::binary_search(type_names_.begin(), type_names_.end(), id);
  }

  /// Reports a port that does not exist. Nothing when the reference is broken or was reported before.
  void check_reference(std::size_t scope, const Reference& reference) {
    if (reference.kind != Reference::Kind::node) return;
    const GraphFile& file = file_of(scope);
    const GraphNode& producer = file.nodes[reference.index];
    const Scope::Slot slot = expansion_.scopes[scope].slots[reference.index];
    std::vector<std::string> ports;
    std::string owner;
    if (slot.kind == Scope::Slot::Kind::leaf) {
      const NodeKind& kind = expansion_.leaves[slot.index].kind;
      if (kind.output(reference.port) != nullptr) return;
      for (const PortDecl& port : kind.outputs()) ports.push_back(port.name);
      owner = "node " + in_quotes(producer.name) + " (" + kind.type() + ")";
    } else if (slot.kind == Scope::Slot::Kind::scope) {
      const GraphFile& child = file_of(slot.index);
      if (child.output_index.contains(reference.port)) return;
      for (const GraphOutput& output : child.outputs) ports.push_back(output.name);
      owner = "subgraph " + in_quotes(producer.name) + " (" + child.source.file() + ")";
    } else if (slot.kind == Scope::Slot::Kind::map) {
      const GraphFile& body = *expansion_.maps[slot.index].body;
      if (body.output_index.contains(reference.port)) return;
      for (const GraphOutput& output : body.outputs) ports.push_back(output.name);
      owner = "map " + in_quotes(producer.name) + " (" + body.source.file() + ")";
    } else {
      return;
    }
    std::string hint = did_you_mean(reference.port, ports);
    if (hint.empty()) hint = ports.empty() ? "it has no outputs" : "outputs are " + listed(ports);
    findings_.error(file, reference.offset, owner + " has no output " + in_quotes(reference.port),
                    std::move(hint));
  }

  /// The type a reference has where it is written. Follows subgraph outputs down, never inputs up, so that
  /// a wrong edge is reported on one side of an interface only.
  std::optional<PortType> type_of(std::size_t scope, const Reference* reference) const {
    bool list = false;
    for (std::size_t depth = 0; depth <= max_subgraph_depth; ++depth) {
      if (reference->kind == Reference::Kind::broken) return std::nullopt;
      if (reference->kind == Reference::Kind::input) {
        const GraphInput& input = file_of(scope).inputs[reference->index];
        if (input.broken || !known_type(input.type)) return std::nullopt;
        const auto given = scope == 0 ? given_.find(input.name) : given_.end();
        if (given != given_.end()) return PortType{input.type, given->second->version(), false, list};
        return PortType{input.type, 0, input.optional, list};
      }
      const Scope::Slot slot = expansion_.scopes[scope].slots[reference->index];
      if (slot.kind == Scope::Slot::Kind::broken) return std::nullopt;
      if (slot.kind == Scope::Slot::Kind::leaf) {
        const PortDecl* port = expansion_.leaves[slot.index].kind.output(reference->port);
        if (port == nullptr) return std::nullopt;
        return PortType{port->type, port->type_version, false, list};
      }
      std::size_t inner = slot.index;
      if (slot.kind == Scope::Slot::Kind::map) {
        list = true;
        if (expansion_.maps[slot.index].scopes.empty()) return std::nullopt;
        inner = expansion_.maps[slot.index].scopes.front();  // all copies have the same types
      }
      const auto output = file_of(inner).output_index.find(reference->port);
      if (output == file_of(inner).output_index.end()) return std::nullopt;
      scope = inner;
      reference = &file_of(scope).outputs[output->second].from;
    }
    return std::nullopt;
  }

  void connect_nodes(std::size_t scope) {
    const GraphFile& file = file_of(scope);
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      const Scope::Slot slot = expansion_.scopes[scope].slots[i];
      for (const GraphNode::Input& input : file.nodes[i].inputs) check_reference(scope, input.from);
      if (slot.kind == Scope::Slot::Kind::leaf) {
        const NodeKind& kind = expansion_.leaves[slot.index].kind;
        std::vector<Consumer> consumers;
        for (const PortDecl& port : kind.inputs()) {
          const bool usable = known_type(port.type);  // a loop has the types that its body declares
          consumers.push_back(
              {port.name,
               {usable ? port.type : std::string(), port.type_version, port.optional || !usable},
               port.list});
        }
        check_inputs(scope, file.nodes[i], "node " + in_quotes(file.nodes[i].name) + " (" + kind.type() + ")",
                     consumers);
        std::size_t places = 0;  // of the list that is being connected
        for (const GraphNode::Input& input : file.nodes[i].inputs) {
          const auto port = std::find_if(kind.inputs().begin(), kind.inputs().end(),
                                         [&](const PortDecl& decl) { return decl.name == input.port; });
          if (port == kind.inputs().end()) continue;
          if (input.index.value_or(0) == 0) places = 0;
          for (const auto& [entry, target] : references_.resolve_all(scope, input.from)) {
            const bool outside = target.kind == Target::Kind::from_loop || target.kind == Target::Kind::given;
            // What is not connected after all (an optional input of a subgraph) leaves no gap in a list.
            if (!outside && target.kind != Target::Kind::leaf) continue;
            const std::string place = port->list ? list_slot(input.port, places++) : input.port;
            edges_[slot.index][place] = {outside ? loop_input : target.leaf, target.port};
          }
        }
      } else if (slot.kind == Scope::Slot::Kind::scope || slot.kind == Scope::Slot::Kind::map) {
        const bool map = slot.kind == Scope::Slot::Kind::map;
        const GraphFile& child = map ? *expansion_.maps[slot.index].body : file_of(slot.index);
        std::vector<Consumer> consumers;
        for (const GraphInput& input : child.inputs) {
          const bool usable = !input.broken && known_type(input.type);
          consumers.push_back(
              {input.name, {usable ? input.type : std::string(), 0, input.optional || !usable}, false});
        }
        check_inputs(
            scope, file.nodes[i],
            (map ? "map " : "subgraph ") + in_quotes(file.nodes[i].name) + " (" + child.source.file() + ")",
            consumers);
      }
    }
    for (const GraphOutput& output : file.outputs) {
      if (scope != 0) check_reference(scope, output.from);
    }
    references_.resolve_outputs(scope);
  }

  /// Every output of a loop body must fit the input of its name.
  void check_states(std::size_t scope) {
    const GraphFile& file = file_of(scope);
    for (const GraphOutput& output : file.outputs) {
      const auto place = file.input_index.find(output.name);
      if (place == file.input_index.end()) continue;  // reported
      const GraphInput& input = file.inputs[place->second];
      const std::optional<PortType> given = type_of(scope, &output.from);
      if (!given || input.broken || !known_type(input.type)) continue;
      const std::string state = "state " + in_quotes(output.name) + " of the loop";
      if (given->id != input.type) {
        findings_.error(file, output.from.offset,
                        in_quotes(written(file, output.from)) + " is a " + given->id + ", but " + state +
                            " begins as a " + input.type,
                        "a loop passes its outputs to its inputs: their types must agree");
      } else if (given->list) {
        findings_.error(
            file, output.from.offset,
            in_quotes(written(file, output.from)) + " is a list, but " + state + " is one artifact",
            "let a node make one of them");
      } else if (given->optional) {
        findings_.error(
            file, output.from.offset,
            in_quotes(written(file, output.from)) + " is optional, but " + state + " is required");
      }
    }
  }

  struct Consumer {
    std::string name;
    PortType type;  // empty id: unknown, already reported
    bool list = false;
  };

  void check_edge(std::size_t scope, const GraphNode& node, const std::string& owner,
                  const Consumer& consumer, const Reference& from) {
    const GraphFile& file = file_of(scope);
    const std::string what = "input " + in_quotes(consumer.name);
    const std::optional<PortType> given = type_of(scope, &from);
    if (!given || consumer.type.id.empty()) return;
    const std::string source = in_quotes(written(file, from));
    if (given->id != consumer.type.id) {
      findings_.error(
          file, from.offset,
          source + " is a " + given->id + ", but " + what + " of " + owner + " takes a " + consumer.type.id,
          suggestion(scope, node, consumer));
    } else if (given->version != 0 && consumer.type.version != 0 && given->version != consumer.type.version) {
      findings_.error(file, from.offset,
                      source + " is a " + given->id + " version " + std::to_string(given->version) +
                          ", but " + what + " of " + owner + " takes version " +
                          std::to_string(consumer.type.version),
                      "the two node libraries were built for different versions of the type");
    } else if (given->list && !consumer.list) {
      findings_.error(file, from.offset,
                      source + " is a list, one " + given->id + " for each entry of a map, but " + what +
                          " of " + owner + " takes one",
                      "put the node into the body of the map, or connect a port that takes a list");
    } else if (given->optional && !consumer.type.optional) {
      findings_.error(file, from.offset,
                      source + " is optional, but " + what + " of " + owner + " is required");
    }
  }

  void check_inputs(std::size_t scope, const GraphNode& node, const std::string& owner,
                    const std::vector<Consumer>& consumers) {
    const GraphFile& file = file_of(scope);
    std::vector<std::string> names;
    for (const Consumer& consumer : consumers) {
      names.push_back(consumer.name);
      const GraphNode::Input* input = node.input(consumer.name);
      const std::string what = "input " + in_quotes(consumer.name);
      if (input == nullptr) {
        if (!consumer.type.optional) {
          findings_.error(file, node.offset, owner + " misses its " + what + " (" + consumer.type.id + ")",
                          suggestion(scope, node, consumer));
        }
        continue;
      }
      if (input->index && !consumer.list) {
        findings_.error(file, input->offset, what + " of " + owner + " takes one artifact, not a list",
                        "write one edge: " + in_quotes(consumer.name) + ": \"node.port\"");
        continue;
      }
      for (; input != node.inputs.data() + node.inputs.size() && input->port == consumer.name; ++input)
        check_edge(scope, node, owner, consumer, input->from);
    }
    for (const GraphNode::Input& input : node.inputs) {
      if (std::find(names.begin(), names.end(), input.port) != names.end()) continue;
      std::string hint = did_you_mean(input.port, names);
      if (hint.empty()) hint = names.empty() ? "it has no inputs" : "inputs are " + listed(names);
      findings_.error(file, input.offset, owner + " has no input " + in_quotes(input.port), std::move(hint));
    }
  }

  static std::string written(const GraphFile& file, const Reference& reference) {
    if (reference.kind == Reference::Kind::input && file.inputs[reference.index].param)
      return "${" + reference.port + "}";
    return (reference.kind == Reference::Kind::input ? std::string("inputs")
                                                     : file.nodes[reference.index].name) +
           "." + reference.port;
  }

  /// An edge that would fit: the first output of the right type in the same file.
  std::string suggestion(std::size_t scope, const GraphNode& consumer, const Consumer& wanted) const {
    if (findings_.size() > 100) return {};
    const GraphFile& file = file_of(scope);
    const auto fits = [&](const std::string& edge) {
      return "\"" + wanted.name + "\": " + in_quotes(edge) + " would be a " + wanted.type.id;
    };
    for (const GraphInput& input : file.inputs) {
      if (input.type == wanted.type.id) return fits("inputs." + input.name);
    }
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      const Scope::Slot slot = expansion_.scopes[scope].slots[i];
      if (&file.nodes[i] == &consumer) continue;
      if (slot.kind == Scope::Slot::Kind::leaf) {
        for (const PortDecl& port : expansion_.leaves[slot.index].kind.outputs()) {
          if (port.type == wanted.type.id) return fits(file.nodes[i].name + "." + port.name);
        }
      } else if (slot.kind == Scope::Slot::Kind::scope) {
        for (const GraphOutput& output : file_of(slot.index).outputs) {
          const std::optional<PortType> type = type_of(slot.index, &output.from);
          if (type && type->id == wanted.type.id && (!type->list || wanted.list))
            return fits(file.nodes[i].name + "." + output.name);
        }
      }
    }
    return {};
  }

  const Expansion& expansion_;
  const std::map<std::string, ArtifactPtr>& given_;
  References& references_;
  Findings& findings_;
  std::vector<std::string> type_names_;
  Edges edges_;
};

}  // namespace

Edges connect_leaves(const Expansion& expansion, const Registry& registry,
                     const std::map<std::string, ArtifactPtr>& given, References& references,
                     Findings& findings) {
  return Connector(expansion, registry, given, references, findings).run();
}

Dag connect(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, Findings& findings) {
  References references(expansion, given, findings);
  const Edges edges = connect_leaves(expansion, registry, given, references, findings);
  const std::vector<std::size_t> order = order_leaves(expansion, edges, findings);
  return findings.failed() ? Dag() : build_dag(expansion, edges, order, given, references);
}

}  // namespace ballflow
