// The lists that a map goes over.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "document/findings.hpp"
#include "document/graph_file.hpp"

namespace ballflow {

/// A parameter of the body of a map, and what it has in each copy.
struct MapList {
  const ParamDecl* param = nullptr;  // of the body
  std::vector<std::string> entries;  // one for each copy, or one for all
  Offset offset = 0;                 // of the list
};

/// One copy of a map; no copy where there are no lists.
struct MapEntry {
  const std::vector<MapList>* lists = nullptr;
  std::size_t index = 0;

  MapEntry() = default;
  MapEntry(const std::vector<MapList>& all, std::size_t copy) : lists(&all), index(copy) {}
  /// Null when no list is for this parameter.
  const MapList* list_of(const ParamDecl& param) const;
};

/// Reads what a map goes over. False when that cannot be used; `params` are those of the file of the map, and
/// what depends on one that was reported is left out silently.
bool read_map(const GraphFile& file, const std::vector<std::optional<Json>>& params, const GraphNode& node,
              const GraphNode::Map& written, const GraphFile& body, std::vector<MapList>& lists,
              Findings& findings);

/// The value of the parameter in a copy. Nothing when its entry is none, which is reported.
std::optional<Json> entry_value(const GraphFile& file, const MapList& list, std::size_t copy,
                                Findings& findings);

}  // namespace ballflow
