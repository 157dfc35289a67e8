// The search behind local_search for one component: of all of it, or of regions in parallel.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "cover/components.hpp"
#include "cover/weighting_search.hpp"

namespace ballflow::geometry {

/// Covers of at most balls_of_region rows are searched as a whole, and those whose regions would share more
/// than a quarter of the columns, as in matrices without geometry. Larger ones make half of their steps in
/// `phases` phases: each cuts the best cover into regions of at most balls_of_region rows, gives every column
/// to one region (cover_regions.hpp), and searches all regions at once. A region may not help others at its
/// border, so the next phase has other borders, and the second half is a search of the whole, which finds
/// what no region can. Weights of columns go from phase to phase.
///
/// Regions depend on the cover and the seed alone, never on the number of threads.
class RegionSearch {
 public:
  static constexpr std::size_t balls_of_region = 600;
  static constexpr int phases = 8;
  static constexpr double share_of_regions = 0.5;  // of the steps

  /// As WeightingSearch.
  RegionSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound, std::uint64_t seed,
               Monitor& monitor, std::int64_t weight_limit = WeightingSearch::most_weight);

  /// The steps that run() will make in all.
  void plan(double steps) { planned_ = steps; }
  double planned() const { return planned_; }
  bool begins_with_regions() const { return !whole_; }

  /// Makes the fraction `share` of the planned steps, or goes on until the best cover has `bound` rows (which
  /// searches of regions do not look at). Not to be used after Cancelled.
  void run(double share, Monitor& monitor);

  bool proven() const { return static_cast<std::int64_t>(best().size()) <= bound_; }
  /// The smallest cover met: rows of the part, ascending.
  const std::vector<std::int32_t>& best() const { return whole_ ? whole_->best() : best_; }
  /// Those of the part.
  const std::vector<std::int32_t>& row_ids() const { return whole_ ? whole_->row_ids() : part_.row_ids; }

 private:
  void cut(Monitor& monitor);
  void run_regions(double steps, Monitor& monitor);
  /// Ends a phase: the weights that its regions gave to columns.
  void take_weights();

  Part part_;  // without columns; empty when the component is searched as a whole
  std::int64_t bound_;
  std::uint64_t seed_;
  std::int64_t weight_limit_;
  std::unique_ptr<WeightingSearch> whole_;
  double planned_ = 0;  // steps
  double made_ = 0;     // of them, a share
  int phase_ = 0;
  std::vector<std::unique_ptr<WeightingSearch>> regions_;
  std::vector<std::int32_t> weights_;  // of all columns
  std::vector<std::int32_t> best_;
};

}  // namespace ballflow::geometry
