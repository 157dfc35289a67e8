// Whether the union of chosen balls has the topology of the union of all of them, and what was done about it.
#pragma once

#include <cstdint>
#include <string>

#include "types/topology_table.hpp"

namespace ballflow::geometry {

/// Betti numbers over Z/2 of a part of a set of balls and of all of it, and the ranks of the three maps
/// that the inclusion of the unions induces in homology.
struct InclusionHomology {
  Betti part{0, 0, 0};
  Betti whole{0, 0, 0};
  Betti rank{0, 0, 0};  // at most part and whole

  /// All three maps are isomorphisms. Equal Betti numbers alone do not prove it.
  bool isomorphism() const { return part == whole && rank == whole; }
  friend bool operator==(const InclusionHomology&, const InclusionHomology&) = default;
};

struct TopologyCheck {
  std::int64_t kept = 0;      // balls before the repair
  std::int64_t returned = 0;  // balls that the repair returned

  // Betti numbers of all balls, of the balls before and after the repair, and the ranks of the maps.
  Betti whole{0, 0, 0};
  Betti before{0, 0, 0}, before_rank{0, 0, 0};
  Betti after{0, 0, 0}, after_rank{0, 0, 0};

  std::int64_t inclusions = 0;  // how many sets of balls were compared with the whole
  std::uint8_t everything = 0;  // 1 where nothing less than all balls had the right topology

  InclusionHomology inclusion_before() const { return {before, whole, before_rank}; }
  InclusionHomology inclusion_after() const { return {after, whole, after_rank}; }
};

/// "the inclusion is an isomorphism", or what it misses: "2 tunnels are lost, 1 cavity is extra".
std::string describe(const InclusionHomology& inclusion);
/// What was wrong and what it took: "2 tunnels are lost: 5 balls returned".
std::string describe(const TopologyCheck& check);

/// Empty when numbers fit together, else what is wrong.
std::string broken_invariant(const TopologyCheck& check);

}  // namespace ballflow::geometry
