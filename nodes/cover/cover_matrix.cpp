#include "cover/cover_matrix.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "base/memory.hpp"
#include "cover/large_cover_matrix.hpp"
#include "cover/residual.hpp"
#include "search/membership.hpp"
#include "search/sample_tree.hpp"

namespace ballflow::geometry {
namespace {

// Balls handled between two looks at the monitor: some milliseconds of work.
constexpr std::size_t block = 256;

// Beyond this a sum of squares may overflow, and "in no ball" and "in every ball" look alike.
constexpr double coordinate_limit = 1e140;

std::string coordinates(Vec3 p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p.x, p.y, p.z);
  return text;
}

bool beyond_limit(Vec3 p) {
  return !(std::abs(p.x) <= coordinate_limit && std::abs(p.y) <= coordinate_limit &&
           std::abs(p.z) <= coordinate_limit);
}

/// Collects a set of small integers and lists it in order: marks them in a two-level bitmap, which is linear
/// in the set, where a comparison sort takes most of the time of the whole matrix.
class SetSorter {
 public:
  explicit SetSorter(std::size_t universe) : words_(universe / 64 + 1), groups_(words_.size() / 64 + 1) {}

  void add(std::int32_t number) {
    const auto value = static_cast<std::size_t>(number);
    words_[value >> 6] |= std::uint64_t{1} << (value & 63);
    groups_[value >> 12] |= std::uint64_t{1} << ((value >> 6) & 63);
  }
  /// Writes what was added to `out`, ascending; returns one past the last, and begins a new set.
  std::int32_t* list(std::int32_t* out) {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      for (std::uint64_t used = std::exchange(groups_[group], 0); used != 0; used &= used - 1) {
        const std::size_t word = group * 64 + static_cast<std::size_t>(std::countr_zero(used));
        for (std::uint64_t bits = std::exchange(words_[word], 0); bits != 0; bits &= bits - 1) {
          *out++ = static_cast<std::int32_t>(word * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
        }
      }
    }
    return out;
  }
  /// Whether sorting `size` numbers by comparison is cheaper than reading the bitmap.
  bool too_large_for(std::size_t size) const { return size < 16 || size * 8 < groups_.size(); }

 private:
  std::vector<std::uint64_t> words_, groups_;
};

/// What the queries of a block of balls found: hits[ends[k - 1] .. ends[k]) for its ball k.
struct BlockHits {
  std::vector<SampleTree::Hit> hits;
  std::vector<std::size_t> ends;
};

// Answers of the counting pass are kept for the filling pass up to so many hits a ball on average, 1 KB.
// Scans need 20 to 60; but where all samples are nearly as far from a ball as its radius, as on a sphere, it
// has a hit in every leaf, and is asked again.
constexpr std::int64_t hits_per_ball = 128;
constexpr std::int64_t most_hits = std::int64_t{1} << 22;  // 32 MB in all

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<std::int32_t>(i);
  return ids;
}

std::string how_many(const std::vector<std::int32_t>& uncovered, std::size_t samples) {
  return std::to_string(uncovered.size()) + " of " + std::to_string(samples) + " samples lie" +
         (uncovered.size() == 1 ? "s" : "") + " in no ball";
}

}  // namespace

Balls with_points(const Balls& balls, const PointSet& points, const std::vector<std::int32_t>& samples) {
  if (samples.empty()) return balls;
  std::vector<Vec3> centers(balls.centers.begin(), balls.centers.end());
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  std::vector<std::int64_t> offsets(balls.defining_offsets.begin(), balls.defining_offsets.end());
  std::vector<std::int32_t> defining(balls.defining_samples.begin(), balls.defining_samples.end());
  const bool defined = !offsets.empty();
  for (const std::int32_t s : samples) {
    centers.push_back(points.points[static_cast<std::size_t>(s)]);
    radii.push_back(0);
    if (!defined) continue;
    defining.push_back(s);
    offsets.push_back(static_cast<std::int64_t>(defining.size()));
  }
  return {std::move(centers), std::move(radii), std::move(offsets), std::move(defining)};
}

void report_uncovered(const std::vector<std::int32_t>& uncovered, const PointSet& points,
                      UncoveredPolicy policy, Monitor& monitor) {
  if (uncovered.empty()) return;
  const std::string cause = how_many(uncovered, points.points.size());
  if (policy == UncoveredPolicy::error) {
    const std::int32_t first = uncovered.front();
    throw InputError(cause + ", the first is sample " + std::to_string(first) + " at " +
                         coordinates(points.points[static_cast<std::size_t>(first)]),
                     "enlarge the balls, or set uncovered to ball or report");
  }
  monitor.warn(cause + (policy == UncoveredPolicy::ball
                            ? "; each got a ball of radius 0, a component of its own"
                            : ": they are left out and listed; sample more densely to cover them"));
}

