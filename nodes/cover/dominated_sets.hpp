// Which sets of a family are contained in others, or contain others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "cover/reduce.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

enum class Keep : std::uint8_t { maximal, minimal };

/// A family of sets and how it is looked at. `members` is the transposed family: members[e] are the sets that
/// contain element e.
struct SetFamily {
  const Csr& sets;
  const Csr& members;
  SubsetTest test;                     // how candidates are found
  std::span<const std::int32_t> rank;  // orders the elements for SubsetTest::bandwidth; empty otherwise
};

/// Marks the sets that are not maximal (a proper superset exists, or an equal set of lower index) or not
/// minimal. Only pairs are looked at whose inner set is in `dirty`.
///
/// The order by inclusion, then index, is strict, so what must go goes whatever else went before it: sets
/// already marked may be skipped, and threads may mark in any order, without changing the outcome.
///
/// Why dirty sets suffice after the first pass: sets only lose elements, so an inclusion is new only if
/// its inner set has lost one since the last pass.
std::vector<std::uint8_t> dominated_sets(const SetFamily& family, Keep keep,
                                         std::span<const std::int32_t> dirty, ReduceStatistics& statistics,
                                         Monitor& monitor);

}  // namespace ballflow::geometry
