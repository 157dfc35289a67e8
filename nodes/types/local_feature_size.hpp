// How near the medial axis is to the samples of a surface, estimated from poles.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// With D^ for the distance of a sample to the nearest pole, and the sample an r-sample of the surface for
/// r <= 0.08:
/// - the distance of the sample to the discrete medial axis, that of the union of the polar balls, is in
///   [0.817 D^, D^] (thesis, Corollary 4.12)
/// - its distance to the medial axis of the surface, the local feature size lfs, is at most 1.2802 D^
///   (thesis, Lemma 4.8)
/// Neither holds where D^ is the distance to the nearest of fewer places (`fewer_poles`): it may be any
/// number of times as large then.
struct LocalFeatureSize {
  static constexpr double discrete_at_least = 0.817;  // times D^
  static constexpr double at_most = 1.2802;           // times D^

  Array<Vec3> points;            // n x 3, the sample, model units
  Array<double> pole_distances;  // n, D^, model units, > 0
  // n, model units, > 0: the distance to the third nearest other sample, a length of the spacing; infinite
  // for fewer than four samples.
  Array<double> third_neighbors;
  // n, model units, or empty where no axis was given: the distance to the discrete medial axis, the discrete
  // local feature size of Definition 4.1 when the axes are those of the inner and of the outer polar balls. 0
  // where a sample lies on the axis.
  Array<double> axis_distances = {};

  // The least r for which every point of a given mesh has a sample within r times its distance to the
  // discrete medial axis, or to the nearest pole where no axis was given: bounds of it (see SamplingRatio),
  // and a point of the mesh where at_least is attained. -1 without a mesh; at_most may be infinite.
  double r_at_least = -1, r_at_most = -1;
  Vec3 r_at = {};

  std::uint8_t fewer_poles = 0;  // 1: D^ leaves out poles, as those of balls that pruning did not keep
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const LocalFeatureSize& size);

}  // namespace ballflow::geometry
