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
  if (search.within >= 0 && search.beyond >= 0 && search.within >= search.beyond) {
    return "the error is allowed at " + std::to_string(search.within) + ", but not at " +
           std::to_string(search.beyond);
  }
  if ((search.within >= 0) != (search.error >= 0) || (search.beyond >= 0) != (search.error_before >= 0)) {
    return "a value has no error, or an error no value";
  }
  const bool by_balls = search.large_enough >= 0 && search.value == search.large_enough,
             by_error = search.within >= 0 && search.value == search.within;
  if (search.done == 1 && search.tried > 0 && !by_balls && !by_error) {
    return "the search is done, but its value is not known to be large enough";
  }
  return {};
}

}  // namespace ballflow::geometry
