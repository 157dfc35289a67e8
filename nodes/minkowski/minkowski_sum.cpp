#include "minkowski/minkowski_sum.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "minkowski/hierarchical_sums.hpp"
#include "minkowski/power_triangulation.hpp"
#include "minkowski/slab_sums.hpp"
#include "minkowski/sum_lists.hpp"
#include "minkowski/sums.hpp"
#include "power/usable_balls.hpp"

namespace ballflow::geometry {
namespace {

// Measured with bench_minkowski: a list of sums and its order take 72 bytes a sum, the triangulation 700
// bytes a vertex. Of millions of pairs one in 20 is a vertex, of what is left by the filter one in four.
constexpr double bytes_per_vertex = 700, bytes_per_pair = 72 + bytes_per_vertex / 20,
                 bytes_per_survivor = 72 + bytes_per_vertex / 4;

double surface_to_union(const Comparison* comparison) {
  if (comparison == nullptr) return 0;
  return std::min(comparison->surface_to_union.at_most, comparison->uncovered + comparison->spacing);
}

ComparedWith compared_with(const Comparison* comparison) {
  return comparison == nullptr ? ComparedWith::nothing : static_cast<ComparedWith>(comparison->compared_with);
}

}  // namespace

double error_bound(const Comparison* a, const Comparison* b) {
  if (!why_unbounded(compared_with(a), compared_with(b)).empty()) return -1;
  return surface_to_union(a) + surface_to_union(b);
}

MinkowskiSum minkowski_sum(const Balls& a, const Balls& b, const MinkowskiSumOptions& options,
                           Monitor& monitor, const SolidComparisons& of) {
  require_usable(a, "a");
  require_usable(b, "b");
  for (const Comparison* comparison : {of.a, of.b}) {
    if (comparison == nullptr) continue;
    if (const std::string broken = broken_invariant(*comparison); !broken.empty()) {
      throw InputError("a comparison is damaged: " + broken, "compute it again");
    }
  }
  const Sums sums(a, b);
  MinkowskiSum result;
  result.report.a_compared_with = static_cast<std::uint8_t>(compared_with(of.a));
  result.report.b_compared_with = static_cast<std::uint8_t>(compared_with(of.b));
  result.report.error_bound = error_bound(of.a, of.b);
  result.report.pairs = sums.pairs();
  const bool minimal = options.keep == MinkowskiKeep::minimal;
  if (sums.pairs() == 0) {
    if (minimal) result.report.minimal = 0;
    return result;
  }

  PartMonitor most(monitor, 0, minimal ? 0.3 : 1);
  Contributing found;
  PartMonitor end(most, 0.9, 1);
  if (options.algorithm == MinkowskiAlgorithm::filtered) {
    std::vector<Ball> left = filtered_sums(sums, bytes_per_survivor, most);
    result.report.survivors = static_cast<std::int64_t>(left.size());
    const std::size_t slabs = slabs_for(left.size());
    PartMonitor part(most, 0.15, 1);
    found = contributing_in_slabs(std::move(left), slabs, part);
  } else {
    PowerTriangulation triangulation;
    if (options.algorithm == MinkowskiAlgorithm::memory) {
      constexpr std::size_t work = 4096;  // about 10 us
      const MemoryLimit memory(monitor);
      sums.for_each(
          most, 0, 0.9,
          [&, looked = std::int64_t{0}](const Ball& sum) mutable {
            triangulation.insert_if_contributing(sum);
            if (++looked % 4096 == 0)
              require_memory(static_cast<std::int64_t>(triangulation.vertices()), bytes_per_vertex, memory);
          },
          work);
      result.report.survivors = static_cast<std::int64_t>(triangulation.vertices());
    } else if (options.algorithm == MinkowskiAlgorithm::hierarchical) {
      result.report.survivors =
          HierarchicalSums(a, b, triangulation, {bytes_per_survivor, bytes_per_vertex}).run(most);
    } else {
      std::vector<Ball> all = all_sums(sums, bytes_per_pair, most);
      result.report.survivors = static_cast<std::int64_t>(all.size());
      PartMonitor part(most, 0.15, 0.9);
      triangulation.insert(std::move(all), part);
    }
    found = triangulation.contributing(end);
  }
  PartMonitor last(monitor, minimal ? 0.3 : 1, 1);
  result.balls = keep(std::move(found), options.keep, UnionOf::balls, result.report, last);
  return result;
}

}  // namespace ballflow::geometry
