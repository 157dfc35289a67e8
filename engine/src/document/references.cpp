#include "document/references.hpp"

#include <utility>

#include "ballflow/text.hpp"

namespace ballflow {

References::References(const Expansion& expansion, const std::map<std::string, ArtifactPtr>& given,
                       Findings& findings)
    : expansion_(expansion), given_(given), findings_(findings), resolved_(expansion.scopes.size()) {
  for (std::size_t i = 0; i < expansion.scopes.size(); ++i)
    resolved_[i].resize(expansion.file_of(i).outputs.size());
}

void References::resolve_outputs(std::size_t scope) {
  for (std::size_t i = 0; i < expansion_.file_of(scope).outputs.size(); ++i) {
    if (resolved_[scope][i].state == Memo::State::fresh) resolve_output(scope, i);
  }
}

Target References::resolve(std::size_t scope, const Reference& first) {
  const Reference* reference = &first;
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
      const GraphNode& inclusion = expansion_.file_of(here.parent).nodes[here.parent_node];
      const GraphNode::Input* binding = inclusion.input(reference->port);
      if (binding == nullptr) {
        target.kind = Target::Kind::unconnected;
        break;
      }
      if (expansion_.is_body(scope)) {
        target.kind = Target::Kind::from_loop;
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
    const auto output = expansion_.file_of(slot.index).output_index.find(reference->port);
    if (output == expansion_.file_of(slot.index).output_index.end()) break;
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
      findings_.error(expansion_.file_of(slot.index),
                      expansion_.file_of(slot.index).outputs[output->second].from.offset,
                      "cycle without a node in it: " + printable(cycle), "let the value come from a node");
      break;
    }
    memo.state = Memo::State::visiting;
    visited.push_back(&memo);
    trail.push_back(name);
    scope = slot.index;
    reference = &expansion_.file_of(scope).outputs[output->second].from;
  }
  for (Memo* memo : visited) *memo = {Memo::State::done, target};
  return target;
}

Target References::resolve_output(std::size_t scope, std::size_t output) {
  Reference reference;
  reference.kind = Reference::Kind::node;
  if (scope == 0 || expansion_.is_body(scope))
    return resolve(scope, expansion_.file_of(scope).outputs[output].from);
  reference.index = expansion_.scopes[scope].parent_node;
  reference.port = expansion_.file_of(scope).outputs[output].name;
  return resolve(expansion_.scopes[scope].parent, reference);
}

}  // namespace ballflow
