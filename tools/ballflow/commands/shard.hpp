// A part of a sweep, for people with schedulers of their own.
#pragma once

#include <set>
#include <string>

#include "ballflow/graph.hpp"

namespace ballflow::cli {

/// The nodes of the variants of a part: "2/5" has the second variant, the seventh, ... Throws Error (code
/// usage) when the text is no such part, when the graph has no variants, and when the part has none.
std::set<std::size_t> nodes_of_shard(const Dag& dag, const std::string& shard);

}  // namespace ballflow::cli
