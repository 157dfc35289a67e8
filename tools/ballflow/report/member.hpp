// How reports are read: a name that is not there is null.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace ballflow {

/// The member of an object; null when it has none of this name, or is no object.
inline const nlohmann::json& member(const nlohmann::json& object, const std::string& name) {
  static const nlohmann::json null;
  if (!object.is_object()) return null;
  const auto found = object.find(name);
  return found == object.end() ? null : *found;
}

/// The number that a value is; NaN when it is none.
inline double number_of(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ballflow
