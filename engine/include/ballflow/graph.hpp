// A graph: text -> document (with positions) -> flat DAG.
//
//   {
//     "doc": "One sentence.",
//     "params": { "epsilon": { "kind": "number", "default": 0.3, "minimum": 0, "unit": "%", "doc": "..." } },
//     "inputs": { "cover": { "type": "CoverState", "doc": "..." } },          // of a subgraph
//     "nodes": {
//       "sample": { "type": "Sample", "params": { "file": "${input}" } },
//       "poles":  { "type": "VoronoiPoles", "inputs": { "points": "sample.points" } },
//       "prune":  { "graph": "strategies/${strategy}.json", "inputs": { "cover": "matrix.cover" } }
//     },
//     "outputs": { "balls": "select.balls", "cover": { "from": "prune.cover", "doc": "..." } }
//   }
//
// An edge is written at its consumer: "node.port", or "inputs.name" for an input of the graph. "${name}" as
// a whole value keeps the parameter's type; inside a longer text it is replaced as text (numbers in their
// shortest form), and "$${" stands for "${". It is understood in the values of "params" and in "graph". A
// parameter without "default" must be given: by --set at the top, by the including node in a subgraph.
// A port that takes a list of artifacts is given a list of edges: "meshes": ["a.mesh", "b.mesh"].
//
// A parameter of kind "artifact" is an input of the graph that is run, from a file, the cache or a host
// program:
//   "params": { "balls": { "kind": "artifact", "type": "Balls", "doc": "..." } }
//   "enlarge": { "type": "Enlarge", "inputs": { "balls": "${balls}" } }
// Its value is the path of a safetensors file or a digest (of at least 6 digits) in the cache. Subgraphs have
// "inputs" instead.
//
// An input of a subgraph may be "optional": true. Nodes may have a "doc", the graph a "$schema" for editors.
// Paths of subgraphs are relative to the file that names them. // and /* */ comments are accepted.
//
// A loop is a node whose body is a graph file, run again and again in memory:
//   "rounds": { "loop": "bodies/round.json", "inputs": { "cover": "matrix.cover" },
//               "until": "cover.remaining == 0", "max_iterations": 10000, "at_limit": "error" }
// The outputs of the body are the state: each has an input of the same name and type, which gets it in the
// next iteration; the other inputs stay what they are. The outputs of the node are the final state. `until`
// is looked at before every iteration; it compares fields of the summaries of the state with numbers: ==, !=,
// <, <=, >, >=, joined by `and` and `or` (`and` binds first). A field that is null fulfils no comparison,
// true is 1. `at_limit` says what happens when max_iterations (default 10000) have run and `until` does not
// hold: "error" (default), or "stop", which keeps the state reached and warns.
//
// A map is a subgraph that is there once for every entry of a list:
//   "links": { "map": "bodies/link.json", "over": { "link": "${links}", "balls": "${counts}" },
//              "inputs": { "robot": "read.robot" }, "params": { "seed": 1 } }
// `over` names parameters of the body and the lists that they go through together: parameters of kind list or
// files (files also as patterns), or lists as they are, ["hand", "arm"]. The first list names the copies, so
// that it has no entry twice: "links[hand]", "links[arm]". The others are as long as that, or have one entry
// for all. An entry is a text that is read as --set reads it. `inputs` and `params` are the same for every
// copy. "index": "place" gives a parameter of the body the place of its entry, from 0 on. "links.balls" is
// then a list of artifacts, in the order of the entries: for a port that takes one
// ("spheres": "links.balls", or a part of ["links.balls", "base.balls"]), or an output of the graph
// ("hand/balls", "arm/balls"). The copies are nodes like any others, whose keys depend on their content and
// not on their place. --set links/enclose.rounds=3 is for all copies, --set links[hand]/enclose.rounds=3 for
// one.
//
// A sweep runs a graph once for every combination of values; what combinations have in common runs once:
//   "sweep": { "axes": { "epsilon": [0.1, 0.3], "prune/greedy.mode": ["all", "until_covered"] },
//              "mode": "product", "exclude": [{ "epsilon": 0.1, "prune/greedy.mode": "all" }] },
//   "map": { "input": "scans/*.ply" }
// An axis names a parameter of the graph or of a node, as --set does. Mode "product" (the default) takes
// every combination, the last axis fastest; "zip" takes the first values of all axes, the second ones, and so
// on. A combination that has all values of an entry of "exclude" is left out. "map" gives a parameter of kind
// file every file that matches, sorted (a pattern with *, ? or [...], or a list of patterns and names,
// relative to the current directory; "scheme:..." is taken as it is); every combination of the axes is run
// for every file. Only the sweep of the top graph counts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ballflow/error.hpp"
#include "ballflow/node_decl.hpp"
#include "ballflow/registry.hpp"

