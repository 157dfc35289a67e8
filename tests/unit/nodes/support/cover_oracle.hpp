// Covering instances made by hand or at random, and oracles that try everything.
#pragma once

#include <algorithm>
#include <bit>
#include <bitset>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "types/balls.hpp"
#include "types/cover_state.hpp"
#include "types/point_set.hpp"

namespace ballflow::test {

using Sets = std::vector<std::vector<std::int32_t>>;  // rows as ascending sets of columns

/// An instance whose balls and samples are the rows and columns; columns in no row become `uncovered`.
inline geometry::CoverState state_of(const Sets& rows, std::size_t columns) {
  std::vector<std::int32_t> number(columns, -1), column_ids, row_ids, uncovered, entries;
  for (const auto& row : rows) {
    for (const std::int32_t c : row) number[static_cast<std::size_t>(c)] = 0;
  }
  for (std::size_t c = 0; c < columns; ++c) {
    if (number[c] < 0) {
      uncovered.push_back(static_cast<std::int32_t>(c));
      continue;
    }
    number[c] = static_cast<std::int32_t>(column_ids.size());
    column_ids.push_back(static_cast<std::int32_t>(c));
  }
  std::vector<std::int64_t> offsets{0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::int32_t c : rows[i]) entries.push_back(number[static_cast<std::size_t>(c)]);
    offsets.push_back(static_cast<std::int64_t>(entries.size()));
    row_ids.push_back(static_cast<std::int32_t>(i));
  }
  geometry::CoverState state;
  state.balls = static_cast<std::int64_t>(rows.size());
  state.samples = static_cast<std::int64_t>(columns);
  state.row_offsets = std::move(offsets);
  state.columns = std::move(entries);
  state.row_ids = std::move(row_ids);
  state.column_ids = std::move(column_ids);
  state.uncovered = std::move(uncovered);
  return state;
}

/// The residual matrix in terms of original samples.
inline Sets row_sets(const geometry::CoverState& state) {
  Sets rows;
  for (std::size_t i = 0; i < state.rows(); ++i) {
    rows.emplace_back();
    for (const std::int32_t c : state.row(i))
      rows.back().push_back(state.column_ids[static_cast<std::size_t>(c)]);
  }
  return rows;
}

/// Size of a smallest cover of the residual matrix, by trying all subsets of its rows (at most 20).
inline std::int64_t optimum(const geometry::CoverState& state) {
  using Mask = std::bitset<256>;
  if (state.rows() > 20 || state.cols() > Mask().size())
    throw std::length_error("too many to try all subsets");
  std::vector<Mask> masks(state.rows());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    for (const std::int32_t c : state.row(i)) masks[i].set(static_cast<std::size_t>(c));
  }
  std::vector<Mask> covered(std::size_t{1} << masks.size());
  std::int64_t best = std::int64_t{1} << 40;
  for (std::size_t subset = 0; subset < covered.size(); ++subset) {
    if (subset != 0) {
      covered[subset] =
          covered[subset & (subset - 1)] | masks[static_cast<std::size_t>(std::countr_zero(subset))];
    }
    if (covered[subset].count() == state.cols()) best = std::min<std::int64_t>(best, std::popcount(subset));
  }
  return best;
}

/// Whether the chosen balls of `state` cover all that the rows of `original` can cover.
inline bool covers(const geometry::CoverState& original, const geometry::CoverState& state) {
  const Sets rows = row_sets(original);
  std::set<std::int32_t> covered;
  for (const std::int32_t b : state.chosen) {
    const auto row =
        std::find(original.row_ids.begin(), original.row_ids.end(), b) - original.row_ids.begin();
    covered.insert(rows[static_cast<std::size_t>(row)].begin(), rows[static_cast<std::size_t>(row)].end());
  }
  return covered.size() == original.cols();
}

/// What is wrong with the certificate of `state` on the matrix of `original`, in which nothing was reduced:
/// empty when every row contains prices of at most 1 in sum, all of one group.
inline std::string certificate_error(const geometry::CoverState& original,
                                     const geometry::CoverState& state) {
  std::map<std::int32_t, std::pair<std::int64_t, std::int32_t>> listed;
  std::map<std::int32_t, std::int64_t> sums;
  for (std::size_t i = 0; i < state.certificate_samples.size(); ++i) {
    listed[state.certificate_samples[i]] = {state.certificate_prices[i], state.certificate_groups[i]};
    sums[state.certificate_groups[i]] += state.certificate_prices[i];
  }
  const Sets rows = row_sets(original);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::int64_t load = 0;
    std::set<std::int32_t> groups;
    for (const std::int32_t sample : rows[i]) {
      const auto at = listed.find(sample);
      if (at == listed.end()) continue;
      load += at->second.first;
      groups.insert(at->second.second);
    }
    if (load > geometry::price_unit) return "row " + std::to_string(i) + " costs " + std::to_string(load);
    if (groups.size() > 1) return "row " + std::to_string(i) + " meets two groups";
  }
  std::int64_t bound = 0;
  for (const auto& [group, sum] : sums) bound += (sum + geometry::price_unit - 1) / geometry::price_unit;
  return bound == state.certified_bound() ? "" : "the groups prove " + std::to_string(bound);
}

