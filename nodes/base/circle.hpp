// Points of the unit circle from arithmetic alone: the sine and cosine of libm differ between machines.
#pragma once

#include <array>
#include <cmath>

namespace ballflow::geometry {

/// {cos, sin} of `turns` full turns, within 1e-15. Multiples of a quarter are exact.
inline std::array<double, 2> on_circle(double turns) {
  turns -= std::floor(turns);
  const int quarter =
      static_cast<int>(std::floor(4 * turns + 0.5));  // the nearest multiple of a quarter turn
  const double x = 6.283185307179586476925 * (turns - 0.25 * quarter);  // at most pi / 4 in magnitude
  const double y = x * x;
  // Taylor polynomials: the first terms left out are below 2e-17.
  double c = 0, s = 0;
  for (int k = 16; k >= 2; k -= 2) {
    c = (1 + c) * (-y / (k * (k - 1)));
    s = (1 + s) * (-y / (k * (k + 1)));
  }
  c += 1;
  s = x * (1 + s);
  switch (quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace ballflow::geometry
