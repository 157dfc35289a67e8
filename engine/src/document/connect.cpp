// Edges of the expanded graph: which output each input reads, whether the types agree, in which order nodes
// can run.
#include <algorithm>
#include <queue>
#include <set>

#include "ballflow/graph.hpp"
#include "base/quote.hpp"
#include "document/expand.hpp"

namespace ballflow {

namespace {

class Connector {
 public:
  Connector(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, Findings& findings)
      : expansion_(expansion), given_(given), findings_(findings) {
    for (const auto& [id, type] : registry.types()) type_names_.push_back(id);
    for (const auto& [id, node] : registry.nodes()) {
      for (const std::vector<PortDecl>* ports : {&node.inputs, &node.outputs}) {
        for (const PortDecl& port : *ports) {
          if (registry.type(port.type) == nullptr) type_names_.push_back(port.type);
        }
      }
    }
    std::sort(type_names_.begin(), type_names_.end());
    type_names_.erase(std::unique(type_names_.begin(), type_names_.end()), type_names_.end());
    resolved_.resize(expansion.scopes.size());
    for (std::size_t i = 0; i < expansion.scopes.size(); ++i)
      resolved_[i].resize(expansion.scopes[i].file->outputs.size());
  }

  Dag run() {
    check_interfaces();
    check_given();
    edges_.resize(expansion_.leaves.size());
    for (std::size_t i = 0; i < expansion_.scopes.size(); ++i) connect_nodes(i);
    for (const GraphOutput& output : top().outputs) check_reference(0, output.from);
    for (const LoopBody& loop : expansion_.loops) check_states(loop.scope);
    const std::vector<std::size_t> order = topological_order();
    if (findings_.failed()) return {};
    return build(order);
  }

 private:
  const GraphFile& top() const { return *expansion_.scopes[0].file; }
  const GraphFile& file_of(std::size_t scope) const { return *expansion_.scopes[scope].file; }

  /// Whether the scope is the body of a loop; its inputs then come from the loop.
  bool is_body(std::size_t scope) const {
    const std::size_t loop = expansion_.scopes[scope].loop;
    return loop != nowhere && expansion_.loops[loop].scope == scope;
  }

  /// What a reference leads to: an output port, an input of the loop around it, an artifact from outside, an
  /// input that is not connected, or something reported.
  struct Target {
    enum class Kind { broken, unconnected, leaf, loop_input, given };
    Kind kind = Kind::broken;
    std::size_t leaf = 0;
    std::string port;
  };
  struct Memo {
    enum class State { fresh, visiting, done };
    State state = State::fresh;
    Target target;
  };

