// What the kinds of nodes have in common.
#include <algorithm>

#include "ballflow/graph.hpp"

namespace ballflow {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

using LoopPtr = std::shared_ptr<const Loop>;

}  // namespace

const NodeDeclaration* NodeKind::declared() const {
  const auto* declared = std::get_if<const NodeDeclaration*>(&kind_);
  return declared == nullptr ? nullptr : *declared;
}

const Loop* NodeKind::loop() const {
  const auto* loop = std::get_if<LoopPtr>(&kind_);
  return loop == nullptr ? nullptr : loop->get();
}

const std::string& NodeKind::type() const {
  static const std::string loop_type = "loop", given_type = "artifact";
  return std::visit(Overloaded{
                        [](const NodeDeclaration* decl) -> const std::string& { return decl->id; },
                        [](const LoopPtr&) -> const std::string& { return loop_type; },
                        [](const Given&) -> const std::string& { return given_type; },
                    },
                    kind_);
}

int NodeKind::version() const { return declared() == nullptr ? 0 : declared()->version; }

const std::map<std::string, std::string>& NodeKind::libraries() const {
  static const std::map<std::string, std::string> none;
  return declared() == nullptr ? none : declared()->libraries;
}

const std::vector<PortDecl>& NodeKind::inputs() const {
  static const std::vector<PortDecl> none;
  return std::visit(
      Overloaded{
          [](const NodeDeclaration* decl) -> const std::vector<PortDecl>& { return decl->inputs; },
          [](const LoopPtr& loop) -> const std::vector<PortDecl>& { return loop->inputs; },
          [](const Given&) -> const std::vector<PortDecl>& { return none; },
      },
      kind_);
}

const std::vector<PortDecl>& NodeKind::outputs() const {
  return std::visit(
      Overloaded{
          [](const NodeDeclaration* decl) -> const std::vector<PortDecl>& { return decl->outputs; },
          [](const LoopPtr& loop) -> const std::vector<PortDecl>& { return loop->outputs; },
          [](const Given& given) -> const std::vector<PortDecl>& { return given.outputs; },
      },
      kind_);
}

const PortDecl* NodeKind::output(std::string_view name) const {
  const std::vector<PortDecl>& all = outputs();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const PortDecl& port) { return port.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const std::vector<ParamDecl>& NodeKind::params() const {
  static const std::vector<ParamDecl> none;
  return std::visit(
      Overloaded{
          [](const NodeDeclaration* decl) -> const std::vector<ParamDecl>& { return decl->params; },
          [](const LoopPtr&) -> const std::vector<ParamDecl>& { return loop_params(); },
          [](const Given&) -> const std::vector<ParamDecl>& { return none; },
      },
      kind_);
}

bool NodeKind::uses_seed() const {
  return std::visit(Overloaded{
                        [](const NodeDeclaration* decl) { return decl->uses_seed; },
                        [](const LoopPtr& loop) { return loop->uses_seed; },
                        [](const Given&) { return false; },
                    },
                    kind_);
}

MemoryNeed NodeKind::memory() const {
  return std::visit(Overloaded{
                        [](const NodeDeclaration* decl) {
                          return MemoryNeed{decl->memory_fixed, decl->memory_per_input_byte};
                        },
                        [](const LoopPtr& loop) { return loop->memory; },
                        [](const Given&) { return MemoryNeed{}; },
                    },
                    kind_);
}

}  // namespace ballflow
