// What of a finished run people want to know first.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ballflow/json.hpp"
#include "ballflow/store.hpp"

namespace ballflow::cli {

/// Outputs of a graph by their names.
using NamedOutputs = std::vector<std::pair<std::string, OutputEntry>>;

/// At most three facts in words, the most important first: how many balls and how near to the fewest
/// possible, whether the topology was kept, coverage where it is not whole, distances, volumes. `params`: of
/// the graph; a changed topology names the parameter that keeps it, where there is one. None for outputs of
/// other types.
std::vector<std::string> key_facts(const NamedOutputs& outputs, const Json& params);

/// What to do about a warning that says how the topology changed, or that the surface bounds no solid; empty
/// for others.
std::string remedy_for(const std::string& warning, const Json& params);

}  // namespace ballflow::cli
