// The JSON value of everything that people read: keys stay in the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>

// Compiled once, in base/json.cpp: every file that includes this would compile it anew, which took a quarter
// of the time of the engine's files.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace ballflow {

using Json = nlohmann::ordered_json;

}  // namespace ballflow
