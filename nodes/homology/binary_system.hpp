// Homogeneous systems of linear equations over Z/2 whose equations are short: the cocycles of a complex (one
// equation per triangle) and its cycles (one per edge).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// The space of solutions. A basis is numbered from 0; the value of variable x in basis solution k is 1 when
/// k is in value(x). The basis belongs to free variables: free_variable(k) is 1 in solution k and 0 in the
/// others.
///
/// Equations of one variable make it 0, equations of two unite them, again and again; what is left after that
/// is small for complexes of three-dimensional shapes and is eliminated.
class BinarySystem {
 public:
  /// Equation i says that the variables [offsets[i], offsets[i + 1]) of `terms` sum to 0; a variable that
  /// occurs twice cancels. `zero` are variables that are 0 from the beginning.
  BinarySystem(std::size_t variables, std::span<const std::int64_t> offsets,
               std::span<const std::int32_t> terms, std::span<const std::int32_t> zero, Monitor& monitor);

  std::size_t dimension() const { return free_.size(); }
  std::int32_t free_variable(std::size_t k) const { return free_[k]; }
  /// Numbers of basis solutions, ascending.
  std::span<const std::int32_t> value(std::int32_t variable) const;

 private:
  std::int32_t root(std::int32_t variable);

  std::vector<std::int32_t> root_;  // per variable; the class of variable `zero_` is 0
  std::int32_t zero_ = 0;
  std::vector<std::int32_t> free_;  // one variable per basis solution
  std::vector<std::int32_t> row_;   // per variable that is a root: its row below, else -1
  std::vector<std::vector<std::int32_t>> rows_;
};

/// The rank of a matrix over Z/2 given by rows of ascending column numbers.
std::size_t binary_rank(std::vector<std::vector<std::int32_t>> rows);

/// The sum over Z/2 of two ascending lists of numbers.
std::vector<std::int32_t> binary_sum(std::span<const std::int32_t> a, std::span<const std::int32_t> b);

}  // namespace ballflow::geometry
