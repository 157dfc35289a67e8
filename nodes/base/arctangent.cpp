#include "base/arctangent.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {

double arctangent(double y, double x) {
  // atan(k / 8); an argument is reduced to the nearest k / 8, what remains is at most 1 / 16.
  constexpr double table[9] = {0.0,
                               0.12435499454676144,
                               0.24497866312686414,
                               0.35877067027057225,
                               0.4636476090008061,
                               0.5585993153435624,
                               0.6435011087932844,
                               0.7188299996216245,
                               0.7853981633974483};
  const double u = std::abs(x), v = std::abs(y);
  const double small = std::min(u, v), large = std::max(u, v);
  if (!(large > 0)) return 0;
  const int k = static_cast<int>(small / large * 8 + 0.5);
  const double from = 0.125 * k;
  const double t = (small - from * large) / (large + from * small);
  const double t2 = t * t;
  const double series =
      1 + t2 * (-1.0 / 3 + t2 * (1.0 / 5 + t2 * (-1.0 / 7 + t2 * (1.0 / 9 + t2 * (-1.0 / 11 + t2 / 13)))));
  double angle = table[k] + t * series;
  if (v > u) angle = pi / 2 - angle;
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

double cosine(double angle) {
  // 1 - cos of an eighth of the angle, at most .077, by its series; then cos 2a = 2 cos^2 a - 1, which in
  // terms of c = 1 - cos a is 2 c (2 - c).
  const double a2 = angle * angle / 64;
  double c = 0;
  for (int k = 14; k > 0; k -= 2) c = a2 / (k * (k - 1)) * (1 - c);
  for (int doubled = 0; doubled < 3; ++doubled) c = 2 * c * (2 - c);
  return 1 - c;
}

}  // namespace ballflow::geometry
