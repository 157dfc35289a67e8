// Inner and outer poles of a cloud of points, without a mesh (Amenta and Kolluri 2000).
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

struct AngleLabels {
  std::vector<std::uint8_t> labels;  // PoleLabel of every entry of the set; unlabelled where nothing is known
  // Entries for which the evidence against their label is at least half as strong as that for it.
  std::vector<std::uint8_t> uncertain;  // 1 or 0
  std::int64_t pairs =
      0;  // how many pairs of entries were looked at: the work, linear in the size of the set
};

/// Labels spread from the unbounded poles, which are outer, from ball to ball through the samples that their
/// spheres share. With d = (Rp^2 + Rq^2 - |pq|^2) / (2 Rp Rq), the cosine of the angle p s q at a shared
/// sample s: near 1 for balls on one side of the surface, near -1 for balls on both sides:
/// - d > 0 says that p and q have the same label, with certainty d
/// - d < 0 says that their labels differ, with certainty -d
/// The pole with the most evidence for one label goes next; poles with evidence for both labels go after all
/// others, the clearest first. Ties are broken by radius and coordinates.
///
/// Amenta and Kolluri take the two poles of each sample for the second, and for the first all neighbours in
/// the power diagram of the polar balls. That diagram is degenerate wherever polar balls meet in a sample,
/// and so more expensive than all the rest, and its labels are not better.
///
/// At a sample with more than 64 entries, such as an outlier inside a shape, which is a site of as many
/// Voronoi vertices as the shape has samples, labels spread along the 8 strongest pairs of every entry for
/// either kind of evidence, not along all; what is uncertain is found among all. Expected time O(n log n).
///
/// Right for well sampled smooth surfaces. Wrong near sharp edges, where noise is as large as the spacing of
/// samples, between sheets that are closer than the spacing, and it leaks through holes.
/// Throws InputError when no pole is unbounded. Precondition: broken_invariant(poles) is empty.
AngleLabels angle_labels(const PoleSet& poles, Monitor& monitor);

}  // namespace ballflow::geometry
