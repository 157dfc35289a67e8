// Graph files -> instances: every node of every inclusion of a subgraph, with its parameters resolved.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/findings.hpp"
#include "document/graph_file.hpp"
#include "document/graph_files.hpp"
#include "document/setting.hpp"

namespace ballflow {

constexpr std::size_t max_instances = 1'000'000;

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// One inclusion of a graph file; scope 0 is the top graph.
struct Scope {
  /// What a node of the file became.
  struct Slot {
    enum class Kind { broken, leaf, scope, map };
    Kind kind = Kind::broken;
    std::size_t index = 0;  // into leaves, scopes or maps
  };
  const GraphFile* file = nullptr;
  std::size_t parent = nowhere;             // scope
  std::size_t parent_node = nowhere;        // node of the parent's file
  std::size_t loop = nowhere;               // the innermost loop around it
  std::string path;                         // "prune", "links[hand]", empty at the top
  std::optional<std::string> entry;         // of a copy of a map: "hand"
  std::vector<std::optional<Json>> params;  // by GraphFile::params; nothing where an error was reported
  std::vector<Slot> slots;                  // by GraphFile::nodes
};

/// One node that runs.
struct Leaf {
  std::string path;
  std::size_t scope = 0;
  std::size_t node = 0;  // of the scope's file
  NodeKind kind;
  std::map<std::string, Json> params = {};
};

/// A loop and the scope of its body. Outer loops come before inner ones.
struct LoopBody {
  std::shared_ptr<Loop> loop;
  std::size_t scope = nowhere;
};

/// A map: a scope for each entry of its list, in order.
struct MapCopies {
  const GraphFile* body = nullptr;
  std::vector<std::size_t> scopes = {};
};

struct Expansion {
  std::deque<Scope> scopes;
  std::vector<Leaf> leaves;
  std::vector<LoopBody> loops;
  std::vector<MapCopies> maps;
  bool abandoned = false;  // a limit was reached; the rest is missing

  const GraphFile& top() const { return *scopes[0].file; }
  const GraphFile& file_of(std::size_t scope) const { return *scopes[scope].file; }
  /// Whether the scope is the body of a loop; its inputs then come from the loop.
  bool is_body(std::size_t scope) const {
    const std::size_t loop = scopes[scope].loop;
    return loop != nowhere && loops[loop].scope == scope;
  }
};

/// Reads included files, resolves parameters and checks them. Errors become findings; what depends on a
/// reported error is left out silently. Of several settings of a parameter the last counts.
void expand(const GraphFile& top, GraphFiles& files, const Registry& registry,
            const std::vector<const PlacedSetting*>& settings, Expansion& expansion, Findings& findings);

}  // namespace ballflow
