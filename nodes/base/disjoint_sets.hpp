// Disjoint sets of 0 .. n - 1.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/index.hpp"

namespace ballflow::geometry {

/// A set is named by its least element, whatever order sets are joined in. (boost::disjoint_sets needs a
/// second array, and the name of a set depends on the order.)
class DisjointSets {
 public:
  /// n sets of one element each.
  explicit DisjointSets(std::size_t n) : parent_(at(index_of(n, "elements of disjoint sets"))) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The least element of the set of i.
  std::int32_t root(std::int32_t i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  /// False when a and b are in one set already.
  bool join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent_[at(std::max(a, b))] = std::min(a, b);
    return true;
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::vector<std::int32_t> parent_;
};

}  // namespace ballflow::geometry
