#include "homology/binary_system.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Takes out what occurs twice; `terms` become ascending.
void cancel_pairs(std::vector<std::int32_t>& terms) {
  std::sort(terms.begin(), terms.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    if (i + 1 < terms.size() && terms[i] == terms[i + 1]) {
      i += 2;
    } else {
      terms[kept++] = terms[i++];
    }
  }
  terms.resize(kept);
}

}  // namespace

std::vector<std::int32_t> binary_sum(std::span<const std::int32_t> a, std::span<const std::int32_t> b) {
  std::vector<std::int32_t> sum;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(sum));
  return sum;
}

std::size_t binary_rank(std::vector<std::vector<std::int32_t>> rows) {
  std::map<std::int32_t, std::vector<std::int32_t>> by_pivot;
  for (std::vector<std::int32_t>& row : rows) {
    while (!row.empty()) {
      const auto pivot = by_pivot.find(row.back());
      if (pivot == by_pivot.end()) break;
      row = binary_sum(row, pivot->second);
    }
    if (!row.empty()) by_pivot.emplace(row.back(), std::move(row));
  }
  return by_pivot.size();
}

BinarySystem::BinarySystem(std::size_t variables, std::span<const std::int64_t> offsets,
                           std::span<const std::int32_t> terms, std::span<const std::int32_t> zero,
                           Monitor& monitor)
    : root_(at(index_of(variables, "variables of a system (edges of a complex)")) + 1),
      zero_(static_cast<std::int32_t>(variables)) {
  std::iota(root_.begin(), root_.end(), 0);
  for (const std::int32_t x : zero) root_[at(x)] = zero_;

  // Equations of at most two classes are used up at once. Passes over the others, forth and back, since what
  // one equation says often decides its neighbours.
  Lookout look(monitor);
  std::vector<std::int64_t> open(offsets.empty() ? 0 : offsets.size() - 1);
  std::iota(open.begin(), open.end(), 0);
  std::vector<std::int32_t> classes;
  const auto classes_of = [&](std::int64_t equation) {
    classes.clear();
    for (std::int64_t k = offsets[at(equation)]; k < offsets[at(equation) + 1]; ++k) {
      const std::int32_t r = root(terms[at(k)]);
      if (r != zero_) classes.push_back(r);
    }
    cancel_pairs(classes);
  };
  for (bool again = true; again;) {
    again = false;
    std::size_t kept = 0;
    for (const std::int64_t equation : open) {
      classes_of(equation);
      look(classes.size() + 4);
      if (classes.size() > 2) {
        open[kept++] = equation;
        continue;
      }
      if (classes.empty()) continue;
      again = true;
      // The larger root stays, so that `zero_` is its own.
      root_[at(classes[0])] = classes.size() == 1 ? zero_ : classes[1];
    }
    open.resize(kept);
    std::reverse(open.begin(), open.end());
  }

  // What is left: by_pivot[x] are the classes that sum to x, pivots eliminated from all of them at the end.
  std::map<std::int32_t, std::vector<std::int32_t>> by_pivot;
  for (const std::int64_t equation : open) {
    classes_of(equation);
    std::vector<std::int32_t> row = classes;
    while (!row.empty()) {
      look(row.size());
      const auto pivot = by_pivot.find(row.back());
      if (pivot == by_pivot.end()) break;
      row = binary_sum(row, pivot->second);
    }
    if (!row.empty()) by_pivot.emplace(row.back(), std::move(row));
  }

  row_.assign(variables + 1, -1);
  for (std::int32_t x = 0; x < zero_; ++x) {
    if (root(x) != x || by_pivot.contains(x)) continue;
    row_[at(x)] = static_cast<std::int32_t>(rows_.size());
    rows_.push_back({static_cast<std::int32_t>(free_.size())});
    free_.push_back(x);
  }
  // Ascending pivots: everything else in a row is smaller than its pivot, and known.
  for (const auto& [pivot, row] : by_pivot) {
    std::vector<std::int32_t> value;
    for (std::size_t k = 0; k + 1 < row.size(); ++k) {
      look(value.size());
      value = binary_sum(value, rows_[at(row_[at(row[k])])]);
    }
    row_[at(pivot)] = static_cast<std::int32_t>(rows_.size());
    rows_.push_back(std::move(value));
  }
  for (std::int32_t x = 0; x < zero_; ++x) root(x);  // one step from every variable to its root
  for (std::int32_t x = 0; x < zero_; ++x) root_[at(x)] = root(x);
}

std::span<const std::int32_t> BinarySystem::value(std::int32_t variable) const {
  const std::int32_t row = row_[at(root_[at(variable)])];
  return row < 0 ? std::span<const std::int32_t>() : rows_[at(row)];
}

std::int32_t BinarySystem::root(std::int32_t x) {
  while (root_[at(x)] != x) {
    root_[at(x)] = root_[at(root_[at(x)])];
    x = root_[at(x)];
  }
  return x;
}

}  // namespace ballflow::geometry
