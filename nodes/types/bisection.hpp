// A search for a growth: the smallest one with which few enough balls cover a sample, or the largest one with
// which the error of the balls is allowed.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

struct Bisection {
  double value = 0;  // to be tried next; once done, the answer

  // Searches for a number of balls (cover/bisect.hpp).
  double too_small = -1;           // largest value known to need too many balls; -1 for none
  double large_enough = -1;        // smallest value known to need few enough; -1 for none
  std::int64_t balls = -1;         // what large_enough needs
  std::int64_t balls_before = -1;  // what too_small needs

  // Searches for an error (cover/bisect_error.hpp); -1 for none.
  double within = -1;        // largest value known to have an error that is allowed
  double beyond = -1;        // smallest value known to have a larger one
  double error = -1;         // of `within`, model units
  double error_before = -1;  // of `beyond`

  std::int64_t tried = 0;  // values that were tried
  std::int64_t done = 0;   // 1 at the end; nothing was tried where the value was given
};

/// Empty when the numbers fit each other, else what is wrong.
std::string broken_invariant(const Bisection& search);

}  // namespace ballflow::geometry
