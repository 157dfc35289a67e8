#include "minkowski/sum_lists.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "base/memory.hpp"
#include "minkowski/containment_filter.hpp"

namespace ballflow::geometry {

namespace {

/// How many sums fit into the memory, and have indices.
std::int64_t most_sums(double bytes_per_sum, const MemoryLimit& memory) {
  return static_cast<std::int64_t>(
      std::min(memory.bytes / bytes_per_sum, static_cast<double>(most_indices - 1)));
}

}  // namespace

void require_memory(std::int64_t sums, double bytes_per_sum, const MemoryLimit& memory, bool more) {
  if (sums <= most_sums(bytes_per_sum, memory) && !more) return;
  throw InputError((more ? "more than " : "") + std::to_string(sums) +
                       " sums of two balls would have to be triangulated, which takes about " +
                       size_text(bytes_per_sum * static_cast<double>(sums)) + "; " + memory.text(),
                   "prune the inputs more (a larger epsilon), use algorithm filtered (in space also memory), "
                   "or grant more "
                   "memory");
}

std::vector<Ball> all_sums(const Sums& sums, double bytes_per_sum, Monitor& monitor) {
  require_memory(sums.pairs(), bytes_per_sum, MemoryLimit(monitor));
  std::vector<Ball> all;
  all.reserve(static_cast<std::size_t>(sums.pairs()));
  sums.for_each(monitor, 0, 0.05, [&all](const Ball& sum) { all.push_back(sum); });
  return all;
}

// Pairs are looked at in parallel, and in effect one after the other: filters of successive parts of the
// stream that are merged in their order hold what one filter would, and so does what passes.
std::vector<Ball> filtered_sums(const Sums& sums, double bytes_per_sum, Monitor& monitor) {
  const std::size_t pairs = sums.bucket_pairs();
  const auto make_filter = [&sums] {
    return ContainmentFilter(sums.box(), filter_voxels(static_cast<double>(sums.pairs())));
  };
  // Each part has a filter of its own: no more of these than are worth their 10 MB.
  const std::size_t parts = std::clamp<std::size_t>(
      std::min(pairs >> 16, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())), 1, 8);
  std::vector<ContainmentFilter> filters;
  for (std::size_t part = 0; part < parts; ++part) filters.push_back(make_filter());
  constexpr std::size_t step =
      4096;  // pairs of buckets between two looks at the monitor, less than a millisecond
  const std::size_t part_size = (pairs + parts - 1) / parts;
  std::atomic<std::size_t> seen{0};
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    const std::size_t end = std::min(pairs, (part + 1) * part_size);
    for (std::size_t first = part * part_size; first < end; first += step) {
      const std::size_t last = std::min(end, first + step);
      sums.for_each_bucket(first, last, [&filter = filters[part]](const Bucket& one, const Bucket& other) {
        for (const Ball& ball : one.balls) filter.offer(ball + other.largest);
        for (const Ball& ball : other.balls) filter.offer(one.largest + ball);
      });
      monitor.step(0.05 * static_cast<double>(seen += last - first) / static_cast<double>(pairs));
    }
  });
  ContainmentFilter filter = std::move(filters[0]);
  for (std::size_t part = 1; part < parts; ++part) filter.merge(filters[part]);
  filters.clear();
  filter.spread(monitor);

  const MemoryLimit memory(monitor);
  const std::int64_t most = most_sums(bytes_per_sum, memory);
  std::vector<std::vector<Ball>> left(blocks_of(pairs, step));
  std::atomic<std::int64_t> count{0};
  for_each_block(pairs, step, monitor, 0.05, 0.15,
                 [&](std::size_t block, std::size_t first, std::size_t last) {
                   std::vector<Ball> passed;
                   sums.for_each_bucket(first, last, [&](const Bucket& one, const Bucket& other) {
                     if (filter.contains(one.bound + other.bound)) return;
                     for (const Ball& a : one.balls) {
                       for (const Ball& b : other.balls) {
                         const Ball sum = a + b;
                         if (!filter.contains(sum)) passed.push_back(sum);
                       }
                     }
                   });
                   const auto size = static_cast<std::int64_t>(passed.size());
                   if ((count += size) > most) require_memory(most, bytes_per_sum, memory, true);
                   left[block] = std::move(passed);
                 });
  std::vector<Ball> all;
  all.reserve(static_cast<std::size_t>(count));
  for (std::vector<Ball>& passed : left) {
    all.insert(all.end(), passed.begin(), passed.end());
    std::vector<Ball>().swap(passed);
  }
  return all;
}

namespace {

Balls canonical(std::vector<Ball> sums) {
  std::sort(sums.begin(), sums.end(), [](const Ball& a, const Ball& b) { return a.center < b.center; });
  std::vector<Vec3> centers;
  std::vector<double> radii;
  centers.reserve(sums.size());
  radii.reserve(sums.size());
  for (const Ball& sum : sums) {
    centers.push_back(sum.center);
    radii.push_back(sum.radius);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

}  // namespace

Balls keep(Contributing found, MinkowskiKeep what, UnionOf of, MinkowskiReport& report, Monitor& monitor) {
  report.contributing = static_cast<std::int64_t>(found.balls.size());
  report.touching_boundary = found.touching_boundary;
  Balls balls = canonical(std::move(found.balls));
  if (what == MinkowskiKeep::minimal) {
    balls = select(balls, minimal_of_contributing(balls, {of}, monitor).kept);
    report.minimal = static_cast<std::int64_t>(balls.size());
  }
  report.count = static_cast<std::int64_t>(balls.size());
  const Box box = bounding_box(balls);
  report.lower = box.lower;
  report.upper = box.upper;
  return balls;
}

}  // namespace ballflow::geometry
