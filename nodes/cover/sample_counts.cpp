#include "cover/sample_counts.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <bit>
#include <cstddef>

#include "base/for_each_block.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 256;  // balls

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

void add(std::int64_t& to, std::int64_t value) {
  std::atomic_ref(to).fetch_add(value, std::memory_order_relaxed);
}

/// Calls body(ball, hits) for every ball that `wanted` accepts, in parallel.
template <class Wanted, class Body>
void for_each_ball(const SampleTree& tree, const Balls& balls, Monitor& monitor, Wanted wanted, Body body) {
  const std::vector<std::int32_t> order = near_balls(balls);
  tbb::enumerable_thread_specific<std::vector<SampleTree::Hit>> asked;
  for_each_block(order.size(), block, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<SampleTree::Hit>& hits = asked.local();
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = at(order[k]);
      if (!wanted(i)) continue;
      hits.clear();
      tree.query(balls.centers[i], squared_reach(balls.radii[i]), hits);
      body(i, hits);
    }
  });
}

/// Calls found(s) for the samples that define ball i and that the predicate misses.
template <class Found>
void for_each_missed(const Balls& balls, const PointSet& points, std::size_t i, Found found) {
  for (const std::int32_t s : balls.samples_of(i)) {
    if (!in_reach(balls.centers[i], squared_reach(balls.radii[i]), points.points[at(s)])) found(s);
  }
}

}  // namespace

std::vector<std::int32_t> near_balls(const Balls& balls) { return SampleTree(balls.centers).order(); }

std::vector<std::int64_t> sums_on_samples(const SampleTree& tree, const Balls& balls, const PointSet& points,
                                          std::span<const std::int32_t> weights, Monitor& monitor) {
  const std::size_t n = points.points.size();
  // By place in the tree: `steps` has what begins there, `single` what one sample has for itself.
  std::vector<std::int64_t> steps(n + 1), single(n), sums(n);
  for_each_ball(
      tree, balls, monitor, [&](std::size_t i) { return weights[i] != 0; },
      [&](std::size_t i, const std::vector<SampleTree::Hit>& hits) {
        for (const SampleTree::Hit& hit : hits) {
          if (hit.first >= 0) {
            add(steps[at(hit.first)], weights[i]);
            add(steps[at(hit.first) + hit.samples], -weights[i]);
            continue;
          }
          for (std::uint32_t rest = hit.samples; rest != 0; rest &= rest - 1) {
            add(single[at(~hit.first) + static_cast<std::size_t>(std::countr_zero(rest))], weights[i]);
          }
        }
        for_each_missed(balls, points, i, [&](std::int32_t s) { add(sums[at(s)], weights[i]); });
      });
  std::int64_t running = 0;
  for (std::size_t place = 0; place < n; ++place) {
    running += steps[place];
    sums[at(tree.order()[place])] += running + single[place];
  }
  return sums;
}

std::vector<std::int64_t> sums_in_balls(const SampleTree& tree, const Balls& balls, const PointSet& points,
                                        std::span<const std::int32_t> values, Monitor& monitor) {
  const std::vector<std::int32_t>& order = tree.order();
  std::vector<std::int64_t> before{0};  // sums of the values at the first places
  before.reserve(order.size() + 1);
  for (const std::int32_t s : order) before.push_back(before.back() + values[at(s)]);
  std::vector<std::int64_t> sums(balls.size());
  for_each_ball(
      tree, balls, monitor, [](std::size_t) { return true; },
      [&](std::size_t i, const std::vector<SampleTree::Hit>& hits) {
        std::int64_t sum = 0;
        for (const SampleTree::Hit& hit : hits) {
          if (hit.first >= 0) {
            sum += before[at(hit.first) + hit.samples] - before[at(hit.first)];
          } else {
            tree.for_each(hit, [&](std::int32_t s) { sum += values[at(s)]; });
          }
        }
        for_each_missed(balls, points, i, [&](std::int32_t s) { sum += values[at(s)]; });
        sums[i] = sum;
      });
  return sums;
}

SampleSubset sample_subset(const Balls& balls, const PointSet& points, std::span<const std::int32_t> ids) {
  SampleSubset result;
  std::vector<Vec3> some;
  some.reserve(ids.size());
  std::vector<std::int32_t> number(points.points.size(), -1);
  for (const std::int32_t s : ids) {
    number[at(s)] = static_cast<std::int32_t>(some.size());
    some.push_back(points.points[at(s)]);
  }
  result.points.points = std::move(some);
  result.balls = balls;
  if (balls.defining_offsets.empty()) return result;
  std::vector<std::int64_t> offsets{0};
  offsets.reserve(balls.size() + 1);
  std::vector<std::int32_t> defining;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (const std::int32_t s : balls.samples_of(i)) {
      if (number[at(s)] >= 0) defining.push_back(number[at(s)]);
    }
    offsets.push_back(static_cast<std::int64_t>(defining.size()));
  }
  result.balls.defining_offsets = std::move(offsets);
  result.balls.defining_samples = std::move(defining);
  return result;
}

}  // namespace ballflow::geometry
