// Balls for the links of a robot, and which links need not be tested against each other.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "types/balls.hpp"
#include "types/robot.hpp"

namespace ballflow::geometry {

/// Why two links need no test against each other.
enum class PairReason : std::uint8_t {
  adjacent = 0,    // a joint joins them
  in_default = 1,  // their balls meet where all joints are at 0, or nearest to it
  always = 2,      // they met in every pose that was tried
  never = 3,       // they met in none
};
const char* name_of(PairReason reason);

struct RobotSpheres : RobotTree {
  Array<std::int64_t> ball_ends;                  // l: where the balls of each link end
  Array<Vec3> centers;                            // n x 3: in the frame of their link, metres
  Array<double> radii;                            // n, metres
  Array<std::array<std::int32_t, 2>> pair_links;  // p x 2: links, the first before the second; ascending
  Array<std::uint8_t> pair_reasons;               // p: PairReason
  std::int64_t poses = 0;                         // that were tried; 0: pairs were not looked for
  // Where a proof that the balls contain their links failed: points of surfaces that are not covered, one of
  // each such triangle, and of voids inside. Both empty where nothing was proven or tried.
  Array<std::int64_t> open_ends;  // l: where those of each link end
  Array<Vec3> open_points;        // in the frame of their link, metres

  std::size_t links() const { return ball_ends.size(); }
};

/// The balls of a link.
Balls balls_of(const RobotSpheres& spheres, std::size_t link);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const RobotSpheres& spheres);

}  // namespace ballflow::geometry
