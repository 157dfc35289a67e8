// What a node library declares, as text, and as much of it as is wanted before a declaration is parsed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballflow/digest.hpp"
#include "ballflow/node_decl.hpp"

namespace ballflow {

struct TypeOutline {
  std::string id;
  int version = 0;
  std::string declaration;
};

struct NodeOutline {
  std::string id;
  bool lists_files = false;  // reads files that other files name (bf_node::files)
  std::string declaration;
  std::vector<PortOutline> ports;  // inputs, then outputs
};

struct LibraryOutline {
  std::string name, version;
  std::optional<Digest> digest;  // of the file, where keys hold it
  std::vector<TypeOutline> types;
  std::vector<NodeOutline> nodes;
};

}  // namespace ballflow
