// The JSON value of everything that people read: keys stay in the order in which they were written.
#pragma once

#include <nlohmann/json.hpp>

namespace ballflow {

using Json = nlohmann::ordered_json;

}  // namespace ballflow
