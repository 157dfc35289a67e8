#include "ellipsoids/ellipsoid_matrix.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "base/lists.hpp"
#include "base/memory.hpp"
#include "search/box_tree.hpp"
#include "search/ellipsoid.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 64;  // ellipsoids between two looks at the monitor

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

/// The samples along the axes of one rotation: there the box of an ellipsoid is tight.
class TurnedSamples {
 public:
  TurnedSamples(const Array<Vec3>& points, const Quaternion& rotation)
      : points_(points), frame_(frame_of(rotation)) {
    turned_.reserve(points.size());
    for (const Vec3 p : points) turned_.push_back(frame_.into(p));
    tree_ = BoxTree(std::span<const Vec3>(turned_), 32);
  }

  /// Appends the samples in the ellipsoid.
  void in(const Ellipsoid& e, std::vector<std::int32_t>& found) const {
    const auto nodes = tree_.nodes();
    if (nodes.empty()) return;
    const Vec3 c = frame_.into(e.center()), r = e.radii();
    std::array<std::int32_t, 80> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::int32_t here = stack[--depth];
      const BoxTree::Node& node = nodes[at(here)];
      if (norm(nearest(node.box, c, r)) > 1 + slack) continue;
      if (norm(farthest(node.box, c, r)) < 1 - slack) {
        for (std::int32_t k = node.first; k < node.last; ++k) found.push_back(tree_.order()[at(k)]);
      } else if (node.second == 0) {
        for (std::int32_t k = node.first; k < node.last; ++k) {
          const std::int32_t s = tree_.order()[at(k)];
          if (e.contains(points_[at(s)])) found.push_back(s);
        }
      } else {
        stack[depth++] = node.second;
        stack[depth++] = here + 1;
      }
    }
  }

 private:
  // Far above the rounding of turned coordinates of ellipsoids that are not tiny beside them; those that are
  // take the samples one by one.
  static constexpr double slack = 0x1p-16;
  static double norm(Vec3 v) { return squared_norm(v.x, v.y, v.z); }
  static Vec3 nearest(const Box& box, Vec3 c, Vec3 r) {
    const auto outside = [](double low, double high, double x, double a) {
      return std::max({low - x, x - high, 0.0}) / a;
    };
    return {outside(box.lower.x, box.upper.x, c.x, r.x), outside(box.lower.y, box.upper.y, c.y, r.y),
            outside(box.lower.z, box.upper.z, c.z, r.z)};
  }
  static Vec3 farthest(const Box& box, Vec3 c, Vec3 r) {
    const auto away = [](double low, double high, double x, double a) {
      return std::max(x - low, high - x) / a;
    };
    return {away(box.lower.x, box.upper.x, c.x, r.x), away(box.lower.y, box.upper.y, c.y, r.y),
            away(box.lower.z, box.upper.z, c.z, r.z)};
  }

  const Array<Vec3>& points_;
  Frame frame_;
  std::vector<Vec3> turned_;
  BoxTree tree_;
};

/// Rounding of coordinates may not reach the slack of the tree, in units of the shortest half-axis.
void require_resolved(const Ellipsoids& ellipsoids, const Array<Vec3>& points) {
  double largest = 0;
  for (const Vec3 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
    const Ellipsoid e(ellipsoids, i);
    const Vec3 c = e.center();
    const double all = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    if (!(all <= 1e140) || e.shortest() < 0x1p-32 * all) {
      throw InputError("ellipsoid " + std::to_string(i) + " has a half-axis of " +
                           std::to_string(e.shortest()) + " among coordinates up to " + std::to_string(all),
                       "let it grow more (epsilon), move the model to the origin, or scale it less");
    }
  }
}

}  // namespace

