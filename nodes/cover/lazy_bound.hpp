// A lower bound on covers of many samples by many balls, without the matrix of all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/certificate.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

struct LazyBoundOptions {
  std::int64_t columns = 8192;  // samples that are listed in the first round, about
  int rounds = 9;
  double growth = 0.4;            // a round lists at most so many more, as a share of those that are listed
  double least_coverage = 0.8;    // a sample that balls of the relaxation cover less may be listed
  std::int64_t iterations = 300;  // of the climb, in each round
  std::int64_t last_iterations = 1000;
};

struct LazyBound {
  PricedGroups certificate;             // of the samples of the instance; see CoverState
  std::vector<std::int32_t> uncovered;  // samples in no ball, ascending
};

/// Column generation for the Lagrangian relaxation: all balls are rows, but few samples are columns. Every
/// round makes the matrix of the listed samples, reduces it, climbs from the prices of the round before, and
/// lists samples that the approximate fractional cover of the relaxation covers least, at most one of some
/// neighbours. Samples that are not listed have no price, so prices that are feasible on the rows
/// of all balls are a certificate for the whole instance, and the last round's are made so.
///
/// The bound is at most that of all samples, and ends .5 % below it where balls cover some hundred samples.
/// Time and memory grow with the rows of the listed samples: about a tenth of the whole matrix for 10^5
/// samples, a twentieth for 10^6. The result does not depend on the number of threads. Accepts and refuses
/// what cover_matrix does.
LazyBound lazy_bound(const Balls& balls, const PointSet& points, const LazyBoundOptions& options = {},
                     Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
