// Which balls to return where the union of some balls has another topology than the union of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "homology/inclusion_homology.hpp"

namespace ballflow::geometry {

/// What one comparison of U* with U+ says about the balls that are missing (see inclusion_homology.hpp).
class Diagnosis {
 public:
  using Ids = std::vector<std::int32_t>;  // of balls of U+ that are vertices of K+; some may be kept already
  /// What tells places of defects apart from round to round: what kind, and a kept ball there.
  using Place = std::pair<int, std::int32_t>;

  /// `kept` are the balls of U*, ascending. Keeps references to `whole`, `inclusion` and `monitor`.
  Diagnosis(const UnionOfBalls& whole, std::span<const std::int32_t> kept, const Inclusion& inclusion,
            Monitor& monitor);
  ~Diagnosis();

  /// Balls that join what is apart, or begin what is missing altogether.
  Ids for_components();

  /// Balls that close loops of U+ that U* has not. Every component must be matched.
  Ids for_lost_loops();

  /// The `effort` balls around every loop of U* that U+ has filled, every void of U* that U+ has filled, and
  /// every wall between voids that U* lacks, that are nearest to a good guess.
  ///
  /// One ball for every place, and twice as many for one that was met in the round before; at least `effort`.
  Ids for_filled(std::map<Place, std::size_t>& efforts, std::size_t effort);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace ballflow::geometry
