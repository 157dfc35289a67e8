// Inner and outer poles of a cloud of points, without a mesh (Amenta and Kolluri 2000).
#pragma once

#include <cstdint>
#include <vector>

#include "types/monitor.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

struct AngleLabels {
  std::vector<std::uint8_t> labels;  // PoleLabel of every entry of the set; unlabelled where nothing is known
  // Entries for which the evidence against their label is at least half as strong as that for it.
  std::vector<std::uint8_t> uncertain;  // 1 or 0
};

/// Labels spread from the unbounded poles, which are outer, in the order of their certainty. With
/// d = (Rp^2 + Rq^2 - |pq|^2) / (2 Rp Rq), the cosine of the angle p s q at any point s where the spheres of
/// p and q meet (near 1 for balls that are almost the same, -1 for balls that touch from outside):
/// - the two poles p and q of a sample have different labels with certainty -d
/// - p and q that are neighbours in the power diagram of all polar balls have the same label with certainty d
/// Evidence that is not positive is none. The pole with the most evidence for one label goes next; poles with
/// evidence for both labels go after all others, the clearest first. Ties are broken by radius and
/// coordinates.
///
/// Right for well sampled smooth surfaces. Wrong near sharp edges, where noise is as large as the spacing of
/// samples, between sheets that are closer than the spacing, and it leaks through holes.
/// Throws InputError when no pole is unbounded. Precondition: broken_invariant(poles) is empty.
AngleLabels angle_labels(const PoleSet& poles, Monitor& monitor);

}  // namespace ballflow::geometry