void require_memory(std::int64_t entries, const CoverMatrixOptions& options, Monitor& monitor) {
  const double bytes = 4.0 * static_cast<double>(entries);
  const MemoryLimit memory(monitor);
  if (entries <= options.max_entries && memory.allows(bytes)) return;
  throw InputError(
      "the matrix would have " + std::to_string(entries) + " entries (" + size_text(bytes) + "); " +
          (entries > options.max_entries ? "max_entries is " + std::to_string(options.max_entries)
                                         : memory.text()),
      entries > options.max_entries ? "enlarge the balls less, thin the sample, or raise max_entries"
                                    : "enlarge the balls less, thin the sample, grant more memory, or lower "
                                      "full_entries");
}

void require_coverable(const Balls& balls, const PointSet& points) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  const std::size_t m = balls.size(), n = points.points.size();
  if (m > most || n > most || m + n > most) {
    throw InputError(
        std::to_string(m) + " balls and " + std::to_string(n) + " samples are more than 2^31 - 1",
        "thin the sample");
  }
  const std::string scale = "scale the model to a size near 1";
  for (std::size_t i = 0; i < m; ++i) {
    if (beyond_limit(balls.centers[i]) || !(balls.radii[i] <= coordinate_limit)) {
      throw InputError("ball " + std::to_string(i) + " at " + coordinates(balls.centers[i]) +
                           " has a coordinate or radius beyond 1e140",
                       scale);
    }
    for (const std::int32_t s : balls.samples_of(i)) {
      if (s < 0 || static_cast<std::size_t>(s) >= n) {
        throw InputError("ball " + std::to_string(i) + " is defined by sample " + std::to_string(s) + " of " +
                             std::to_string(n),
                         "connect the points from which these balls were made");
      }
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (beyond_limit(points.points[j])) {
      throw InputError("sample " + std::to_string(j) + " at " + coordinates(points.points[j]) +
                           " has a coordinate beyond 1e140",
                       scale);
    }
  }
}

