// How many balls each of several objects gets.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"

namespace ballflow::geometry {

struct BallCounts {
  Array<std::int32_t> counts;  // n, at least 1
  Array<double> outside;       // n, cubed model units: the volume outside that is expected with them
};

/// Empty when every object has a ball and every volume is a number that is not negative, else what is wrong.
std::string broken_invariant(const BallCounts& counts);

}  // namespace ballflow::geometry
