#include "cover/patch_matrix.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "base/lists.hpp"
#include "cover/residual.hpp"
#include "search/sample_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 256;  // balls between two looks at the monitor

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

/// Per ball the triangles that it contains, ascending.
std::vector<std::vector<std::int32_t>> rows_of(const Balls& balls, const TriangleMesh& mesh,
                                               Monitor& monitor) {
  // A triangle is found by its first corner.
  const auto triangles_at = lists_of<std::int32_t>(mesh.vertices.size(), [&](auto put) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      put(at(mesh.triangles[t][0]), index_of(t, "triangles to cover"));
    }
  });
  const SampleTree tree(mesh.vertices);
  std::vector<std::vector<std::int32_t>> rows(balls.size());
  for_each_block(balls.size(), block, monitor, 0, 0.8, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<SampleTree::Hit> hits;
    for (std::size_t i = first; i < last; ++i) {
      hits.clear();
      const double reach = squared_reach(balls.radii[i]);
      tree.query(balls.centers[i], reach, hits);
      for (const SampleTree::Hit& hit : hits) {
        tree.for_each(hit, [&](std::int32_t v) {
          for (const std::int32_t t : triangles_at[at(v)]) {
            if (contains_patch(balls.centers[i], reach, mesh, mesh.triangles[at(t)])) rows[i].push_back(t);
          }
        });
      }
      std::sort(rows[i].begin(), rows[i].end());
    }
  });
  return rows;
}

}  // namespace

CoverMatrix patch_matrix(const Balls& balls, const TriangleMesh& patches, const CoverMatrixOptions& options,
                         Monitor& monitor) {
  if (options.uncovered == UncoveredPolicy::ball) {
    throw InputError("uncovered is ball, and no ball of radius 0 contains a triangle",
                     "set uncovered to report or error");
  }
  if (const std::string broken = broken_invariant(patches); !broken.empty()) {
    throw InputError("the patches are damaged: " + broken, "connect the patches of CoverPoints");
  }
  require_coverable(balls, {patches.vertices, {}});
  const std::vector<std::vector<std::int32_t>> rows = rows_of(balls, patches, monitor);

  const std::size_t n = patches.triangles.size();
  std::int64_t entries = 0;
  std::size_t longest = 1;
  std::vector<std::int32_t> number(n, -1);  // of the column; at first 0 for what is covered
  for (const auto& row : rows) {
    entries += static_cast<std::int64_t>(row.size());
    longest = std::max(longest, row.size());
    for (const std::int32_t t : row) number[at(t)] = 0;
  }
  require_memory(entries, options, monitor);
  std::vector<std::int32_t> column_ids, uncovered;
  for (std::size_t t = 0; t < n; ++t) {
    const auto id = static_cast<std::int32_t>(t);
    if (number[t] < 0) {
      uncovered.push_back(id);
    } else {
      number[t] = static_cast<std::int32_t>(column_ids.size());
      column_ids.push_back(id);
    }
  }
  if (!uncovered.empty()) {
    const std::string cause = std::to_string(uncovered.size()) + " of " + std::to_string(n) +
                              " triangles are whole in no ball, the first is triangle " +
                              std::to_string(uncovered.front());
    if (options.uncovered == UncoveredPolicy::error) {
      throw InputError(cause, "enlarge the balls, or set uncovered to report");
    }
    monitor.warn(cause + ": they are left out and listed");
  }
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  columns.reserve(static_cast<std::size_t>(entries));
  for (const auto& row : rows) {
    for (const std::int32_t t : row) columns.push_back(number[at(t)]);
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
  }

  CoverMatrix result{{}, balls};
  CoverState& cover = result.cover;
  cover.balls = static_cast<std::int64_t>(balls.size());
  cover.samples = static_cast<std::int64_t>(n);
  cover.row_ids = numbers(balls.size());
  cover.row_offsets = std::move(offsets);
  cover.columns = std::move(columns);
  const auto best = static_cast<std::int64_t>(longest), cols = static_cast<std::int64_t>(column_ids.size());
  raise_lower_bound(cover, (cols + best - 1) / best, BoundHow::lemma_3_7);
  cover.column_ids = std::move(column_ids);
  cover.uncovered = std::move(uncovered);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