/// Whether one of the three reduction rules applies, by comparing all pairs.
inline bool reducible(const geometry::CoverState& state) {
  const Sets rows = row_sets(state);
  Sets columns(static_cast<std::size_t>(state.samples));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::int32_t c : rows[i])
      columns[static_cast<std::size_t>(c)].push_back(static_cast<std::int32_t>(i));
  }
  std::erase_if(columns, [](const auto& column) { return column.empty(); });
  const auto one_contains_another = [](const Sets& sets) {
    for (std::size_t a = 0; a < sets.size(); ++a) {
      for (std::size_t b = 0; b < sets.size(); ++b) {
        if (a != b && std::includes(sets[a].begin(), sets[a].end(), sets[b].begin(), sets[b].end()))
          return true;
      }
    }
    return false;
  };
  return one_contains_another(rows) || one_contains_another(columns) ||
         std::any_of(columns.begin(), columns.end(), [](const auto& column) { return column.size() == 1; });
}

/// Rows of random columns; every column is in some row when `coverable`.
inline Sets random_sets(std::mt19937& random, std::size_t rows, std::size_t columns, double density,
                        bool coverable = true) {
  Sets sets(rows);
  const auto threshold = static_cast<std::uint32_t>(density * 4294967295.0);
  for (std::size_t c = 0; c < columns; ++c) {
    bool met = false;
    for (auto& set : sets) {
      if (random() > threshold) continue;
      set.push_back(static_cast<std::int32_t>(c));
      met = true;
    }
    if (!met && coverable && rows > 0) sets[random() % rows].push_back(static_cast<std::int32_t>(c));
  }
  return sets;
}

inline bool same(const geometry::CoverState& a, const geometry::CoverState& b) {
  return a.balls == b.balls && a.samples == b.samples && a.row_offsets == b.row_offsets &&
         a.columns == b.columns && a.row_ids == b.row_ids && a.column_ids == b.column_ids &&
         a.chosen == b.chosen && a.chosen_how == b.chosen_how && a.uncovered == b.uncovered &&
         a.lower_bound == b.lower_bound && a.lower_bound_how == b.lower_bound_how &&
         a.certificate_samples == b.certificate_samples && a.certificate_prices == b.certificate_prices &&
         a.certificate_groups == b.certificate_groups && a.settled_groups == b.settled_groups;
}

/// A real number in [0, 1), the same on every machine.
inline double unit(std::mt19937& random) { return random() / 4294967296.0; }

/// A point of the unit circle, rationally parametrised.
inline std::pair<double, double> on_circle(std::mt19937& random) {
  const double t = 2 * unit(random) - 1, d = 1 + t * t;
  const double x = (1 - t * t) / d, y = 2 * t / d;
  return random() % 2 == 0 ? std::pair{x, y} : std::pair{-x, -y};
}

struct Scene {
  geometry::Balls balls;
  geometry::PointSet points;
};

/// `n` samples of a torus (radii 1 and 0.4) and one ball per sample: centred near the core of the tube,
/// through that sample, which defines it, and then enlarged by `epsilon`.
inline Scene torus(std::size_t n, double epsilon, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<geometry::Vec3> points, centers;
  std::vector<double> radii;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> defining;
  for (std::size_t j = 0; j < n; ++j) {
    const auto [u, v] = on_circle(random);
    const auto [a, b] = on_circle(random);
    points.push_back({u * (1 + 0.4 * a), v * (1 + 0.4 * a), 0.4 * b});
    const double depth = 0.3 * unit(random);  // 0: on the core, 0.3: close to the sample
    centers.push_back({u * (1 + depth * a), v * (1 + depth * a), depth * b});
    radii.push_back(geometry::distance(points.back(), centers.back()) + epsilon);
    defining.push_back(static_cast<std::int32_t>(j));
    offsets.push_back(static_cast<std::int64_t>(j + 1));
  }
  return {{centers, radii, offsets, defining}, {points, {}}};
}

}  // namespace ballflow::test
