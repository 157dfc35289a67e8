#include "cover/matrix_blocks.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "base/for_each_block.hpp"
#include "base/lists.hpp"
#include "base/vec3.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/dominated_sets.hpp"
#include "cover/residual.hpp"
#include "cover/sample_counts.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;
using Flags = std::vector<std::uint8_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Of the parts of a computation, which know no progress of the whole and have nothing to tell its user.
class PartOfMany final : public Monitor {
 public:
  explicit PartOfMany(Monitor& whole) : whole_(whole) {}
  bool cancelled() override { return whole_.cancelled(); }
  std::uint64_t memory_bytes() override { return whole_.memory_bytes(); }

 private:
  Monitor& whole_;
};

/// The samples of an instance, or some of them, and the balls that each defines.
class Instance {
 public:
  Instance(const Balls& balls, const PointSet& points) : balls_(balls), points_(points) {
    defined_ = lists_of<std::int32_t>(points.points.size(), [&](const auto& put) {
      for (std::size_t i = 0; i < balls.size(); ++i) {
        for (const std::int32_t s : balls.samples_of(i)) put(at(s), static_cast<std::int32_t>(i));
      }
    });
  }

  /// The part of the covering matrix of these balls and samples, both ascending. Row and column k of it are
  /// the k-th ones of these; samples in none of the balls are columns without rows.
  Csr part(const Ids& balls, const Ids& samples, Monitor& monitor) const {
    const SampleSubset subset = sample_subset(select(balls_, balls), points_, samples);
    CoverMatrixOptions options;
    options.full_entries = options.max_entries = std::numeric_limits<std::int64_t>::max();
    CoverState state = cover_matrix(subset.balls, subset.points, options, monitor).cover;
    if (state.uncovered.empty()) return rows_of(state);
    Ids columns(state.columns.begin(), state.columns.end());
    for (std::int32_t& c : columns) c = state.column_ids[at(c)];
    return {std::move(state.row_offsets), std::move(columns)};
  }

  /// Samples among `ids` (ascending) that the balls may contain, and perhaps others.
  Ids samples_near(const Ids& balls, std::span<const std::int32_t> ids) const {
    Box box;
    Ids defining;
    for (const std::int32_t i : balls) {
      const Vec3 c = balls_.centers[at(i)];
      const double r = std::sqrt(squared_reach(balls_.radii[at(i)])) * (1 + 1e-9);
      box.add({c.x - r, c.y - r, c.z - r});
      box.add({c.x + r, c.y + r, c.z + r});
      const auto own = balls_.samples_of(at(i));
      defining.insert(defining.end(), own.begin(), own.end());
    }
    std::sort(defining.begin(), defining.end());
    Ids near;
    auto next = defining.begin();
    for (const std::int32_t s : ids) {
      const Vec3 p = points_.points[at(s)];
      while (next != defining.end() && *next < s) ++next;
      if ((p.x >= box.lower.x && p.x <= box.upper.x && p.y >= box.lower.y && p.y <= box.upper.y &&
           p.z >= box.lower.z && p.z <= box.upper.z) ||
          (next != defining.end() && *next == s)) {
        near.push_back(s);
      }
    }
    return near;
  }

  /// All balls that may contain one of the samples, and perhaps others.
  Ids balls_near(const Ids& samples) const {
    Box box;
    Ids near;
    for (const std::int32_t s : samples) {
      box.add(points_.points[at(s)]);
      near.insert(near.end(), defined_[at(s)].begin(), defined_[at(s)].end());
    }
    const auto beside = [](double x, double lower, double upper) {
      return std::max({lower - x, x - upper, 0.0});
    };
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      // Rounding is monotone: no sample in the box is nearer than this.
      const Vec3 c = balls_.centers[i];
      const double d =
          squared_norm(beside(c.x, box.lower.x, box.upper.x), beside(c.y, box.lower.y, box.upper.y),
                       beside(c.z, box.lower.z, box.upper.z));
      if (d <= squared_reach(balls_.radii[i])) near.push_back(static_cast<std::int32_t>(i));
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    return near;
  }

 private:
  const Balls& balls_;
  const PointSet& points_;
  Lists<std::int32_t> defined_;  // balls of each sample
};

