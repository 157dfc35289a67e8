// What became of the refinement of a sample.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct Refinement {
  static constexpr std::array<std::int64_t, 3> unknown{-1, -1, -1};

  std::int64_t refined = 0;   // 1, or 0 where the points that came in were returned
  std::int64_t complete = 1;  // 0 where it was stopped by the greatest number of samples allowed
  std::int64_t left_out = 0;  // triangles with the inside on both sides, which are no surface of the solid
  std::int64_t samples = 0;
  std::int64_t rounds = 0;  // of insertions

  // Balls that reach through the surface into more of a wall or slot than they should, and are below the
  // floor: their place on the surface and how wide the wall or slot is, model units.
  Array<Vec3> limited;            // l x 3
  Array<double> widths;           // l
  Array<std::int32_t> uncovered;  // samples that no inner ball passes through, ascending

  std::array<std::int64_t, 3> wanted = unknown;  // Betti numbers of the solid
  std::array<std::int64_t, 3> cells = unknown;   // of the inner cells; unknown where they bound no surface
  std::array<std::int64_t, 3> balls = unknown;   // of the union of the inner balls

  /// The Betti numbers that the union of the inner balls should have; unknown where nobody knows them.
  const std::array<std::int64_t, 3>& aim() const { return wanted != unknown ? wanted : cells; }
  bool reached() const { return balls != unknown && balls == aim(); }
};

/// What the user should know and do, in words; empty when there is nothing.
std::string what_is_missing(const Refinement& report);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Refinement& report);

}  // namespace ballflow::geometry
