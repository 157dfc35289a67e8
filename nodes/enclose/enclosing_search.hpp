// Local search for k balls that cover all patches and waste little.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "base/random.hpp"
#include "enclose/ball_cover.hpp"

namespace ballflow::geometry {

/// Every step keeps all patches covered and none but fill_anyway() makes the waste greater. One thread; what
/// is counted is work, not time.
class EnclosingSearch {
 public:
  EnclosingSearch(BallCover& cover, Random& random, Monitor& monitor)
      : cover_(cover), random_(random), monitor_(monitor) {}

  /// Takes these balls in place of those there are, as many as there are places at most, and repairs what
  /// they leave uncovered.
  void take(const std::vector<FloatBall>& balls);
  std::vector<FloatBall> balls() const;

  /// Grows balls until every patch is covered, each time the one that needs least.
  /// Returns their places.
  std::vector<std::size_t> repair();
  /// Every ball once, in random order, up to `most` times or until that gains little.
  void sweep(int most);
  /// Splits the ball where that gains most, while there are places and that gains.
  void fill();
  /// Splits the ball where that gains most or costs least, while there are places, and does not ask whether
  /// it gains: where no single split does (a ball across a tube, say), all balls together may, once there are
  /// more.
  void fill_anyway();
  /// Hands patches at the rim of a random ball to a neighbour.
  void shift();
  /// Removes the ball that is missed least and splits another one; false when that gains nothing.
  bool swap();

 private:
  struct Split {
    bool known = false;
    bool possible = false;
    std::int64_t gain = 0;  // an estimate
    // Patches go to the first half whose middles have a key of at most `limit`: the distance from `where`, or
    // the coordinate along it.
    bool disc = false;
    Vec3 where;
    double limit = 0;
  };
  struct Removal {
    bool known = false;
    std::int64_t loss = 0;
  };

  /// Throws Cancelled when nobody wants the result any more.
  void look();
  /// Replaces ball i by one that holds what only it covers, and wastes less; frees it when it is not needed.
  bool step(std::size_t i);
  void step_around(std::size_t i, std::size_t neighbors);
  void change(std::size_t i, const FloatBall& ball);
  void drop(std::size_t i);
  void changed(const FloatBall& where);
  std::vector<std::size_t> nearest_balls(std::size_t i, std::size_t count) const;
  void step_all(const std::vector<std::size_t>& places);
  void plan_split(std::size_t i);
  /// The ball whose split gains most; places() where none can be split.
  std::size_t best_split();
  bool split(std::size_t i);
  void plan_removal(std::size_t i);
  std::vector<std::size_t> remove_and_repair(std::size_t i);
  Vec3 middle(std::int32_t patch) const;
  static double key(const Split& plan, Vec3 middle);
  FloatBall fit_to(std::size_t i, const std::vector<std::int32_t>& patches, BallFit& fit, float coarse,
                   float fine);

  BallCover& cover_;
  Random& random_;
  Monitor& monitor_;
  BallFit fit_, other_fit_;
  std::vector<std::int32_t> only_;
  std::vector<Split> splits_;
  std::vector<Removal> removals_;
};

}  // namespace ballflow::geometry
