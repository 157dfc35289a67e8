// The local feature size of the samples of a surface, estimated by the nearest poles (thesis, 4.5 and 4.7).
#pragma once

#include "base/monitor.hpp"
#include "types/local_feature_size.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

/// D^ of every sample: its distance to the nearest of the poles of all samples, inner or outer, with or
/// without labels. Candidates for third poles do not count.
/// Throws InputError when `poles` are of another number of samples, when a sample has no pole, and when a
/// pole is where a sample is.
/// Precondition: broken_invariant(poles) is empty.
LocalFeatureSize local_feature_size(const PointSet& sample, const PoleSet& poles,
                                    Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
