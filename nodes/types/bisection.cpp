#include "types/bisection.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const Bisection& search) {
  if (!(search.value >= 0) || !std::isfinite(search.value)) {
    return "the value to try is " + std::to_string(search.value);
  }
  if (search.large_enough >= 0 && search.too_small >= search.large_enough) {
    return std::to_string(search.too_small) + " is too small, but " + std::to_string(search.large_enough) +
           " is large enough";
  }
  if (search.done == 1 && (search.large_enough < 0 || search.value != search.large_enough)) {
    return "the search is done, but its value is not known to be large enough";
  }
  return {};
}

}  // namespace ballflow::geometry
