// Covering matrices that would be too large, without the balls that no good cover needs.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/lazy_bound.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

struct CandidateOptions {
  double least_load = 0.7;  // of a candidate, by the prices of its samples
  // More candidates than have about so many entries with all samples are thinned out. Of these a twelfth to a
  // third are left when rows and columns that are not needed are gone.
  std::int64_t entries = 40'000'000;
  std::int64_t entries_per_sample = 100;  // of them, where that is more
};

/// The balls that a cover may be made of, ascending: those whose samples cost at least `least_load` by the
/// prices of `bound`, of neighbours only the most loaded ones where there are too many, and some for samples
/// that these do not cover. A ball of small load wastes what it costs: its reduced cost is 1 - load, and a
/// cover of b balls has at most b - bound to waste.
std::vector<std::int32_t> candidate_balls(const Balls& balls, const PointSet& points, const LazyBound& bound,
                                          const CandidateOptions& options = {},
                                          Monitor& monitor = no_monitor());

/// As cover_matrix, with candidates alone as rows and all samples as columns. The bound and its certificate
/// are about all balls, by lazy_bound; CoverState::left_out says how many are no row.
CoverMatrix large_cover_matrix(const Balls& balls, const PointSet& points,
                               const CoverMatrixOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
