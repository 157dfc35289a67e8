// The zero alpha-complex as GUDHI computes it: another construction (exact filtration values of all
// simplices, cut at 0) and homology by matrix reduction.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::test {

struct GudhiComplex {
  std::vector<std::vector<std::int32_t>> simplices;  // ascending ball indices, sorted
  std::array<std::int64_t, 3> betti{0, 0, 0};
};

/// Needs at least four points that are not in one plane. Of equal points the heaviest, then the first, names
/// the vertex.
GudhiComplex gudhi_complex(std::span<const geometry::Vec3> centers, std::span<const double> weights);

}  // namespace ballflow::test
