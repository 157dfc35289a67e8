#include "document/references.hpp"

#include <optional>
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
  std::optional<std::size_t> single;  // how many were visited before the last input of a subgraph, if any
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
      single = visited.size();
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
    if (slot.kind == Scope::Slot::Kind::map) {
      if (expansion_.maps[slot.index].body->output_index.contains(reference->port))
        target = {Target::Kind::list, slot.index, reference->port};
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
  // An input of a subgraph takes one artifact: what is before it gets none of a list.
  const bool torn = single && target.kind == Target::Kind::list;
  for (std::size_t i = 0; i < visited.size(); ++i)
    *visited[i] = {Memo::State::done, torn && i < *single ? Target() : target};
  return torn ? Target() : target;
}

std::vector<ListedTarget> References::resolve_all(std::size_t scope, const Reference& reference) {
  std::vector<ListedTarget> all;
  take_apart(resolve(scope, reference), "", all);
  return all;
}

/// As deep as subgraphs are nested: a list comes from the inside of the copies alone.
void References::take_apart(const Target& target, const std::string& entry, std::vector<ListedTarget>& all) {
  if (target.kind != Target::Kind::list) {
    all.push_back({entry, target});
    return;
  }
  for (const std::size_t copy : expansion_.maps[target.leaf].scopes) {
    const std::size_t output = expansion_.file_of(copy).output_index.at(target.port);
    take_apart(resolve_output(copy, output),
               entry + (entry.empty() ? "" : "/") + *expansion_.scopes[copy].entry, all);
  }
}

Target References::resolve_output(std::size_t scope, std::size_t output) {
  Reference reference;
  reference.kind = Reference::Kind::node;
  if (scope == 0 || expansion_.is_body(scope) || expansion_.scopes[scope].entry)
    return resolve(scope, expansion_.file_of(scope).outputs[output].from);
  reference.index = expansion_.scopes[scope].parent_node;
  reference.port = expansion_.file_of(scope).outputs[output].name;
  return resolve(expansion_.scopes[scope].parent, reference);
}

}  // namespace ballflow
