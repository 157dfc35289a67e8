// Units of work for other machines: parts of a DAG that are written to files, each complete but for what it
// reads from outside, and run there without the graph.
//
// A key holds digests of inputs, which nobody knows before the inputs are made; so a unit names what it reads
// by the unit and the path that make it, and whoever runs it finds the key there (units report the keys of
// their nodes) and the result in the upstream (upstream.hpp), through which alone units hand results on.
//
// File of a unit, JSON:
//   {"format":1,"run":"...","unit":"0-17","seed":0,"threads":1,"seconds":300.0,
//    "outside":[{"path":"read","unit":"0-3"}, {"path":"poles","key":"<hex>"},
//               {"path":"inputs/balls","artifact":{"type":"Balls","version":1,"digest":"<hex>","bytes":0,
//                "checksum":["<hex>","<hex>"],"summary":"{}"}}],
//    "nodes":[{"path":"enlarge","type":"Enlarge","version":1,"params":{...},"inputs":{"balls":[-1,"balls"]}}]}
// An edge is [node, port]: 0 and above count "nodes", -1 is the first of "outside", -2 the second. Nodes are
// in topological order. A loop has "loop" in place of "version":
// {"inputs":[port],"outputs":[port],"until":"...",
// "conditions":[[["state","field",op,number]]],"max_iterations":n,"stop_at_limit":false,"uses_seed":false,
// "memory":[fixed,per_input_byte],"file":"...","params":{...},"body":[nodes],"states":[["name",edge]]}; edges
// from outside its body are [null, input].
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/run.hpp"

namespace ballflow {

/// A node that a unit reads from and does not run.
struct OutsideNode {
  std::string path;
  std::string unit;                     // that runs it; else one of the following
  std::optional<Digest> key;            // its entry is in the upstream already
  std::optional<OutputEntry> artifact;  // it was given to the graph, and its blob is in the upstream

  friend bool operator==(const OutsideNode&, const OutsideNode&) = default;
};

struct Unit {
  std::string run, name;
  std::uint64_t seed = 0;
  unsigned threads = 1;
  double seconds = 0;                // that it may take; 0: as long as it likes
  std::vector<DagNode> nodes;        // edges: below nodes.size() among themselves, above that to `outside`
  std::vector<OutsideNode> outside;  // the node of edge nodes.size() + i
};

std::string unit_text(const Unit& unit);
/// Throws Error: code store when the text is no unit, plugin when a node type is missing here or has another
/// behaviour version than where the unit was written.
Unit read_unit(const std::string& text, const Registry& registry);

struct PackOptions {
  double unit_seconds = 300;                    // short nodes are put together until a unit is worth as much
  double unknown_seconds = 1;                   // of a node that never ran
  std::map<std::string, double> usual_seconds;  // the same by node type, where that is known
  std::uint64_t base = 384u << 20;              // bytes that a process needs besides its nodes
  std::size_t most_units = SIZE_MAX;            // in one array
  // By node of the Dag, empty: as predicted. How many times as much memory and time it gets: it ran out
  // before.
  std::vector<double> memory_factor, time_factor;
  std::vector<bool> alone;  // by node, empty: none. Its chain is a unit of its own: it may end the process
};

/// A unit before it is written.
struct PackedUnit {
  std::vector<std::size_t> nodes;  // of the Dag, in its order
  double seconds = 0;              // predicted
};

/// Units of one level and one class of memory: none reads from another one of them.
struct UnitArray {
  std::size_t level = 0;
  std::uint64_t memory = 0;  // bytes for one unit: a power of two
  bool unknown = false;      // has a node that never ran: its seconds are a guess
  double time_factor = 1;    // the most of its nodes
  std::vector<PackedUnit> units;
  std::vector<std::size_t> needs;  // arrays that it reads from, earlier ones
  bool one_to_one = false;         // it needs one array, and unit i of that alone for its unit i

  double longest() const;  // seconds
};

/// Puts the nodes that have to run (verdicts run and maybe) into units: a chain of nodes that only read each
/// other is one piece of work, and short pieces of one level are packed together by the order of the DAG.
/// Arrays are in an order in which they may be submitted.
std::vector<UnitArray> pack(const Dag& dag, const std::vector<NodePlan>& plans, const PackOptions& options);

/// The unit of these nodes. `unit_of`: the name of the unit that runs a node of the Dag, empty for one that
/// is known.
Unit make_unit(const Dag& dag, const std::vector<NodePlan>& plans, const std::vector<std::size_t>& nodes,
               const std::vector<std::string>& unit_of);

}  // namespace ballflow
