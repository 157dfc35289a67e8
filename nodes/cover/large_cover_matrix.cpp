#include "cover/large_cover_matrix.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "cover/greedy_rows.hpp"
#include "cover/matrix_blocks.hpp"
#include "cover/residual.hpp"
#include "cover/sample_counts.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

CoverMatrixOptions without_limit(CoverMatrixOptions options) {
  options.full_entries = options.max_entries = std::numeric_limits<std::int64_t>::max();
  return options;
}

constexpr std::size_t block = 4096;  // balls or samples; of matrix_blocks.hpp

/// What a ball covers: both numbers from one sum, as no ball costs more than 1.
struct Content {
  static constexpr std::int64_t sample = std::int64_t{1} << 24;  // above any price
  static_assert(price_unit < sample);

  explicit Content(std::int64_t sum) : samples(sum / sample), load(sum % sample) {}
  std::int64_t samples, load;
};

/// Of every `group` neighbours the most loaded one, the first of equals.
Ids thinned(const Ids& near, const std::vector<std::int64_t>& contents, std::size_t group) {
  Ids kept;
  for (std::size_t first = 0; first < near.size(); first += group) {
    const auto begin = near.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = near.begin() + static_cast<std::ptrdiff_t>(std::min(near.size(), first + group));
    kept.push_back(*std::min_element(begin, end, [&](std::int32_t a, std::int32_t b) {
      const Content x(contents[at(a)]), y(contents[at(b)]);
      return std::tuple(-x.load, -x.samples, a) < std::tuple(-y.load, -y.samples, b);
    }));
  }
  return kept;
}

/// Balls for the samples in `missed`: greedily, of all balls.
Ids balls_for(const Ids& missed, const Balls& balls, const PointSet& points, Monitor& monitor) {
  if (missed.empty()) return {};
  const SampleSubset subset = sample_subset(balls, points, missed);
  const CoverState cover = cover_matrix(subset.balls, subset.points, without_limit({}), monitor).cover;
  return greedy_rows(rows_of(cover), cover.cols(), monitor);
}

}  // namespace

std::vector<std::int32_t> candidate_balls(const Balls& balls, const PointSet& points, const LazyBound& bound,
                                          const CandidateOptions& options, Monitor& monitor) {
  const SampleTree tree(points.points);
  std::vector<std::int32_t> values(points.points.size(), static_cast<std::int32_t>(Content::sample));
  for (std::size_t k = 0; k < bound.certificate.samples.size(); ++k) {
    values[at(bound.certificate.samples[k])] += bound.certificate.prices[k];
  }
  PartMonitor first(monitor, 0, 0.4), second(monitor, 0.4, 0.7), third(monitor, 0.7, 1);
  const std::vector<std::int64_t> contents = sums_in_balls(tree, balls, points, values, first);
  const auto least = static_cast<std::int64_t>(options.least_load * static_cast<double>(price_unit));
  Ids near;
  for (const std::int32_t i : near_balls(balls)) {
    if (Content(contents[at(i)]).load >= least) near.push_back(i);
  }
  Ids kept = near;
  const auto entries = [&] {
    std::int64_t sum = 0;
    for (const std::int32_t i : kept) sum += Content(contents[at(i)]).samples;
    return sum;
  };
  const std::int64_t most =
      std::max(options.entries, options.entries_per_sample * static_cast<std::int64_t>(points.points.size()));
  for (std::size_t group = 2; entries() > most && group <= near.size(); ++group) {
    kept = thinned(near, contents, group);
  }

  std::vector<std::int32_t> weights(balls.size());
  for (const std::int32_t i : kept) weights[at(i)] = 1;
  const std::vector<std::int64_t> times = sums_on_samples(tree, balls, points, weights, second);
  Ids missed;
  for (std::size_t s = 0; s < times.size(); ++s) {
    const auto id = static_cast<std::int32_t>(s);
    const bool coverable = !std::binary_search(bound.uncovered.begin(), bound.uncovered.end(), id);
    if (times[s] == 0 && coverable) missed.push_back(id);
  }
  const Ids more = balls_for(missed, balls, points, third);
  kept.insert(kept.end(), more.begin(), more.end());
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

CoverMatrix large_cover_matrix(const Balls& balls, const PointSet& points, const CoverMatrixOptions& options,
                               Monitor& monitor) {
  PartMonitor bounding(monitor, 0, 0.7), choosing(monitor, 0.7, 0.8), thinning(monitor, 0.8, 0.95),
      making(monitor, 0.95, 1);
  const LazyBound bound = lazy_bound(balls, points, {}, bounding);
  report_uncovered(bound.uncovered, points, options.uncovered, monitor);
  const Ids candidates = candidate_balls(balls, points, bound, {}, choosing);
  // Balls of radius 0 for uncovered samples come after all others, here and in the result.
  const bool added = options.uncovered == UncoveredPolicy::ball;
  const Ids none;
  const Balls rows = with_points(select(balls, candidates), points, added ? bound.uncovered : none);
  const Ids samples = minimal_samples(rows, points, block, thinning);
  CoverMatrix result{matrix_of_maximal_rows(rows, points, samples, block, making), {}};
  CoverState& cover = result.cover;
  require_memory(static_cast<std::int64_t>(cover.nnz()), options, monitor);
  Ids row_ids;
  for (const std::int32_t i : cover.row_ids) {
    row_ids.push_back(at(i) < candidates.size()
                          ? candidates[at(i)]
                          : static_cast<std::int32_t>(balls.size() + at(i) - candidates.size()));
  }
  if (!added) cover.uncovered = bound.uncovered;
  result.balls = with_points(balls, points, added ? bound.uncovered : none);
  cover.row_ids = std::move(row_ids);
  cover.balls = static_cast<std::int64_t>(result.balls.size());
  prove(cover, bound.certificate);
  cover.left_out = cover.balls - static_cast<std::int64_t>(cover.rows());
  monitor.note(std::to_string(candidates.size()) + " of " + std::to_string(balls.size()) +
               " balls are candidates, " + std::to_string(samples.size()) + " of " +
               std::to_string(points.points.size()) + " samples are enough");
  return result;
}

}  // namespace ballflow::geometry