namespace ballflow {

/// Where an element of a graph was written.
struct Place {
  std::string file;
  int line = 0, column = 0;
  std::string pointer;
};

/// EdgeRef::node of what a loop body gets from outside; the port is then the name of the input.
constexpr std::size_t loop_input = static_cast<std::size_t>(-1);

/// An edge of the flat DAG: output `port` of node `node` (index into Dag::nodes).
struct EdgeRef {
  std::size_t node = 0;
  std::string port;
};

struct Loop;

/// An artifact from outside: a node without inputs that never runs.
struct Given {
  std::vector<PortDecl> outputs;  // one
  ArtifactPtr artifact;
};

/// What a node needs besides its inputs and outputs, in bytes.
struct MemoryNeed {
  std::uint64_t fixed = 0;
  double per_input_byte = 0;

  std::uint64_t for_inputs_of(std::uint64_t bytes) const {
    return fixed + static_cast<std::uint64_t>(per_input_byte * static_cast<double>(bytes));
  }
};

/// What a node is: one that a library declares, a loop, or an artifact from outside. The first is only
/// referred to and has to live elsewhere, in a registry.
class NodeKind {
 public:
  NodeKind(const NodeDeclaration& declared) : kind_(&declared) {}
  NodeKind(const NodeDeclaration&&) = delete;
  NodeKind(std::shared_ptr<const Loop> loop) : kind_(std::move(loop)) {}
  NodeKind(Given given) : kind_(std::move(given)) {}

  // Null when it is another kind.
  const NodeDeclaration* declared() const;
  const Loop* loop() const;
  const Given* given() const { return std::get_if<Given>(&kind_); }

  /// "Enlarge", "loop" or "artifact". A node of a library cannot be declared with the latter two.
  const std::string& type() const;
  /// Behaviour version; 0 of what no library declares.
  int version() const;
  /// Versions of libraries that change the results.
  const std::map<std::string, std::string>& libraries() const;
  const std::vector<PortDecl>& inputs() const;
  const std::vector<PortDecl>& outputs() const;
  /// Null when there is no output of this name.
  const PortDecl* output(std::string_view name) const;
  const std::vector<ParamDecl>& params() const;
  bool uses_seed() const;
  MemoryNeed memory() const;

 private:
  std::variant<const NodeDeclaration*, std::shared_ptr<const Loop>, Given> kind_;
};

struct DagNode {
  std::string path;  // "prune/greedy": node names from the top graph down; of a map "links[hand]/enclose"
  NodeKind kind;
  std::map<std::string, EdgeRef> inputs = {};  // connected ports only
  std::map<std::string, Json> params = {};     // every declared parameter, defaults filled in, checked
  Place place = {};
};

struct DagOutput {
  // Of a sweep "epsilon=0.1,strategy=greedy/balls", the name of the variant first; of a map "hand/balls".
  std::string name, doc;
  EdgeRef from;

  /// "balls"
  std::string base_name() const { return name.substr(name.rfind('/') + 1); }
};

/// One combination of the values of a sweep.
struct Variant {
  std::string name;  // "epsilon=0.1,strategy=greedy"; fit for a folder, unique, at most 200 bytes
  std::vector<std::pair<std::string, Json>> values;  // parameter and value, by axis
  std::vector<std::size_t> nodes;                    // of Dag::nodes; others may have them too
  std::vector<DagOutput> interfaces;                 // as Dag::interfaces
};

/// Subgraphs, parameters and includes resolved. Nodes are in topological order, ties by path.
///
/// Of a sweep it holds the nodes of all variants. Nodes that are the same in several variants (same type,
/// path and parameters, inputs from the same nodes) are one node. The path of a node says which variants have
/// it:
/// "[epsilon=0.1]/enlarge" belongs to those with this epsilon, "poles" to all.
struct Dag {
  std::string file;
  std::vector<std::string> files;  // that were read: `file`, then subgraphs, each once
  std::string doc;
  std::map<std::string, Json> params;  // of the top graph, settings applied; not those that are swept
  std::vector<DagNode> nodes;
  std::vector<DagOutput> outputs;
  std::vector<DagOutput> interfaces;  // outputs of subgraphs ("prune.cover"); not of a sweep: see Variant
  std::vector<Variant> variants;      // of a sweep, else none
  std::vector<Diagnostic> warnings;

