#include "types/ball_distance.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace ballflow::geometry {
namespace {

std::string four_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// One side of the balls with clearances; `others` balls are on the other one.
std::string broken_side(const char* side, std::int64_t balls, std::int64_t others, const Array<Vec3>& centers,
                        const Array<double>& radii, const Array<double>& clearances,
                        const Array<std::int32_t>& nearest) {
  const std::size_t n = radii.size();
  if (n != 0 && static_cast<std::int64_t>(n) != balls)
    return std::string("clearances of ") + side + " are not those of all its balls";
  if (centers.size() != n || clearances.size() != n || nearest.size() != n)
    return std::string("balls of ") + side + " without center, radius, clearance or nearest ball";
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(centers[i]) || !(radii[i] >= 0) || !std::isfinite(radii[i]) ||
        !std::isfinite(clearances[i]) || nearest[i] < 0 || nearest[i] >= others)
      return std::string("ball ") + std::to_string(i) + " of " + side +
             " has a number that is not finite, or a nearest ball that is not there";
  }
  return {};
}

}  // namespace

std::string describe(const BallDistance& d) {
  const std::string pair = " (ball " + std::to_string(d.a) + " of a, ball " + std::to_string(d.b) + " of b)";
  if (d.separation == 0) return "touching" + pair;
  return d.separation > 0 ? four_digits(d.separation) + " apart" + pair
                          : "overlapping, the deepest pair by " + four_digits(-d.separation) + pair;
}

std::string describe_solids(const BallDistance& d) {
  if (d.a_solid == 0 && d.b_solid == 0) return {};
  if (d.solids_at_most < 0) return "nothing is known about the solids: there is no surface of them";
  const std::string most = four_digits(d.solids_at_most);
  if (d.solids_at_most == 0) return "the solids meet: proven";
  if (d.solids_at_least > 0)
    return "the solids are at least " + four_digits(d.solids_at_least) + " and at most " + most +
           " apart: proven";
  const bool contained = d.a_solid != static_cast<std::uint8_t>(SolidOfBalls::near_by) &&
                         d.b_solid != static_cast<std::uint8_t>(SolidOfBalls::near_by);
  return (contained ? "the solids may meet; they are at most " : "the solids are at most ") + most +
         " apart: proven" + (contained ? "" : "; whether they meet is not, for balls do not contain them");
}

std::string broken_invariant(const BallDistance& d) {
  if (d.balls_a < 1 || d.balls_b < 1) return "one of the sets has no balls";
  if (d.a < 0 || d.a >= d.balls_a || d.b < 0 || d.b >= d.balls_b) return "the nearest pair is not there";
  if (!std::isfinite(d.separation) || !is_finite(d.point_a) || !is_finite(d.point_b))
    return "the smallest separation or its points are not finite";
  if (!std::isfinite(d.threshold)) return "the threshold is not finite";
  if (d.cut > 1) return "cut is " + std::to_string(d.cut) + ", not 0 or 1";
  const std::size_t p = d.pairs.size();
  if (d.separations.size() != p || d.pair_points_a.size() != p || d.pair_points_b.size() != p)
    return "pairs without separation or points";
  for (std::size_t i = 0; i < p; ++i) {
    const auto [a, b] = d.pairs[i];
    const std::string place = "pair " + std::to_string(i);
    if (a < 0 || a >= d.balls_a || b < 0 || b >= d.balls_b) return place + " names a ball that is not there";
    if (!(d.separations[i] >= d.separation && d.separations[i] <= d.threshold))
      return place + " has a separation below the smallest, or above the threshold";
    if (!is_finite(d.pair_points_a[i]) || !is_finite(d.pair_points_b[i]))
      return place + " has points that are not finite";
    if (i == 0) continue;
    const auto [last_a, last_b] = d.pairs[i - 1];
    // Separations are rounded: different ones may look equal, so that balls need not ascend.
    if (d.separations[i - 1] > d.separations[i]) return place + " comes after one with a larger separation";
    if (last_a == a && last_b == b) return place + " is there twice";
  }
  if (std::string why =
          broken_side("a", d.balls_a, d.balls_b, d.centers_a, d.radii_a, d.clearances_a, d.nearest_a);
      !why.empty())
    return why;
  if (std::string why =
          broken_side("b", d.balls_b, d.balls_a, d.centers_b, d.radii_b, d.clearances_b, d.nearest_b);
      !why.empty())
    return why;
  const auto unknown = static_cast<std::uint8_t>(SolidOfBalls::unknown);
  for (const std::uint8_t solid : {d.a_solid, d.b_solid}) {
    if (solid > unknown) return "a_solid or b_solid is above 3";
  }
  if (d.a_solid == unknown || d.b_solid == unknown)
    return d.solids_at_least == 0 && d.solids_at_most == -1
               ? ""
               : "a bound about a solid of which nothing is known";
  if (!(d.solids_at_least >= 0 && d.solids_at_least <= d.solids_at_most && std::isfinite(d.solids_at_most)))
    return "the distance of the solids is at least more than at most, or not finite";
  return {};
}

}  // namespace ballflow::geometry
