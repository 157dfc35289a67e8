// The topology of a shape at the stages of a pipeline: Euler characteristic and Betti numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/array.hpp"

namespace ballflow::geometry {

using Betti = std::array<std::int64_t, 3>;  // components, tunnels, cavities

/// One component, and no class of any other dimension: where a union and a part of it have these Betti
/// numbers, there is nothing that the inclusion could map wrongly.
inline constexpr Betti of_a_ball{1, 0, 0};

/// What a row is about, in the order of the pipeline.
enum class TopologyStage : std::uint8_t {
  surface = 0,   // the solid that a closed surface bounds
  inner = 1,     // the union of the inner polar balls
  enlarged = 2,  // the union of the enlarged balls
  kept = 3,      // the union of the balls that are left after pruning
  complex = 4,   // the alpha-shape of the balls that are left
  axis = 5,      // their medial axis, from its own cells
};
inline constexpr std::size_t topology_stages = 6;

/// "surface", "inner", ...: the beginning of names of fields.
const char* name(TopologyStage stage);

struct TopologyTable {
  static constexpr std::int64_t unknown = -1;

  Array<std::uint8_t> stages;  // n, TopologyStage, ascending
  // n: components, tunnels, cavities, each >= 0 or all `unknown` (an open surface bounds no solid).
  Array<Betti> betti;
  Array<std::int64_t> euler;  // n: Euler characteristics; 0 where the Betti numbers are unknown

  std::size_t size() const { return stages.size(); }
  bool known(std::size_t row) const { return betti[row][0] != unknown; }
  std::optional<std::size_t> row(TopologyStage stage) const;
};

/// A table of one row; without Betti numbers they are unknown.
TopologyTable one_row(TopologyStage stage, const std::optional<Betti>& betti);

/// What differs between one known row and the next, in words: "pruning closed 2 tunnels". Empty when all
/// rows agree. A difference of Betti numbers is a difference of topology; equal ones do not prove that there
/// is none.
std::vector<std::string> topology_changes(const TopologyTable& table);

/// "1 component, 2 tunnels, no cavity".
std::string describe(const Betti& betti);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const TopologyTable& table);

}  // namespace ballflow::geometry