  struct PortType {
    std::string id;
    int version = 0;  // 0 where a graph input declares the type
    bool optional = false;
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
    for (std::size_t depth = 0; depth <= max_subgraph_depth; ++depth) {
      if (reference->kind == Reference::Kind::broken) return std::nullopt;
      if (reference->kind == Reference::Kind::input) {
        const GraphInput& input = file_of(scope).inputs[reference->index];
        if (input.broken || !known_type(input.type)) return std::nullopt;
        const auto given = scope == 0 ? given_.find(input.name) : given_.end();
        if (given != given_.end()) return PortType{input.type, given->second->version(), false};
        return PortType{input.type, 0, input.optional};
      }
      const Scope::Slot slot = expansion_.scopes[scope].slots[reference->index];
      if (slot.kind == Scope::Slot::Kind::broken) return std::nullopt;
      if (slot.kind == Scope::Slot::Kind::leaf) {
        const PortDecl* port = expansion_.leaves[slot.index].kind.output(reference->port);
        if (port == nullptr) return std::nullopt;
        return PortType{port->type, port->type_version, false};
      }
      const auto output = file_of(slot.index).output_index.find(reference->port);
      if (output == file_of(slot.index).output_index.end()) return std::nullopt;
      scope = slot.index;
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
          const Target target = resolve(scope, &input.from);
          const bool outside = target.kind == Target::Kind::loop_input || target.kind == Target::Kind::given;
          if (!outside && target.kind != Target::Kind::leaf) continue;
          // What is not connected after all (an optional input of a subgraph) leaves no gap in a list.
          if (input.index.value_or(0) == 0) places = 0;
          const std::string place = port->list ? list_slot(input.port, places++) : input.port;
          edges_[slot.index][place] = {outside ? loop_input : target.leaf, target.port};
        }
      } else if (slot.kind == Scope::Slot::Kind::scope) {
        const GraphFile& child = file_of(slot.index);
        std::vector<Consumer> consumers;
        for (const GraphInput& input : child.inputs) {
          const bool usable = !input.broken && known_type(input.type);
          consumers.push_back(
              {input.name, {usable ? input.type : std::string(), 0, input.optional || !usable}, false});
        }
        check_inputs(scope, file.nodes[i],
                     "subgraph " + in_quotes(file.nodes[i].name) + " (" + child.source.file() + ")",
                     consumers);
      }
    }
    for (const GraphOutput& output : file.outputs) {
      if (scope != 0) check_reference(scope, output.from);
    }
    // Also outputs that nobody reads: a subgraph that only passes values around may run in a circle.
    for (std::size_t i = 0; i < file.outputs.size(); ++i) {
      if (resolved_[scope][i].state == Memo::State::fresh) resolve_output(scope, i);
    }
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
          if (type && type->id == wanted.type.id) return fits(file.nodes[i].name + "." + output.name);
        }
      }
    }
    return {};
  }

  Target resolve_output(std::size_t scope, std::size_t output) {
    Reference reference;
    reference.kind = Reference::Kind::node;
    if (scope == 0 || is_body(scope)) return resolve(scope, &file_of(scope).outputs[output].from);
    reference.index = expansion_.scopes[scope].parent_node;
    reference.port = file_of(scope).outputs[output].name;
    return resolve(expansion_.scopes[scope].parent, &reference);
  }

  /// Follows a reference through subgraph outputs (down) and inputs (up) to the port that produces it.
  Target resolve(std::size_t scope, const Reference* reference) {
    std::vector<Memo*> visited;
    std::vector<std::string> trail;
    Target target;
    while (true) {
      if (reference->kind == Reference::Kind::broken) break;
      const Scope& here = expansion_.scopes[scope];
      if (reference->kind == Reference::Kind::input) {
        if (here.parent == nowhere) {
          const bool is_given = given_.contains(reference->port);
          target = {is_given ? Target::Kind::given : Target::Kind::unconnected, 0, reference->port};
          break;
        }
        const GraphNode& inclusion = file_of(here.parent).nodes[here.parent_node];
        const GraphNode::Input* binding = inclusion.input(reference->port);
        if (binding == nullptr) {
          target.kind = Target::Kind::unconnected;
          break;
        }
        if (is_body(scope)) {
          target.kind = Target::Kind::loop_input;
          target.port = reference->port;
          break;
        }
        reference = &binding->from;
        scope = here.parent;
        continue;
      }
      const Scope::Slot slot = here.slots[reference->index];
      if (slot.kind == Scope::Slot::Kind::broken) break;
      if (slot.kind == Scope::Slot::Kind::leaf) {
        if (expansion_.leaves[slot.index].kind.output(reference->port) != nullptr) {
          target = {Target::Kind::leaf, slot.index, reference->port};
        }
        break;
      }
      const auto output = file_of(slot.index).output_index.find(reference->port);
      if (output == file_of(slot.index).output_index.end()) break;
      Memo& memo = resolved_[slot.index][output->second];
      const std::string name = expansion_.scopes[slot.index].path + "." + reference->port;
      if (memo.state == Memo::State::done) {
        target = memo.target;
        break;
      }
      if (memo.state == Memo::State::visiting) {
        std::string cycle = name;
        for (auto back = trail.rbegin(); back != trail.rend(); ++back) {
          cycle += " -> " + *back;
          if (*back == name) break;
        }
        findings_.error(file_of(slot.index), file_of(slot.index).outputs[output->second].from.offset,
                        "cycle without a node in it: " + printable(cycle), "let the value come from a node");
        break;
      }
      memo.state = Memo::State::visiting;
      visited.push_back(&memo);
      trail.push_back(name);
      scope = slot.index;
      reference = &file_of(scope).outputs[output->second].from;
    }
    for (Memo* memo : visited) *memo = {Memo::State::done, target};
    return target;
  }

  /// Kahn's algorithm over the leaves, smallest path first. Cycles are reported, each once.
  std::vector<std::size_t> topological_order() {
    const std::size_t n = expansion_.leaves.size();
    std::vector<std::size_t> by_path(n), rank(n), missing(n, 0), order;
    for (std::size_t i = 0; i < n; ++i) by_path[i] = i;
    std::sort(by_path.begin(), by_path.end(), [&](std::size_t a, std::size_t b) {
      return expansion_.leaves[a].path < expansion_.leaves[b].path;
    });
    for (std::size_t i = 0; i < n; ++i) rank[by_path[i]] = i;
    std::vector<std::vector<std::size_t>> consumers(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (const auto& [port, edge] : edges_[i]) {
        if (edge.node == loop_input) continue;
        ++missing[i];
        consumers[edge.node].push_back(i);
      }
    }
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;  // of ranks
    for (std::size_t i = 0; i < n; ++i) {
      if (missing[i] == 0) ready.push(rank[i]);
    }
    std::vector<bool> done(n, false);
    const auto drain = [&] {
      while (!ready.empty()) {
        const std::size_t leaf = by_path[ready.top()];
        ready.pop();
        done[leaf] = true;
        order.push_back(leaf);
        for (const std::size_t consumer : consumers[leaf]) {
          if (--missing[consumer] == 0 && !done[consumer]) ready.push(rank[consumer]);
        }
      }
    };
    drain();
    std::vector<std::size_t> position(n, nowhere);
    for (std::size_t first = 0; first < n; ++first) {
      if (done[by_path[first]]) continue;
      // Every node that is left waits for one that is left: going against the edges ends in a cycle.
      std::vector<std::size_t> walk;
      std::size_t leaf = by_path[first];
      while (position[leaf] == nowhere) {
        position[leaf] = walk.size();
        walk.push_back(leaf);
        for (const auto& [port, edge] : edges_[leaf]) {
          if (edge.node == loop_input || done[edge.node]) continue;
          leaf = edge.node;
          break;
        }
      }
      std::vector<std::size_t> cycle(walk.begin() + static_cast<std::ptrdiff_t>(position[leaf]), walk.end());
      for (const std::size_t passed : walk) position[passed] = nowhere;
      report_cycle(cycle, rank);
      for (const std::size_t member : cycle) done[member] = true;
      for (const std::size_t member : cycle) {
        for (const std::size_t consumer : consumers[member]) {
          if (--missing[consumer] == 0 && !done[consumer]) ready.push(rank[consumer]);
        }
      }
      drain();
    }
    return order;
  }

  /// `cycle` runs against the edges.
  void report_cycle(std::vector<std::size_t> cycle, const std::vector<std::size_t>& rank) {
    std::reverse(cycle.begin(), cycle.end());
    const auto smallest = std::min_element(cycle.begin(), cycle.end(),
                                           [&](std::size_t a, std::size_t b) { return rank[a] < rank[b]; });
    std::rotate(cycle.begin(), smallest, cycle.end());
    std::string text;
    for (const std::size_t leaf : cycle) text += expansion_.leaves[leaf].path + " -> ";
    text += expansion_.leaves[cycle[0]].path;
    const Leaf& leaf = expansion_.leaves[cycle[0]];
    const GraphNode& node = file_of(leaf.scope).nodes[leaf.node];
    Offset offset = node.offset;
    for (const auto& [port, edge] : edges_[cycle[0]]) {
      if (edge.node == cycle.back()) offset = node.input(std::string(port_of_slot(port)))->from.offset;
    }
    findings_.error(file_of(leaf.scope), offset, "cycle: " + printable(text), "remove one of these edges");
  }

  Dag build(const std::vector<std::size_t>& order) {
    Dag dag;
    dag.file = top().source.file();
    dag.doc = top().doc;
    for (std::size_t i = 0; i < top().params.size(); ++i)
      dag.params[top().params[i].decl.name] = *expansion_.scopes[0].params[i];
    const std::map<std::string, std::size_t> given = add_given(dag);
    std::vector<std::size_t> place(expansion_.leaves.size());  // in the graph or the loop body around it
    for (const std::size_t i : order) {
      const Leaf& leaf = expansion_.leaves[i];
      const std::size_t around = expansion_.scopes[leaf.scope].loop;
      Dag& home = around == nowhere ? dag : expansion_.loops[around].loop->body;
      place[i] = home.nodes.size();
      DagNode& node = home.nodes.emplace_back(DagNode{leaf.path, leaf.kind});
      node.params = leaf.params;
      for (const auto& [port, edge] : edges_[i]) {
        if (edge.node != loop_input) {
          node.inputs[port] = {place[edge.node], edge.port};
        } else {
          node.inputs[port] = around == nowhere ? EdgeRef{given.at(edge.port), edge.port} : edge;
        }
      }
      const GraphFile& file = file_of(leaf.scope);
      const json_text::Position position = file.source.position(file.nodes[leaf.node].offset);
      node.place = {file.source.file(), position.line, position.column,
                    "/nodes/" + json_text::escape_pointer(file.nodes[leaf.node].name)};
    }
    add_outputs(dag, 0, place, given);
    add_interfaces(dag, place);
    for (std::size_t i = expansion_.loops.size(); i-- > 0;)  // inner loops first
      finish(*expansion_.loops[i].loop, expansion_.loops[i].scope, place);
    return dag;
  }

  /// Artifacts from outside come first: they have no inputs.
  std::map<std::string, std::size_t> add_given(Dag& dag) const {
    std::map<std::string, std::size_t> place;
    for (const auto& [name, artifact] : given_) {
      PortDecl port;
      port.name = name;
      port.type = artifact->type();
      port.type_version = artifact->version();
      place[name] = dag.nodes.size();
      dag.nodes.push_back({"inputs/" + name, Given{{port}, artifact}});  // no node is named "inputs"
    }
    return place;
  }

  void add_outputs(Dag& dag, std::size_t scope, const std::vector<std::size_t>& place,
                   const std::map<std::string, std::size_t>& given = {}) {
    for (const GraphOutput& output : file_of(scope).outputs) {
      const Target target = resolve(scope, &output.from);
      if (target.kind == Target::Kind::leaf)
        dag.outputs.push_back({output.name, output.doc, {place[target.leaf], target.port}});
      if (target.kind == Target::Kind::loop_input)
        dag.outputs.push_back({output.name, output.doc, {loop_input, target.port}});
      if (target.kind == Target::Kind::given)
        dag.outputs.push_back({output.name, output.doc, {given.at(target.port), target.port}});
    }
  }

  void add_interfaces(Dag& dag, const std::vector<std::size_t>& place) {
    for (std::size_t scope = 1; scope < expansion_.scopes.size(); ++scope) {
      if (expansion_.scopes[scope].loop != nowhere) continue;
      for (const GraphOutput& output : file_of(scope).outputs) {
        const Target target = resolve(scope, &output.from);
        if (target.kind != Target::Kind::leaf) continue;
        dag.interfaces.push_back({expansion_.scopes[scope].path + "." + output.name,
                                  output.doc,
                                  {place[target.leaf], target.port}});
      }
    }
  }

  /// Drops what no state needs, and sums up what the nodes of the body declare; they run one at a time.
  void finish(Loop& loop, std::size_t scope, const std::vector<std::size_t>& place) {
    Dag& body = loop.body;
    body.file = file_of(scope).source.file();
    body.doc = file_of(scope).doc;
    for (std::size_t i = 0; i < file_of(scope).params.size(); ++i)
      body.params[file_of(scope).params[i].decl.name] = *expansion_.scopes[scope].params[i];
    add_outputs(body, scope, place);
    const std::vector<bool> needed = needed_nodes(body);
    std::vector<std::size_t> number(needed.size());
    std::vector<DagNode> nodes;
    for (std::size_t i = 0; i < needed.size(); ++i) {
      if (!needed[i]) continue;
      number[i] = nodes.size();
      nodes.push_back(std::move(body.nodes[i]));
      for (auto& [port, edge] : nodes.back().inputs) {
        if (edge.node != loop_input) edge.node = number[edge.node];
      }
    }
    body.nodes = std::move(nodes);
    for (DagOutput& output : body.outputs) {
      if (output.from.node != loop_input) output.from.node = number[output.from.node];
    }
    for (const DagNode& node : body.nodes) {
      const MemoryNeed need = node.kind.memory();
      loop.uses_seed = loop.uses_seed || node.kind.uses_seed();
      loop.memory.fixed = std::max(loop.memory.fixed, need.fixed);
      loop.memory.per_input_byte = std::max(loop.memory.per_input_byte, need.per_input_byte);
    }
  }

  const Expansion& expansion_;
  const std::map<std::string, ArtifactPtr>& given_;
  Findings& findings_;
  std::vector<std::string> type_names_;
  std::vector<std::vector<Memo>> resolved_;            // by scope and output
  std::vector<std::map<std::string, EdgeRef>> edges_;  // by leaf and input port; nodes are leaves
};

}  // namespace

Dag connect(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, Findings& findings) {
  return Connector(expansion, registry, given, findings).run();
}

}  // namespace ballflow
