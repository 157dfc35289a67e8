// The covering matrix of balls and samples (Kornberger 2010, 3.6.1): c_ij = 1 iff sample j lies in ball i.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/cover_state.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

/// What becomes of a sample that lies in no ball.
enum class UncoveredPolicy : std::uint8_t {
  ball,    // it gets a ball of radius 0 at its place
  error,   // InputError
  report,  // it is left out of the matrix and listed in CoverState::uncovered, where VerifyCover finds it
};

struct CoverMatrixOptions {
  UncoveredPolicy uncovered = UncoveredPolicy::report;
  std::int64_t full_entries = 60'000'000;    // a matrix of more has candidates alone: large_cover_matrix
  std::int64_t max_entries = 2'000'000'000;  // 4 bytes each; a larger matrix is refused before it is made
};

struct CoverMatrix {
  CoverState cover;  // nothing chosen; every ball is a row, also one that covers nothing
  Balls balls;       // the input, then the balls of radius 0, ascending by sample
};

/// Which ball covers which sample, decided by membership.hpp; the samples that define a ball are in it.
///
/// - The lower bound of the result is ceil(columns / longest row).
/// - A matrix of more than `full_entries` entries is not made: its rows are the balls that a good cover may
/// be
///   made of, and its bound has a certificate (large_cover_matrix.hpp).
/// - Rows ascend; the result does not depend on the number of threads.
/// - Time O((m + n) log n + entries), memory 4 bytes per entry, 70 bytes per sample, 40 per ball, and at most
///   32 MB.
///
/// Refused with InputError: coordinates or radii beyond 1e140, defining samples that are not in `points`, a
/// matrix of more than `max_entries` entries or larger than the memory (base/memory.hpp), uncovered samples
/// under UncoveredPolicy::error.
CoverMatrix cover_matrix(const Balls& balls, const PointSet& points, const CoverMatrixOptions& options = {},
                         Monitor& monitor = no_monitor());

/// `balls` and one ball of radius 0 at each of `samples`, which it is defined by.
Balls with_points(const Balls& balls, const PointSet& points, const std::vector<std::int32_t>& samples);

/// Samples in no ball (ascending): refused with UncoveredPolicy::error, else a warning, where there are any.
void report_uncovered(const std::vector<std::int32_t>& uncovered, const PointSet& points,
                      UncoveredPolicy policy, Monitor& monitor);

/// Refuses a matrix of more than `max_entries` entries or larger than the memory that the monitor grants.
void require_memory(std::int64_t entries, const CoverMatrixOptions& options, Monitor& monitor);

/// Refuses coordinates and radii whose squares overflow, and defining samples out of range.
void require_coverable(const Balls& balls, const PointSet& points);

}  // namespace ballflow::geometry
