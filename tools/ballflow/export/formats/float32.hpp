// Doubles in formats of floats.
#pragma once

#include <cmath>
#include <string>

#include "ballflow/error.hpp"
#include "ballflow/text.hpp"

namespace ballflow {

/// The nearest float. Throws Error (usage) when it is not finite; `format` names the format.
inline float float32(double value, const std::string& format) {
  const auto single = static_cast<float>(value);
  if (std::isfinite(single)) return single;
  throw Error(ExitCode::usage,
              "the number " + std::to_string(value) + " does not fit the floats of " + format,
              "write ply or vtp, which have doubles");
}

}  // namespace ballflow
