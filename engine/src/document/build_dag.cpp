// Leaves that are connected and in order -> flat DAG.
#include <algorithm>
#include <utility>

#include "document/connect.hpp"

namespace ballflow {
namespace {

class Builder {
 public:
  Builder(const Expansion& expansion, const std::map<std::string, ArtifactPtr>& given, References& references)
      : expansion_(expansion), given_(given), references_(references) {}

  Dag build(const Edges& edges, const std::vector<std::size_t>& order) {
    Dag dag;
    dag.file = expansion_.top().source.file();
    dag.doc = expansion_.top().doc;
    for (std::size_t i = 0; i < expansion_.top().params.size(); ++i)
      dag.params[expansion_.top().params[i].decl.name] = *expansion_.scopes[0].params[i];
    const std::map<std::string, std::size_t> given = add_given(dag);
    std::vector<std::size_t> place(expansion_.leaves.size());  // in the graph or the loop body around it
    for (const std::size_t i : order) {
      const Leaf& leaf = expansion_.leaves[i];
      const std::size_t around = expansion_.scopes[leaf.scope].loop;
      Dag& home = around == nowhere ? dag : expansion_.loops[around].loop->body;
      place[i] = home.nodes.size();
      DagNode& node = home.nodes.emplace_back(DagNode{leaf.path, leaf.kind});
      node.params = leaf.params;
      for (const auto& [port, edge] : edges[i]) {
        if (edge.node != loop_input) {
          node.inputs[port] = {place[edge.node], edge.port};
        } else {
          node.inputs[port] = around == nowhere ? EdgeRef{given.at(edge.port), edge.port} : edge;
        }
      }
      const GraphFile& file = expansion_.file_of(leaf.scope);
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

 private:
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
    for (const GraphOutput& output : expansion_.file_of(scope).outputs) {
      for (const auto& [entry, target] : references_.resolve_all(scope, output.from)) {
        const std::string name = entry.empty() ? output.name : entry + "/" + output.name;
        if (target.kind == Target::Kind::leaf)
          dag.outputs.push_back({name, output.doc, {place[target.leaf], target.port}});
        if (target.kind == Target::Kind::from_loop)
          dag.outputs.push_back({name, output.doc, {loop_input, target.port}});
        if (target.kind == Target::Kind::given)
          dag.outputs.push_back({name, output.doc, {given.at(target.port), target.port}});
      }
    }
  }

  void add_interfaces(Dag& dag, const std::vector<std::size_t>& place) {
    for (std::size_t scope = 1; scope < expansion_.scopes.size(); ++scope) {
      if (expansion_.scopes[scope].loop != nowhere) continue;
      for (const GraphOutput& output : expansion_.file_of(scope).outputs) {
        const Target target = references_.resolve(scope, output.from);
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
    body.file = expansion_.file_of(scope).source.file();
    body.doc = expansion_.file_of(scope).doc;
    for (std::size_t i = 0; i < expansion_.file_of(scope).params.size(); ++i)
      body.params[expansion_.file_of(scope).params[i].decl.name] = *expansion_.scopes[scope].params[i];
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
  References& references_;
};

}  // namespace

Dag build_dag(const Expansion& expansion, const Edges& edges, const std::vector<std::size_t>& order,
              const std::map<std::string, ArtifactPtr>& given, References& references) {
  return Builder(expansion, given, references).build(edges, order);
}

}  // namespace ballflow