Ids numbers(std::size_t count) {
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

Flags dominated(const Csr& sets, const Csr& members, Keep keep, Monitor& monitor) {
  ReduceStatistics ignored;
  return dominated_sets({sets, members, SubsetTest::inverted_index, {}}, keep, numbers(sets.size()), ignored,
                        monitor);
}

/// Things `first` to `last` of an order, ascending.
Ids sorted_part(const Ids& order, std::size_t first, std::size_t last) {
  Ids ids(order.begin() + static_cast<std::ptrdiff_t>(first),
          order.begin() + static_cast<std::ptrdiff_t>(last));
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

CoverState matrix_of_maximal_rows(const Balls& balls, const PointSet& points,
                                  std::span<const std::int32_t> columns, std::size_t block,
                                  Monitor& monitor) {
  struct Rows {
    Ids balls, entries;  // the rows one after another
    std::vector<std::size_t> lengths;
  };
  const Instance instance(balls, points);
  std::vector<std::int32_t> number(points.points.size(), -1);
  for (std::size_t c = 0; c < columns.size(); ++c) number[at(columns[c])] = static_cast<std::int32_t>(c);
  const Ids order = near_balls(balls);
  std::vector<Rows> found(blocks_of(order.size(), block));
  for_each_block(
      order.size(), block, monitor, 0, 0.95, [&](std::size_t b, std::size_t first, std::size_t last) {
        PartOfMany part(monitor);
        const Ids ids = sorted_part(order, first, last);
        const Ids near = instance.samples_near(ids, columns);
        const Csr rows = instance.part(ids, near, part);
        const Flags gone = dominated(rows, transpose(rows, near.size(), part), Keep::maximal, part);
        Rows& kept = found[b];
        std::size_t entries = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) entries += gone[i] == 0 ? rows.degree(i) : 0;
        kept.entries.reserve(entries);
        for (std::size_t i = 0; i < rows.size(); ++i) {
          if (gone[i] != 0) continue;
          kept.balls.push_back(ids[i]);
          kept.lengths.push_back(rows.degree(i));
          for (const std::int32_t c : rows[i]) kept.entries.push_back(number[at(near[at(c)])]);
        }
      });

  CoverState state;
  state.balls = static_cast<std::int64_t>(balls.size());
  state.samples = static_cast<std::int64_t>(points.points.size());
  Ids row_ids;
  for (const Rows& rows : found) row_ids.insert(row_ids.end(), rows.balls.begin(), rows.balls.end());
  std::sort(row_ids.begin(), row_ids.end());
  std::vector<std::int64_t> offsets(row_ids.size() + 1);
  const auto row_of = [&](std::int32_t ball) {
    return static_cast<std::size_t>(std::lower_bound(row_ids.begin(), row_ids.end(), ball) - row_ids.begin());
  };
  for (const Rows& rows : found) {
    for (std::size_t k = 0; k < rows.balls.size(); ++k) {
      offsets[row_of(rows.balls[k]) + 1] = static_cast<std::int64_t>(rows.lengths[k]);
    }
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  auto entries = zeros<std::int32_t>(static_cast<std::size_t>(offsets.back()), monitor);
  Lookout look(monitor);
  for (Rows& rows : found) {
    auto row = rows.entries.begin();
    for (std::size_t k = 0; k < rows.balls.size(); ++k) {
      const auto end = row + static_cast<std::ptrdiff_t>(rows.lengths[k]);
      look(rows.lengths[k]);
      std::copy(row, end, entries.begin() + offsets[row_of(rows.balls[k])]);
      row = end;
    }
    rows = {};  // both copies at once would be as large as what this function is to spare
  }
  state.row_offsets = std::move(offsets);
  state.columns = std::move(entries);
  state.row_ids = std::move(row_ids);
  state.column_ids = Ids(columns.begin(), columns.end());
  monitor.step(1);
  return state;
}

std::vector<std::int32_t> minimal_samples(const Balls& balls, const PointSet& points, std::size_t block,
                                          Monitor& monitor) {
  const Instance instance(balls, points);
  const SampleTree tree(points.points);
  const Ids& order = tree.order();
  std::vector<Ids> found(blocks_of(order.size(), block));
  for_each_block(order.size(), block, monitor, 0, 1, [&](std::size_t b, std::size_t first, std::size_t last) {
    PartOfMany part(monitor);
    const Ids samples = sorted_part(order, first, last);
    const Ids near = instance.balls_near(samples);
    const Csr rows = instance.part(near, samples, part);
    const Csr columns = transpose(rows, samples.size(), part);
    const Flags gone = dominated(columns, rows, Keep::minimal, part);
    for (std::size_t c = 0; c < samples.size(); ++c) {
      if (gone[c] == 0 && columns.degree(c) > 0) found[b].push_back(samples[c]);
    }
  });
  Ids kept;
  for (const Ids& ids : found) kept.insert(kept.end(), ids.begin(), ids.end());
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace ballflow::geometry
