// How far inner polar balls may grow without reaching the outer medial axis (thesis, Lemma 3.4).
#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/local_feature_size.hpp"

namespace ballflow::geometry {

enum class PoleBoundConstant {
  safe,    // 0.817 - 2.5604 r / (1 - r): what the proof of Lemma 3.4 supports
  thesis,  // 0.817 - 1.2802 r / (1 - r): as printed; the proof loses one of two distances of a sample and x
};

struct PoleBoundOptions {
  // The sample is an r-sample: no point x of the surface is farther than r lfs(x) from a sample. The lemma is
  // proved for 0 < r <= 0.08; smaller values let balls grow more.
  double r = 0.08;
  PoleBoundConstant constant = PoleBoundConstant::safe;
};

/// For each ball the radius that it must stay below so that it does not meet the outer medial axis:
/// the minimum over all samples s of |center - s| + c D^(s), with D^ the distance to the nearest pole and c
/// the constant of the options, lowered by 2^-40 of itself because the bound is strict. Where that is at
/// least enough[i], infinity: nobody needs to know.
///
/// That the thesis looks at samples within (1 - r) / (1 - 2.2802 r) radii only makes no difference: farther
/// ones cannot lower the minimum. Balls that do not meet the outer medial axis may still change the topology
/// of their union.
/// Throws InputError for r out of range.
std::vector<double> pole_bounds(const Balls& balls, const LocalFeatureSize& sizes,
                                std::span<const double> enough, const PoleBoundOptions& options,
                                Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