CoverMatrix cover_matrix(const Balls& balls, const PointSet& points, const CoverMatrixOptions& options,
                         Monitor& monitor) {
  require_coverable(balls, points);
  const std::size_t m = balls.size(), n = points.points.size();
  std::optional<SampleTree> sample_tree(points.points), ball_tree;
  const SampleTree& tree = *sample_tree;
  monitor.step(0.05);
  ball_tree.emplace(balls.centers);
  monitor.step(0.1);

  // Defining samples that the predicate misses by rounding are few, and are the same in both passes.
  const auto for_each_missed = [&](std::size_t i, double reach, auto&& found) {
    for (const std::int32_t s : balls.samples_of(i)) {
      if (!in_reach(balls.centers[i], reach, points.points[static_cast<std::size_t>(s)])) found(s);
    }
  };

  const std::vector<std::int32_t>& order = ball_tree->order();
  const auto query = [&](std::size_t b, BlockHits& found, auto&& answered) {
    found.hits.clear();
    found.ends.clear();
    for (std::size_t k = b * block; k < std::min(m, (b + 1) * block); ++k) {
      const auto i = static_cast<std::size_t>(order[k]);
      answered(i, tree.query(balls.centers[i], squared_reach(balls.radii[i]), found.hits));
      found.ends.push_back(found.hits.size());
    }
  };

  std::vector<std::int64_t> offsets(m + 1);
  std::vector<BlockHits> kept(blocks_of(m, block));
  std::atomic<std::int64_t> room{std::min(most_hits, hits_per_ball * static_cast<std::int64_t>(m))};
  std::atomic<std::int64_t> counted{0};  // the matrix is too large once these are: nothing else is asked then
  tbb::enumerable_thread_specific<BlockHits> asked;
  for_each_block(m, block, monitor, 0.1, 0.4, [&](std::size_t b, std::size_t, std::size_t) {
    if (counted > options.full_entries) return;
    BlockHits& found = asked.local();
    std::int64_t sum = 0;
    query(b, found, [&](std::size_t i, std::int64_t count) {
      for_each_missed(i, squared_reach(balls.radii[i]), [&](std::int32_t) { ++count; });
      offsets[i + 1] = count;
      sum += count;
    });
    counted += sum;
    const auto size = static_cast<std::int64_t>(found.hits.size());
    if (room.fetch_sub(size) >= size) kept[b] = found;
  });
  if (counted > options.full_entries) {
    kept = {};
    offsets = {};
    sample_tree.reset();
    ball_tree.reset();
    PartMonitor rest(monitor, 0.4, 1);
    return large_cover_matrix(balls, points, options, rest);
  }
  const std::int64_t longest = *std::max_element(offsets.begin(), offsets.end());
  for (std::size_t i = 0; i < m; ++i) offsets[i + 1] += offsets[i];
  const std::int64_t entries = offsets[m];
  require_memory(entries, options, monitor);

  // Not initialised, and with room for the rows of uncovered samples; untouched pages cost nothing.
  const std::shared_ptr<std::int32_t[]> columns(new std::int32_t[static_cast<std::size_t>(entries) + n]);
  tbb::enumerable_thread_specific<SetSorter> sorters([n] { return SetSorter(n); });
  for_each_block(m, block, monitor, 0.4, 0.9, [&](std::size_t b, std::size_t, std::size_t) {
    BlockHits found = std::move(kept[b]);
    if (found.ends.empty()) query(b, found, [](std::size_t, std::int64_t) {});
    SetSorter& sorter = sorters.local();
    std::size_t at = 0;
    for (std::size_t k = 0; k < found.ends.size(); ++k) {
      const auto i = static_cast<std::size_t>(order[b * block + k]);
      std::int32_t* const row = columns.get() + offsets[i];
      const auto each = [&](auto&& add) {
        for (; at < found.ends[k]; ++at) tree.for_each(found.hits[at], add);
        for_each_missed(i, squared_reach(balls.radii[i]), add);
      };
      if (sorter.too_large_for(static_cast<std::size_t>(offsets[i + 1] - offsets[i]))) {
        std::int32_t* last = row;
        each([&](std::int32_t s) { *last++ = s; });
        std::sort(row, last);
      } else {
        each([&](std::int32_t s) { sorter.add(s); });
        sorter.list(row);
      }
    }
  });

  Lookout look(monitor);
  std::vector<std::uint8_t> covered(n);
  for (std::int64_t k = 0; k < entries; ++k) {
    look(1);
    covered[static_cast<std::size_t>(columns[static_cast<std::size_t>(k)])] = 1;
  }
  std::vector<std::int32_t> uncovered;
  for (std::size_t j = 0; j < n; ++j) {
    if (covered[j] == 0) uncovered.push_back(static_cast<std::int32_t>(j));
  }
  monitor.step(0.95);

  CoverMatrix result;
  CoverState& cover = result.cover;
  std::size_t total = static_cast<std::size_t>(entries);
  std::vector<std::int32_t> column_ids = numbers(n);
  report_uncovered(uncovered, points, options.uncovered, monitor);
  if (uncovered.empty()) {
    result.balls = balls;
  } else if (options.uncovered == UncoveredPolicy::ball) {
    result.balls = with_points(balls, points, uncovered);
    for (const std::int32_t s : uncovered) {
      columns[total++] = s;
      offsets.push_back(static_cast<std::int64_t>(total));
    }
    uncovered.clear();
  } else {
    result.balls = balls;
    std::vector<std::int32_t> number(n, -1);
    column_ids.clear();
    for (std::size_t j = 0; j < n; ++j) {
      if (covered[j] == 0) continue;
      number[j] = static_cast<std::int32_t>(column_ids.size());
      column_ids.push_back(static_cast<std::int32_t>(j));
    }
    for (std::size_t k = 0; k < total; ++k) {
      look(1);
      columns[k] = number[static_cast<std::size_t>(columns[k])];
    }
  }

  cover.balls = static_cast<std::int64_t>(result.balls.size());
  cover.samples = static_cast<std::int64_t>(n);
  cover.row_ids = numbers(result.balls.size());
  cover.row_offsets = std::move(offsets);
  cover.columns = Array<std::int32_t>(columns.get(), total, columns);
  const auto cols = static_cast<std::int64_t>(column_ids.size());
  const std::int64_t best = std::max<std::int64_t>(longest, 1);
  raise_lower_bound(cover, (cols + best - 1) / best, BoundHow::lemma_3_7);
  cover.column_ids = std::move(column_ids);
  cover.uncovered = std::move(uncovered);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
