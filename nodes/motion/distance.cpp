#include "motion/distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "exact/separation.hpp"
#include "motion/ball_boxes.hpp"
#include "motion/near_pairs.hpp"

namespace ballflow::geometry {
namespace {

void check(const char* name, const Balls& balls, const Enclosure* proof) {
  if (balls.size() == 0) {
    throw InputError(std::string(name) + " has no balls: nothing has a distance from it",
                     "give both sides at least one ball");
  }
  if (std::string why = broken_invariant(balls); !why.empty())
    throw InputError(std::string("the balls of ") + name + " cannot be used: " + why,
                     "look for the step that made them");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z), balls.radii[i]}) <= largest_separable)
      continue;
    throw InputError(
        "ball " + std::to_string(i) + " of " + name + " has a coordinate or a radius beyond 1e140",
        "use another unit of length");
  }
  if (proof != nullptr && proof->balls != static_cast<std::int64_t>(balls.size())) {
    throw InputError("the enclosure of " + std::string(name) + " is about " + std::to_string(proof->balls) +
                         " balls, and " + name + " has " + std::to_string(balls.size()),
                     "connect the enclosure that VerifyEnclosure found for these balls");
  }
}

struct Witness {
  Vec3 a, b;
};
Witness witness_of(const BallPair& pair) {
  Vec3 way = pair.b - pair.a;
  const double largest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
  // Concentric balls overlap as deep in every direction.
  way = largest > 0 ? Vec3{way.x / largest, way.y / largest, way.z / largest} : Vec3{1, 0, 0};
  const double norm = length(way);
  const Vec3 unit{way.x / norm, way.y / norm, way.z / norm};
  return {pair.a + pair.radius_a * unit, pair.b - pair.radius_b * unit};
}

SolidOfBalls solid_of(const Enclosure* proof) {
  if (proof == nullptr) return SolidOfBalls::their_union;
  if (proof->triangles == 0) return SolidOfBalls::unknown;
  return proof->encloses() ? SolidOfBalls::enclosed : SolidOfBalls::near_by;
}

double sum_upwards(double a, double b) {
  return b == 0 ? a : std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

void add_solids(BallDistance& d, const BallPair& nearest, const SolidsOfBalls& solids) {
  const SolidOfBalls a = solid_of(solids.a), b = solid_of(solids.b);
  d.a_solid = static_cast<std::uint8_t>(a);
  d.b_solid = static_cast<std::uint8_t>(b);
  if (a == SolidOfBalls::unknown || b == SolidOfBalls::unknown) {
    d.solids_at_most = -1;
    return;
  }
  // Balls that contain the solids keep them apart.
  if (a != SolidOfBalls::near_by && b != SolidOfBalls::near_by)
    d.solids_at_least = std::max(0.0, separation_at_least(nearest));
  // The nearest points of the balls are no farther from the solids than the balls stand out.
  d.solids_at_most = std::max(0.0, separation_at_most(nearest));
  for (const Enclosure* proof : {solids.a, solids.b}) {
    if (proof != nullptr) d.solids_at_most = sum_upwards(d.solids_at_most, proof->protrusion);
  }
}

void add_pairs(BallDistance& d, std::vector<NearPair> below, std::size_t most) {
  d.cut = below.size() > most ? 1 : 0;
  if (d.cut != 0) below.resize(most);
  std::vector<std::array<std::int32_t, 2>> pairs;
  std::vector<double> separations;
  std::vector<Vec3> points_a, points_b;
  for (const NearPair& pair : below) {
    const Witness w = witness_of(pair.balls);
    pairs.push_back({pair.a, pair.b});
    separations.push_back(nearest_separation(pair.balls));
    points_a.push_back(w.a);
    points_b.push_back(w.b);
  }
  d.pairs = std::move(pairs);
  d.separations = std::move(separations);
  d.pair_points_a = std::move(points_a);
  d.pair_points_b = std::move(points_b);
}

struct Clearances {
  Array<double> separations;
  Array<std::int32_t> nearest;
};
Clearances clearances_of(const BallBoxes& balls, const BallBoxes& others, Monitor& monitor) {
  const std::vector<NearPair> pairs = nearest_of_every(balls, others, monitor);
  std::vector<double> separations(pairs.size());
  std::vector<std::int32_t> nearest(pairs.size());
  for_each_block(pairs.size(), 4096, no_monitor(), 0, 1,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   Lookout look(monitor);
                   for (std::size_t i = first; i < last; ++i) {
                     look(256);
                     separations[i] = nearest_separation(pairs[i].balls);
                     nearest[i] = pairs[i].b;
                   }
                 });
  return {std::move(separations), std::move(nearest)};
}

}  // namespace

BallDistance ball_distance(const Balls& a, const Balls& b, const DistanceOptions& options, Monitor& monitor,
                           const SolidsOfBalls& solids) {
  if (!std::isfinite(options.threshold)) throw InputError("threshold is not finite", "give a length");
  if (options.most_pairs < 0) throw InputError("most_pairs is negative", "0 lists none");
  check("a", a, solids.a);
  check("b", b, solids.b);
  const auto most = static_cast<std::size_t>(options.most_pairs);

  const double share = options.every_ball ? 0.3 : 1;
  const BallBoxes boxes_a(a, monitor), boxes_b(b, monitor);
  monitor.step(0.5 * share);
  PartMonitor part(monitor, 0.5 * share, share);
  // One more than wanted tells whether there are more.
  const NearPairs found = near_pairs(boxes_a, boxes_b, options.threshold, most == 0 ? 0 : most + 1, part);

  BallDistance d;
  d.balls_a = static_cast<std::int64_t>(a.size());
  d.balls_b = static_cast<std::int64_t>(b.size());
  d.a = found.nearest.a;
  d.b = found.nearest.b;
  d.separation = nearest_separation(found.nearest.balls);
  const Witness w = witness_of(found.nearest.balls);
  d.point_a = w.a;
  d.point_b = w.b;
  d.threshold = options.threshold;
  add_pairs(d, found.below, most);
  if (most == 0 && compare_separation(found.nearest.balls, options.threshold) <= 0) d.cut = 1;
  add_solids(d, found.nearest.balls, solids);
  if (options.every_ball) {
    PartMonitor first(monitor, share, (1 + share) / 2), second(monitor, (1 + share) / 2, 1);
    Clearances of_a = clearances_of(boxes_a, boxes_b, first), of_b = clearances_of(boxes_b, boxes_a, second);
    d.centers_a = a.centers;
    d.radii_a = a.radii;
    d.clearances_a = of_a.separations;
    d.nearest_a = of_a.nearest;
    d.centers_b = b.centers;
    d.radii_b = b.radii;
    d.clearances_b = of_b.separations;
    d.nearest_b = of_b.nearest;
  }
  return d;
}

}  // namespace ballflow::geometry
