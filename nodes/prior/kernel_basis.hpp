// A smooth field of displacements in few numbers: the Gaussian kernel of many points, at low rank.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// The kernel matrix G, G_ij = exp(-|y_i - y_j|^2 / (2 width^2)), is L L' but for a remainder: L is n x rank,
/// by Cholesky's method with pivots, which takes the point whose diagonal entry of the remainder is largest
/// (of equal ones the first) until none is above `tolerance` or the rank is reached. With a field G W its
/// smoothness W' G W is |a|^2 when the field is L a: no eigenvectors are needed. [Fine and Scheinberg 2001]
class KernelBasis {
 public:
  /// width > 0, points finite; memory n x rank doubles.
  KernelBasis(std::span<const Vec3> points, double width, double tolerance, std::size_t most_rank,
              Monitor& monitor = no_monitor());

  std::size_t rank() const { return rank_; }
  /// Row i of L.
  std::span<const double> row(std::size_t i) const { return {values_.data() + i * rank_, rank_}; }
  /// The points that were taken, in their order.
  const std::vector<std::size_t>& pivots() const { return pivots_; }

 private:
  std::size_t rank_ = 0;
  std::vector<double> values_;
  std::vector<std::size_t> pivots_;
};

}  // namespace ballflow::geometry
