#include "cover/region_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cover/cover_regions.hpp"
#include "cover/greedy_rows.hpp"

namespace ballflow::geometry {
namespace {

/// Seeds of phases and regions, far from each other: the search in a region adds a fixed number for each of
/// its steps.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t phase, std::uint64_t region) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (phase << 32 | region);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

RegionSearch::RegionSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound,
                           std::uint64_t seed, Monitor& monitor, std::int64_t weight_limit)
    : bound_(bound), seed_(seed), weight_limit_(weight_limit) {
  const auto searched_as_a_whole = [&] {
    if (cover.size() <= balls_of_region) return true;
    const auto region = regions_of_cover(part, cover, balls_of_region, mixed(seed, 0, 0), monitor);
    return columns_of_regions(part, cover, region, monitor).shared > part.column_ids.size() / 4;
  };
  if (searched_as_a_whole()) {
    whole_ = std::make_unique<WeightingSearch>(std::move(part), cover, bound, seed, monitor, weight_limit);
    return;
  }
  part_ = std::move(part);
  part_.columns = {};  // regions have their own
  best_ = cover;
  std::sort(best_.begin(), best_.end());
  weights_.assign(part_.column_ids.size(), 1);
}

void RegionSearch::cut(Monitor& monitor) {
  const auto phase = static_cast<std::uint64_t>(phase_++);
  const auto region_of = regions_of_cover(part_, best_, balls_of_region, mixed(seed_, phase, 0), monitor);
  const RegionColumns columns = columns_of_regions(part_, best_, region_of, monitor);
  const auto count = static_cast<std::size_t>(*std::max_element(region_of.begin(), region_of.end())) + 1;
  regions_.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t r) {
    Part part = region_part(part_, columns, static_cast<std::int32_t>(r), monitor);
    if (part.column_ids.empty()) return;
    std::vector<std::int32_t> cover, weights;
    for (std::size_t k = 0; k < best_.size(); ++k) {
      if (region_of[k] != static_cast<std::int32_t>(r)) continue;
      const auto at = std::lower_bound(part.row_ids.begin(), part.row_ids.end(), best_[k]);
      // All that a row at the border covers may belong to other regions.
      if (at != part.row_ids.end() && *at == best_[k]) {
        cover.push_back(static_cast<std::int32_t>(at - part.row_ids.begin()));
      }
    }
    for (const std::int32_t c : part.column_ids) weights.push_back(weights_[static_cast<std::size_t>(c)]);
    regions_[r] = std::make_unique<WeightingSearch>(std::move(part), cover, 1, mixed(seed_, phase, r + 1),
                                                    monitor, weight_limit_, weights);
  });
  std::erase(regions_, nullptr);
}

void RegionSearch::take_weights() {
  for (const auto& region : regions_) {
    const std::vector<std::int32_t> weights = region->weights();
    for (std::size_t c = 0; c < weights.size(); ++c) {
      weights_[static_cast<std::size_t>(region->column_ids()[c])] = weights[c];
    }
  }
  regions_.clear();
}

void RegionSearch::run_regions(double steps, Monitor& monitor) {
  double rows = 0;
  for (const auto& region : regions_) rows += static_cast<double>(region->row_ids().size());
  tbb::parallel_for(std::size_t{0}, regions_.size(), [&](std::size_t r) {
    const double share = static_cast<double>(regions_[r]->row_ids().size()) / rows;
    regions_[r]->run(static_cast<std::int64_t>(steps * share) + 1, monitor);
  });
  std::vector<std::int32_t> cover;
  for (const auto& region : regions_) {
    for (const std::int32_t i : region->best()) {
      cover.push_back(region->row_ids()[static_cast<std::size_t>(i)]);
    }
  }
  std::sort(cover.begin(), cover.end());
  cover.erase(std::unique(cover.begin(), cover.end()), cover.end());
  cover = without_redundant(part_.rows, part_.column_ids.size(), cover, monitor);
  // Equal ones too: the next phase goes on where this one was.
  if (cover.size() <= best_.size()) best_ = std::move(cover);
}

void RegionSearch::run(double share, Monitor& monitor) {
  const double before = std::exchange(made_, made_ + share);
  if (!whole_ && before >= share_of_regions) {
    take_weights();
    part_.columns = transpose(part_.rows, part_.column_ids.size(), monitor);
    whole_ = std::make_unique<WeightingSearch>(std::move(part_), best_, bound_, mixed(seed_, phases, 0),
                                               monitor, weight_limit_, weights_);
  }
  if (whole_) {
    whole_->run(static_cast<std::int64_t>(planned_ * share) + 1, monitor);
    return;
  }
  if (before * phases >= phase_ * share_of_regions) {
    take_weights();
    cut(monitor);
  }
  run_regions(planned_ * share, monitor);
}

}  // namespace ballflow::geometry
