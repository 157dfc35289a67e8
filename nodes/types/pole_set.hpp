// Poles of the Voronoi diagram of a sample (Amenta and Bern 1999; thesis, 3.3 and 3.4).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

enum class PoleLabel : std::uint8_t { unlabelled = 0, inner = 1, outer = 2 };

struct PoleSet {
  // One entry per Voronoi VERTEX that is a pole of at least one sample, or a candidate: a bounded vertex,
  // either of the cell of a sample whose first two poles may lie on one side of the surface, or any (see
  // VoronoiPoles, vertices). LabelPoles chooses third poles among the candidates, and drops or keeps the
  // others. Vertices that coincide exactly (five and more
  // cospherical samples) are one entry. Sorted by their smallest defining samples.
  Array<Vec3> centers;  // p x 3, model units; finite
  Array<double> radii;  // p, distance to the defining samples
  // p, PoleLabel; all unlabelled before LabelPoles, after it only those of which its method angle knows
  // nothing
  Array<std::uint8_t> labels;

  // The samples on the sphere of each entry (all sites of the Voronoi vertex, at least 4, ascending; the
  // far-away points that bound the diagram are not samples and are left out, so there may be fewer).
  Array<std::int64_t> defining_offsets;  // p + 1
  Array<std::int32_t> defining_samples;

  Array<std::uint8_t> unbounded;  // p, 1 where a far-away bounding point is a site: such a pole is outer

  // The poles of each sample: [0] the farthest vertex of its cell, [1] the farthest behind it, and, where the
  // labels say that those are on one side of the surface, [2] the farthest on the other side; -1 where there
  // is none.
  Array<std::array<std::int32_t, 3>> sample_poles;  // n x 3

  // p, 1 where the evidence against the label is at least half as strong as that for it; empty where labels
  // are decided otherwise (only the method angle of LabelPoles knows).
  Array<std::uint8_t> uncertain;

  std::size_t size() const { return radii.size(); }
};

/// For each entry 1 when it is a pole of a sample, 0 when it is a candidate. Indices must be in range.
std::vector<std::uint8_t> is_pole(const PoleSet& poles);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const PoleSet& poles);

}  // namespace ballflow::geometry
