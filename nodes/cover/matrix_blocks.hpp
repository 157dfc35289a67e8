// Covering matrices of which parts go while they are made, block by block of neighbours: what is left needs a
// fraction of the memory of the whole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/cover_state.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

/// The matrix of all balls and the samples `columns` (ascending; column c is sample columns[c]), without rows
/// that are empty, inside a row of one of their neighbours, or equal to one of a lower index. reduce() takes
/// all of them out, and finds the same in what is left as in the whole matrix: a chain of rows, each inside
/// the next, ends in one that stays. Row ids are balls, column ids are samples. Every sample is in a ball.
///
/// Neighbours are `block` balls: more leave fewer rows and take more memory while they are looked at, by each
/// thread. The result does not depend on the number of threads.
CoverState matrix_of_maximal_rows(const Balls& balls, const PointSet& points,
                                  std::span<const std::int32_t> columns, std::size_t block = 4096,
                                  Monitor& monitor = no_monitor());

/// Samples, ascending, that are enough for a cover: whatever covers them covers all samples that are in a
/// ball. The others are those whose balls are all balls of a sample of one of their neighbours, or the same
/// as those of one of a lower index. `block` as above, of samples.
std::vector<std::int32_t> minimal_samples(const Balls& balls, const PointSet& points,
                                          std::size_t block = 4096, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
