// The local feature size of the samples of a surface, estimated by the nearest poles (thesis, 4.5 and 4.7).
#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "search/box_tree.hpp"
#include "types/local_feature_size.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

/// D^ of any point: its distance to the nearest of the poles of all samples, inner or outer, with or without
/// labels. Candidates for third poles do not count.
class PoleDistance {
 public:
  /// Throws InputError when samples have no pole. Precondition: broken_invariant(poles) is empty.
  explicit PoleDistance(const PoleSet& poles, Monitor& monitor = no_monitor());
  /// Of these places alone, any number of them.
  explicit PoleDistance(std::vector<Vec3> poles, Monitor& monitor = no_monitor());

  /// Infinite without samples.
  double operator()(Vec3 p) const;

 private:
  std::vector<Vec3> poles_;
  BoxTree tree_;
};

/// D^ of every sample, and the distance to its third neighbour.
/// Throws InputError when `poles` are of another number of samples, when a sample has no pole, and when a
/// pole is where a sample is.
/// Precondition: broken_invariant(poles) is empty.
LocalFeatureSize local_feature_size(const PointSet& sample, const PoleSet& poles,
                                    Monitor& monitor = no_monitor());

/// The same of fewer poles: those of a pruned transform, which noise did not make (thesis, 4.9.3, third
/// method). D^ is not smaller then, the bounds of LocalFeatureSize do not hold, and the result says so
/// (`fewer_poles`). Throws InputError when
/// there are samples and no pole, and when a pole is where a sample is.
LocalFeatureSize local_feature_size(const PointSet& sample, const PoleDistance& to_pole,
                                    Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