  const DagNode* find(const std::string& path) const;
};

/// A loop: a graph that is one node for what is around it.
struct Loop {
  struct Comparison {
    std::string state, field;
    enum class Op { equal, unequal, less, at_most, greater, at_least } op = Op::equal;
    double number = 0;
  };
  std::vector<PortDecl> inputs, outputs;            // of the body; the outputs are the states
  Dag body;                                         // edges from outside have node `loop_input`
  std::string until;                                // as written
  std::vector<std::vector<Comparison>> conditions;  // holds when all of any holds
  std::int64_t max_iterations = 0;
  bool stop_at_limit = false;
  bool uses_seed = false;  // a node of the body does
  MemoryNeed memory;       // the most that a node of the body needs; they run one at a time
};

/// The parameters that every loop has: until, max_iterations, at_limit.
const std::vector<ParamDecl>& loop_params();

/// One --set: "epsilon" or "prune/greedy.mode" (also with dots: "prune.greedy.mode"), and its text.
struct Setting {
  std::string name, value;
};

/// What the command line says about a sweep.
struct SweepOptions {
  /// --axis: a name as in Setting, and values "0.1,0.3" or a JSON list. Replaces the axis of that name, or
  /// is one more.
  std::vector<Setting> axes;
  /// --inputs: file patterns, for the parameter that "map" names, else for the only file parameter of the
  /// graph; "name=pattern" chooses the parameter.
  std::vector<std::string> inputs;
};

/// The artifact that a text names. Throws Error that says why there is none.
using FindArtifact = std::function<ArtifactPtr(const std::string& name)>;

/// The path of a node without the variants that have it: "[epsilon=0.1]/enlarge" -> "enlarge".
std::string base_path(const std::string& path);
/// The path of a node without the entries that maps made their copies for: "links[hand]/enclose" ->
/// "links/enclose".
std::string without_entries(const std::string& path);

/// Reads, expands and checks a graph file: syntax, unknown and duplicate keys, node types, ports, types of
/// edges, required inputs, cycles, parameter kinds and ranges, settings that match nothing. Throws
/// GraphError with ALL findings. Relative paths of file parameters are relative to the current directory,
/// wherever they are written; those of subgraphs to the file that names them.
/// Limits: 64 MB of text, nesting depth 100, 1 000 000 nodes, subgraphs 50 deep, 100 000 variants.
///
/// `given`: artifacts for the "inputs" and the parameters of kind artifact, by name; they become nodes
/// "inputs/<name>". An input that is neither given nor optional is an error, as is an artifact without an
/// input of its name and type. `find` looks for other values of artifact parameters: digests and files.
Dag load_graph(const std::string& file, const Registry& registry, const std::vector<Setting>& settings = {},
               const SweepOptions& sweep = {}, const std::map<std::string, ArtifactPtr>& given = {},
               const FindArtifact& find = {});

/// The same from text; `file` is the name used in messages and the base of relative subgraph paths.
Dag parse_graph(const std::string& text, const std::string& file, const Registry& registry,
                const std::vector<Setting>& settings = {}, const SweepOptions& sweep = {},
                const std::map<std::string, ArtifactPtr>& given = {}, const FindArtifact& find = {});

/// What a graph file says of itself. Its nodes are not looked at.
struct GraphOutline {
  std::string doc;
  std::vector<ParamDecl> params;
  std::vector<std::pair<std::string, std::string>> outputs;  // name, doc
};
/// Throws GraphError with what is wrong with the file itself, and Error when it cannot be read.
GraphOutline load_outline(const std::string& file);
/// The same from text; `file` is the name used in messages.
GraphOutline parse_outline(const std::string& text, const std::string& file);

/// Which nodes the outputs of the graph need; as Dag::nodes.
std::vector<bool> needed_nodes(const Dag& dag);
/// Which nodes these need, themselves included.
std::vector<bool> needed_nodes(const Dag& dag, const std::set<std::size_t>& targets);

/// The node of this path, or all nodes of this subgraph ("prune" has "prune/reduce" and "prune/greedy"), or
/// of all copies of a map ("links/enclose" is "links[hand]/enclose" and "links[arm]/enclose"). In a sweep
/// "prune" means that of every variant, and the name of a variant all its nodes. Throws Error (code usage)
/// with the nearest path when there is none.
std::set<std::size_t> nodes_named(const Dag& dag, const std::string& path);

}  // namespace ballflow