CoverState ellipsoid_matrix(const Ellipsoids& ellipsoids, const PointSet& points, const TriangleMesh& patches,
                            const EllipsoidMatrixOptions& options, Monitor& monitor) {
  for (const std::string& broken :
       {broken_invariant(ellipsoids), broken_invariant(points), broken_invariant(patches)}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  const bool whole = !patches.triangles.empty();
  const Array<Vec3>& places = whole ? patches.vertices : points.points;
  const std::size_t m = ellipsoids.size(), n = whole ? patches.triangles.size() : places.size();
  require_resolved(ellipsoids, places);

  std::map<Quaternion, std::unique_ptr<TurnedSamples>> turned;
  for (const Quaternion& q : ellipsoids.rotations) {
    auto& samples = turned[q];
    if (samples == nullptr) samples = std::make_unique<TurnedSamples>(places, q);
  }
  monitor.step(0.1);
  const auto triangles_at = lists_of<std::int32_t>(whole ? places.size() : 0, [&](auto put) {
    for (std::size_t t = 0; t < patches.triangles.size(); ++t)
      put(at(patches.triangles[t][0]), static_cast<std::int32_t>(t));
  });

  const MemoryLimit memory(monitor);
  std::vector<std::vector<std::int32_t>> rows(m);
  std::atomic<std::int64_t> entries{0};
  const auto enough = [&](std::int64_t count) {
    if (count <= options.max_entries && memory.allows(8.0 * static_cast<double>(count))) return;
    throw InputError(
        "the matrix has more than " + std::to_string(count) + " entries; " +
            (count > options.max_entries ? "max_entries is " + std::to_string(options.max_entries)
                                         : memory.text()),
        "raise delta, so that there are fewer samples, or grant more");
  };
  for_each_block(m, block, monitor, 0.1, 0.8, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<std::int32_t> found;
    for (std::size_t i = first; i < last; ++i) {
      const Ellipsoid e(ellipsoids, i);
      found.clear();
      turned.at(ellipsoids.rotations[i])->in(e, found);
      std::vector<std::int32_t>& row = rows[i];
      if (whole) {
        for (const std::int32_t v : found) {
          for (const std::int32_t t : triangles_at[at(v)]) {
            const Triangle& corners = patches.triangles[at(t)];
            if (e.contains(places[at(corners[1])]) && e.contains(places[at(corners[2])])) row.push_back(t);
          }
        }
      } else {
        row.assign(found.begin(), found.end());
      }
      std::sort(row.begin(), row.end());
      const auto size = static_cast<std::int64_t>(row.size());
      enough(entries.fetch_add(size) + size);
    }
  });

  CoverState cover;
  cover.balls = static_cast<std::int64_t>(m);
  cover.samples = static_cast<std::int64_t>(n);
  std::vector<std::int32_t> number(n, -1), column_ids, uncovered;
  std::int64_t longest = 1;
  for (const auto& row : rows) {
    longest = std::max(longest, static_cast<std::int64_t>(row.size()));
    for (const std::int32_t s : row) number[at(s)] = 0;
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (number[j] < 0) {
      uncovered.push_back(static_cast<std::int32_t>(j));
    } else {
      number[j] = static_cast<std::int32_t>(column_ids.size());
      column_ids.push_back(static_cast<std::int32_t>(j));
    }
  }
  monitor.step(0.9);
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  offsets.reserve(m + 1);
  columns.reserve(static_cast<std::size_t>(entries.load()));
  for (auto& row : rows) {
    for (const std::int32_t s : row) columns.push_back(number[at(s)]);
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
    std::vector<std::int32_t>().swap(row);
  }
  if (!uncovered.empty()) {
    monitor.warn(std::to_string(uncovered.size()) + " of " + std::to_string(n) +
                 (whole ? " triangles lie in no ellipsoid" : " samples lie in no ellipsoid") +
                 ": they are left out and listed; grow more, or lower delta");
  }
  const auto cols = static_cast<std::int64_t>(column_ids.size());
  cover.row_ids = numbers(m);
  cover.row_offsets = std::move(offsets);
  cover.columns = std::move(columns);
  cover.column_ids = std::move(column_ids);
  cover.uncovered = std::move(uncovered);
  cover.lower_bound = (cols + longest - 1) / longest;
  cover.lower_bound_how = static_cast<std::uint8_t>(BoundHow::lemma_3_7);
  monitor.step(1);
  return cover;
}

}  // namespace ballflow::geometry
