// A given error instead of a given growth.
#pragma once

#include "base/monitor.hpp"
#include "types/bisection.hpp"
#include "types/enclosure.hpp"

namespace ballflow::geometry {

struct BisectErrorOptions {
  // Model units; 0: there is no search, epsilon is the growth.
  double max_error = 0;
  // The part of it that is allowed here; others have the rest.
  double share = 1;
  // The growth without a search.
  double epsilon = 0.5;
  // Good enough are errors of (1 - tolerance) of what is allowed, or more.
  double tolerance = 0.1;

  double allowed() const { return max_error * share; }
};

/// The distance of a solid and its balls that an enclosure knows: neither is any point of the surface farther
/// from the balls, nor any point of the balls farther from the solid. InputError without balls, and for
/// surfaces that are not closed.
double proven_error(const Enclosure& enclosure);

/// The state of a search before anything was tried; growth is in % of `edge`, the longest bounding-box edge
/// of the sample. Without max_error it is done.
Bisection begin_error_search(const BisectErrorOptions& options, double edge);

/// The state after balls were made with search.value, of which `enclosure` knows the error: the search is for
/// a large growth, so few balls, with an error that is allowed.
/// - First the error is taken for the growth and a constant; once there are values on both sides, it is
///   taken for linear between them.
/// - Done when an error is allowed and not much less than that, after 16 trials, when both sides are within
///   2 %, or when 10 % of growth are still allowed. Its value is then the largest growth known to do. The
///   error need not be monotone, so that a larger one may exist.
/// Throws InputError for options out of range, what proven_error refuses, and where the error without any
/// growth is not allowed: it names the error that is reached.
Bisection bisect_error(const Bisection& search, const Enclosure& enclosure, const BisectErrorOptions& options,
                       double edge, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
