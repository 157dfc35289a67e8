// A search for the smallest growth with which few enough balls cover a sample.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

struct Bisection {
  double value = 0;                // to be tried next; once done, the answer
  double too_small = -1;           // largest value known to need too many balls; -1 for none
  double large_enough = -1;        // smallest value known to need few enough; -1 for none
  std::int64_t balls = -1;         // what large_enough needs
  std::int64_t balls_before = -1;  // what too_small needs
  std::int64_t tried = 0;          // values that were tried
  std::int64_t done = 0;           // 1 at the end
};

/// Empty when the numbers fit each other, else what is wrong.
std::string broken_invariant(const Bisection& search);

}  // namespace ballflow::geometry
