// Action keys. The key of a node is the SHA-256 of its manifest: everything that may change its outputs, and
// nothing else (no names, paths, times, thread counts).
//
// Manifest: a JSON text for people and explain, from which the hashed bytes are derived field by field,
// each length-prefixed and type-tagged (doubles as IEEE bits, -0 as 0):
//   {"format":2,"node":"Enlarge","version":1,"libraries":{...},"params":{...},"seed":null,
//    "inputs":{"balls":{"type":"Balls","version":1,"digest":"..."}}}
// A loop has "body" too: {"nodes":{"0:Reduce":{...,"inputs":{"cover":"inputs.cover"},
//   "input_types":{"cover":{"type":"CoverState","version":1}},"output_types":{...}}},"states":{...}}.
// A file parameter appears as {"file":{"digest":"...","format":"off.gz"}}; files that such a file names and
// the node reads, too, are {"files":{"meshes/hand.stl":{"digest":"...","format":"stl"}}} beside "params",
// null where there is no such file. A node of a library outside the installed folder has "library_file", the
// SHA-256 of that file: it may be built anew any time without another version.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ballflow/digest.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

/// A file that a node reads because another file names it: the name that is written there, and where it is;
/// empty where it is not.
struct FileOfNode {
  std::string name, path;
};

/// Such files of a node, in loops those of the nodes of the body, too; by name.
std::vector<FileOfNode> files_named_by(const DagNode& node);

struct ActionKey {
  Digest key;
  std::string manifest;
};

/// The key of `node` when its inputs have the given entries (by port). Reads the digests of file parameters
/// through `store`; throws Error when such a file cannot be read.
ActionKey action_key(const DagNode& node, const std::map<std::string, OutputEntry>& inputs,
                     std::uint64_t seed, Store& store);

/// The key that a manifest stands for. Throws Error when the text is no JSON object.
Digest key_of(const std::string& manifest);

}  // namespace ballflow
