// The union of balls, and samples of its boundary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "measure/blocks.hpp"
#include "search/box_tree.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// The union of balls, which must outlive it.
class BallUnion {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  explicit BallUnion(const Balls& balls) : balls_(balls), tree_(balls.centers.span()) {
    tree_.set_slacks(balls.radii);
  }

  const Balls& balls() const { return balls_; }

  /// The smallest |p - c| - r of the balls but `except`: minus how deep p is in the ball in which it is
  /// deepest; outside the union its distance. Where it is below `enough`, some value below `enough`; the same
  /// bits whatever the order of the balls otherwise.
  double depth(Vec3 p, double enough = -std::numeric_limits<double>::infinity(),
               std::size_t except = none) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return tree_.smallest(p, infinity, enough, [&](std::size_t i) {
      return i == except ? infinity : distance(p, balls_.centers[i]) - balls_.radii[i];
    });
  }

  /// Calls visit(j) for all balls that the sphere of ball i may meet.
  template <class Visit>
  void for_neighbours(std::size_t i, const Visit& visit) const {
    tree_.below(balls_.centers[i], balls_.radii[i], visit);
  }

 private:
  const Balls& balls_;
  BoxTree tree_;
};

struct BoundarySamples {
  std::vector<Vec3> positions;            // on spheres, by ball
  std::vector<double> areas;              // of the parts of the spheres that they stand for
  std::vector<std::uint8_t> on_boundary;  // 0: up to the spacing inside another ball

  std::size_t size() const { return positions.size(); }
};

/// Splits every sphere in parts none of whose points is farther than `spacing` from its sample, and leaves
/// out parts deep inside other balls. `tolerance` is that of positions, far above rounding. Spends what it
/// samples or splits, for all spheres together, and so ends, by InputError, before memory does.
BoundarySamples boundary_samples(const BallUnion& all, double spacing, double tolerance, Budget& budget,
                                 Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
