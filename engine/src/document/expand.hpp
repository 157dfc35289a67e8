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
#include "document/graph_json.hpp"

namespace ballflow {

constexpr std::size_t max_instances = 1'000'000;
constexpr std::size_t max_subgraph_depth = 50;

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// A value given from outside to a parameter: by --set, or by an axis of a sweep.
struct Setting {
  std::string name;                 // as in Override
  std::string text;                 // from the command line
  std::optional<Json> value;        // from the graph file; `text` is not looked at then
  std::string origin;               // for messages: "--set epsilon=0.5"
  const GraphFile* file = nullptr;  // where it was written, instead of `origin`
  Offset offset = 0, name_offset = 0;
};

/// "epsilon" -> ".epsilon", "prune.greedy.mode" -> "prune/greedy.mode": equal names are the same parameter.
std::string setting_target(const std::string& name);

Diagnostic about_setting(const Setting& setting, std::string message, std::string hint);

/// Graph files that were read, each once.
struct GraphFiles {
  explicit GraphFiles(Findings& found) : findings(found) {}
  std::map<std::string, std::unique_ptr<GraphFile>> by_path;  // canonical; null where it could not be read
  std::vector<std::string> names;                             // as in messages, in order of first reading
  std::map<std::string, std::string> canonical;               // memo: a file may be included a million times
  Findings& findings;                                         // about the files themselves
};

/// One inclusion of a graph file; scope 0 is the top graph.
struct Scope {
  /// What a node of the file became: an index into leaves or scopes.
  struct Slot {
    enum class Kind { broken, leaf, scope };
    Kind kind = Kind::broken;
    std::size_t index = 0;
  };
  const GraphFile* file = nullptr;
  std::size_t parent = nowhere;             // scope
  std::size_t parent_node = nowhere;        // node of the parent's file
  std::size_t loop = nowhere;               // the innermost loop around it
  std::string path;                         // "prune", empty at the top
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

struct Expansion {
  std::deque<Scope> scopes;
  std::vector<Leaf> leaves;
  std::vector<LoopBody> loops;
  bool abandoned = false;  // a limit was reached; the rest is missing
};

/// Reads included files, resolves parameters and checks them. Errors become findings; what depends on a
/// reported error is left out silently. Of several settings of a parameter the last counts.
void expand(const GraphFile& top, GraphFiles& files, const Registry& registry,
            const std::vector<const Setting*>& settings, Expansion& expansion, Findings& findings);

/// The artifacts for the inputs of the top graph: `given`, and those that its parameters of kind artifact
/// name in settings or by default. `find` is asked once per name; what it found is in `found`. Each is
/// checked against its type.
std::map<std::string, ArtifactPtr> find_given(const GraphFile& top, const Registry& registry,
                                              const std::vector<const Setting*>& settings,
                                              const std::map<std::string, ArtifactPtr>& given,
                                              const FindArtifact& find,
                                              std::map<std::string, ArtifactPtr>& found, Findings& findings);

/// Connects the leaves, checks ports, types and cycles, and puts the nodes into topological order. `given`
/// are the artifacts for the inputs of the top graph.
Dag connect(const Expansion& expansion, const Registry& registry,
            const std::map<std::string, ArtifactPtr>& given, Findings& findings);

/// Throws Error when it cannot be read or is larger than the limit of texts.
std::string read_text_file(const std::string& path);

}  // namespace ballflow
