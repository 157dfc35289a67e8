// How far balls have grown, and what stopped them.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Why the radius of a ball is not larger.
enum class GrowthStop : std::uint8_t {
  wish = 0,       // it has grown as far as was asked for
  poles = 1,      // it might reach the outer medial axis (thesis, Lemma 3.4)
  gabriel = 2,    // it would reach a critical Gabriel point (thesis, 3.5.2)
  neighbour = 3,  // a ball near it has stopped, and the topology of the union would change if it went on
};

struct Growth {
  Array<Vec3> centers;        // n x 3, model units
  Array<double> radii;        // n, before
  Array<double> grown_radii;  // n, after; never smaller
  Array<double> limits;       // n, the largest radius allowed, whatever is asked for; infinity for no limit
  Array<std::uint8_t> stops;  // n, GrowthStop

  // Components, tunnels and cavities of the union before and after; -1 where nobody has looked.
  std::array<std::int64_t, 3> betti_before{-1, -1, -1};
  std::array<std::int64_t, 3> betti_after{-1, -1, -1};
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Growth& growth);

}  // namespace ballflow::geometry
