#include "minkowski/sum_of_solids.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

double largest_number(const Balls& balls) {
  double center = 0, radius = 0;
  for (const Vec3 c : balls.centers) center = std::max({center, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  for (const double r : balls.radii) radius = std::max(radius, r);
  return center + radius;
}

ComparedWith surface_of(const Enclosure& enclosure) {
  if (enclosure.triangles == 0) return ComparedWith::cloud;
  return enclosure.closed != 0 ? ComparedWith::closed_mesh : ComparedWith::open_mesh;
}

/// What is known of the balls of one side.
struct Side {
  ComparedWith compared_with = ComparedWith::nothing;
  SideProof encloses = SideProof::itself, inside = SideProof::itself;
  double gap = 0, excess = 0;  // negative: not known
};

Side compared_side(const Comparison* comparison) {
  if (comparison == nullptr) return {};
  return {static_cast<ComparedWith>(comparison->compared_with), SideProof::unknown, SideProof::unknown,
          error_bound(comparison, nullptr), -1};
}

Side compared_side(const OutlineComparison* comparison) {
  if (comparison == nullptr) return {};
  return {ComparedWith::closed_mesh, SideProof::unknown, SideProof::unknown, comparison->a_to_b_at_most, -1};
}

template <class Compared>
Side side_of(const Compared* comparison, const Enclosure* enclosure) {
  Side side = compared_side(comparison);
  if (enclosure == nullptr) return side;
  if (const std::string broken = broken_invariant(*enclosure); !broken.empty())
    throw InputError("an enclosure is damaged: " + broken, "compute it again");
  if (enclosure->balls == 0 && enclosure->triangles > 0)
    throw InputError("a solid has no balls, so that nothing bounds the error of the sum",
                     "give it balls, or leave its enclosure away");
  if (comparison == nullptr) side.compared_with = surface_of(*enclosure);
  const bool closed = surface_of(*enclosure) == ComparedWith::closed_mesh;
  side.encloses = enclosure->triangles == 0 ? SideProof::unknown
                  : enclosure->encloses()   ? SideProof::proven
                                            : SideProof::refuted;
  side.inside = !closed                      ? SideProof::unknown
                : enclosure->protrusion == 0 ? SideProof::proven
                                             : SideProof::refuted;
  if (enclosure->gap_at_most >= 0)
    side.gap = comparison != nullptr && side.gap >= 0 ? std::min(side.gap, enclosure->gap_at_most)
                                                      : enclosure->gap_at_most;
  else if (comparison == nullptr)
    side.gap = -1;
  side.excess = closed ? enclosure->protrusion : -1;
  return side;
}

}  // namespace

Balls moved_radii(const Balls& balls, SumMode mode, double by) {
  if (mode == SumMode::balanced) return balls;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double r = mode == SumMode::outer ? balls.radii[i] + by : balls.radii[i] - by;
    if (r < 0) continue;
    centers.push_back(balls.centers[i]);
    radii.push_back(r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

double rounding_of_sums(const Balls& a, const Balls& b) {
  return 0x1p-48 * (largest_number(a) + largest_number(b));
}

namespace {

/// The sum by `sum(a, b)`, and what follows.
template <class Compared, class MakeSum>
auto sided_sum(const Balls& a, const Balls& b, SumMode mode, const Compared& compared,
               const SolidEnclosures& enclosed, const MakeSum& make) {
  for (const Balls* side : {&a, &b}) {
    if (const std::string broken = broken_invariant(*side); !broken.empty())
      throw InputError((side == &a ? "a: " : "b: ") + broken, "repair or remove the ball");
  }
  const double rounding = mode == SumMode::balanced ? 0 : rounding_of_sums(a, b);
  auto sum = mode == SumMode::balanced ? make(a, b)
                                       : make(moved_radii(a, mode, rounding), moved_radii(b, mode, rounding));
  const Side of_a = side_of(compared.a, enclosed.a), of_b = side_of(compared.b, enclosed.b);
  MinkowskiReport& report = sum.report;
  report.a_compared_with = static_cast<std::uint8_t>(of_a.compared_with);
  report.b_compared_with = static_cast<std::uint8_t>(of_b.compared_with);
  report.rounded = static_cast<std::uint8_t>(mode == SumMode::outer   ? SumsRounded::outwards
                                             : mode == SumMode::inner ? SumsRounded::inwards
                                                                      : SumsRounded::to_nearest);
  report.a_encloses = static_cast<std::uint8_t>(of_a.encloses);
  report.b_encloses = static_cast<std::uint8_t>(of_b.encloses);
  report.a_inside = static_cast<std::uint8_t>(of_a.inside);
  report.b_inside = static_cast<std::uint8_t>(of_b.inside);
  report.error_bound = report.excess_bound = -1;
  if (why_unbounded(of_a.compared_with, of_b.compared_with).empty()) {
    const double shrunk = mode == SumMode::inner ? 2 * rounding : 0,
                 grown = mode == SumMode::outer ? 2 * rounding : 0;
    if (of_a.gap >= 0 && of_b.gap >= 0)
      report.error_bound = report.contains() ? 0 : of_a.gap + of_b.gap + shrunk;
    if (of_a.excess >= 0 && of_b.excess >= 0)
      report.excess_bound = report.inside() ? 0 : of_a.excess + of_b.excess + grown;
  }
  return sum;
}

}  // namespace

MinkowskiSum sum_of_solids(const Balls& a, const Balls& b, SumMode mode, const SolidComparisons& compared,
                           const SolidEnclosures& enclosed, const MinkowskiSumOptions& options,
                           Monitor& monitor) {
  return sided_sum(a, b, mode, compared, enclosed, [&](const Balls& of_a, const Balls& of_b) {
    return minkowski_sum(of_a, of_b, options, monitor, compared);
  });
}

MinkowskiSum2 sum_of_polygons(const Balls& a, const Balls& b, SumMode mode,
                              const PolygonComparisons& compared, const SolidEnclosures& enclosed,
                              const MinkowskiSum2Options& options, Monitor& monitor) {
  return sided_sum(a, b, mode, compared, enclosed, [&](const Balls& of_a, const Balls& of_b) {
    return minkowski_sum_2(of_a, of_b, options, monitor, compared);
  });
}

}  // namespace ballflow::geometry
