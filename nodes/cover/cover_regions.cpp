#include "cover/cover_regions.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/lists.hpp"
#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

std::size_t index_of(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The rows of a cover and which of them share columns; rows are numbered as in the cover.
class CoverGraph {
 public:
  CoverGraph(const Part& part, std::span<const std::int32_t> cover, Monitor& monitor)
      : part_(part),
        cover_(cover),
        by_column_(lists_of<std::int32_t>(part.column_ids.size(),
                                          [&](const auto& put) {
                                            for (std::size_t k = 0; k < cover.size(); ++k) {
                                              for (const std::int32_t c : part.rows[index_of(cover[k])]) {
                                                put(index_of(c), static_cast<std::int32_t>(k));
                                              }
                                            }
                                          })),
        met_in_(cover.size(), -1),
        look_(monitor) {}

  /// The rows of a group, breadth-first from `first`; where that ends before all are met it goes on with the
  /// first of `group` that was not.
  std::vector<std::int32_t> order(std::span<const std::int32_t> group, std::int32_t first,
                                  std::span<const std::int32_t> group_of) {
    ++walk_;
    const std::int32_t name = group_of[index_of(first)];
    std::vector<std::int32_t> result;
    result.reserve(group.size());
    std::size_t taken = 0, next = 0;
    meet(first, result);
    for (;;) {
      for (; taken < result.size(); ++taken) {
        for (const std::int32_t c : part_.rows[index_of(cover_[index_of(result[taken])])]) {
          const auto others = by_column_[index_of(c)];
          look_(others.size());
          for (const std::int32_t k : others) {
            if (group_of[index_of(k)] == name) meet(k, result);
          }
        }
      }
      while (next < group.size() && met_in_[index_of(group[next])] == walk_) ++next;
      if (next == group.size()) return result;
      meet(group[next], result);
    }
  }

 private:
  void meet(std::int32_t k, std::vector<std::int32_t>& list) {
    if (std::exchange(met_in_[index_of(k)], walk_) != walk_) list.push_back(k);
  }

  const Part& part_;
  std::span<const std::int32_t> cover_;
  Lists<std::int32_t> by_column_;
  std::vector<std::int32_t> met_in_;  // the last walk that met a row
  std::int32_t walk_ = 0;
  Lookout look_;
};

}  // namespace

std::vector<std::int32_t> regions_of_cover(const Part& part, std::span<const std::int32_t> cover,
                                           std::size_t largest, std::uint64_t seed, Monitor& monitor) {
  CoverGraph graph(part, cover, monitor);
  Random random(seed);
  std::vector<std::int32_t> region(cover.size(), 0);
  std::vector<std::vector<std::int32_t>> groups(1);
  groups[0].resize(cover.size());
  std::iota(groups[0].begin(), groups[0].end(), 0);
  for (std::size_t g = 0; g < groups.size();) {
    const std::size_t size = groups[g].size();
    if (size <= largest) {
      ++g;
      continue;
    }
    const auto any = static_cast<std::size_t>(random.unit() * static_cast<double>(size));
    const std::int32_t end = graph.order(groups[g], groups[g][any], region).back();
    std::vector<std::int32_t> order = graph.order(groups[g], end, region);
    const double share = 0.35 + 0.3 * random.unit();
    const auto half = order.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(size));
    groups[g].assign(order.begin(), half);
    groups.emplace_back(half, order.end());
    for (const std::int32_t k : groups.back()) {
      region[index_of(k)] = static_cast<std::int32_t>(groups.size() - 1);
    }
  }
  return region;
}

RegionColumns columns_of_regions(const Part& part, std::span<const std::int32_t> cover,
                                 std::span<const std::int32_t> region_of_cover, Monitor& monitor) {
  RegionColumns regions{std::vector<std::int32_t>(part.column_ids.size(), -1), 0, {}};
  std::vector<std::uint8_t> shared(part.column_ids.size());
  Lookout look(monitor);
  for (std::size_t k = 0; k < cover.size(); ++k) {
    const std::int32_t own = region_of_cover[k];
    look(part.rows.degree(index_of(cover[k])));
    for (const std::int32_t c : part.rows[index_of(cover[k])]) {
      std::int32_t& region = regions.of_column[index_of(c)];
      if (region >= 0 && region != own) shared[index_of(c)] = 1;
      region = region < 0 ? own : std::min(region, own);
    }
  }
  regions.shared = static_cast<std::size_t>(std::count(shared.begin(), shared.end(), 1));
  const std::int32_t last =
      region_of_cover.empty() ? -1 : *std::max_element(region_of_cover.begin(), region_of_cover.end());
  regions.rows = lists_of<std::int32_t>(static_cast<std::size_t>(last + 1), [&](const auto& put) {
    std::vector<std::int32_t> met_by(static_cast<std::size_t>(last + 1), -1);  // the last row of each region
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      const auto row = static_cast<std::int32_t>(i);
      look(part.rows.degree(i));
      for (const std::int32_t c : part.rows[i]) {
        const std::int32_t region = regions.of_column[index_of(c)];
        if (region >= 0 && std::exchange(met_by[index_of(region)], row) != row) put(index_of(region), row);
      }
    }
  });
  return regions;
}

Part region_part(const Part& part, const RegionColumns& regions, std::int32_t region, Monitor& monitor) {
  Part result;
  std::vector<std::int32_t> number(part.column_ids.size(), -1);
  Lookout look(monitor);
  for (std::size_t c = 0; c < part.column_ids.size(); ++c) {
    if (regions.of_column[c] != region) continue;
    number[c] = static_cast<std::int32_t>(result.column_ids.size());
    result.column_ids.push_back(static_cast<std::int32_t>(c));
  }
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> entries;
  std::size_t most = 0;
  for (const std::int32_t i : regions.rows[index_of(region)]) most += part.rows.degree(index_of(i));
  entries.reserve(most);  // growing would take as much again; what is not used is never touched
  for (const std::int32_t i : regions.rows[index_of(region)]) {
    look(part.rows.degree(index_of(i)));
    result.row_ids.push_back(i);
    for (const std::int32_t c : part.rows[index_of(i)]) {
      if (number[index_of(c)] >= 0) entries.push_back(number[index_of(c)]);
    }
    offsets.push_back(static_cast<std::int64_t>(entries.size()));
  }
  result.rows = {std::move(offsets), std::move(entries)};
  result.columns = transpose(result.rows, result.column_ids.size(), monitor);
  return result;
}

}  // namespace ballflow::geometry
