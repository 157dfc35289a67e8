// Parameters of a node as text, and the files that its files name.
#pragma once

#include <string>

#include "ballflow/graph.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

/// What a node gets as its parameters: canonical JSON with every one that is declared.
std::string params_text(const DagNode& node);

/// {"meshes/hand.stl":{"digest":"...","format":"stl"}}, null for what is not there; no object where the node
/// does not read such files. Nodes of a body have their own.
Json named_files_manifest(const DagNode& node, Store& store);

/// "scan.OFF.gz" -> "off.gz": readers choose by it, so it belongs to the key.
std::string file_format(const std::string& path);

}  // namespace ballflow
