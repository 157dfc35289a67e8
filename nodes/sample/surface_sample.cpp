#include "sample/surface_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "base/first_equal.hpp"
#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t fewest = 4, most = 2'000'000;
// Candidates per point: Yuksel's recommendation; more cost time and hardly change the spacing.
constexpr std::size_t candidates_per_point = 5;
constexpr std::size_t items_per_step = 1 << 14;

struct Candidates {
  std::vector<Vec3> points;
  std::vector<std::int32_t> triangles;
};

class Triangles {
 public:
  explicit Triangles(const TriangleMesh& mesh) : mesh_(mesh) {
    areas_.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
      area_ += 0.5 * length(area_vector(t));
      areas_.push_back(area_);
    }
  }
  double area() const { return area_; }

  Candidates draw(std::size_t count, Random& random) const {
    Candidates result;
    result.points.reserve(count);
    result.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      // Triangles without area are never above the target by themselves.
      const auto found = std::upper_bound(areas_.begin(), areas_.end(), random.unit() * area_);
      const auto index = std::min(static_cast<std::size_t>(found - areas_.begin()), areas_.size() - 1);
      const Triangle& t = mesh_.triangles[index];
      const double s = std::sqrt(random.unit()), u = random.unit();
      const Vec3 &a = corner(t, 0), ab = corner(t, 1) - a, ac = corner(t, 2) - a;
      const Vec3 p = a + s * ((1 - u) * ab + u * ac);  // stays exactly in planes across an axis
      result.points.push_back(p + Vec3{0, 0, 0});      // no -0
      result.triangles.push_back(static_cast<std::int32_t>(index));
    }
    return result;
  }

  Vec3 normal(std::int32_t triangle) const {
    const Vec3 n = area_vector(mesh_.triangles[static_cast<std::size_t>(triangle)]);
    return (1 / length(n)) * n;
  }

 private:
  const Vec3& corner(const Triangle& t, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(t[k])];
  }
  Vec3 area_vector(const Triangle& t) const {
    return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
  }

  const TriangleMesh& mesh_;
  std::vector<double> areas_;  // of the triangles up to and with each
  double area_ = 0;
};

/// Fixed points, looked up by cells of a grid.
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<Vec3>& points, double radius) : points_(points), radius_(radius) {
    const Vec3 lower = bounding_box(points).lower;
    buckets_ = std::bit_ceil(points.size() + 1);
    cells_.reserve(points.size());
    begin_.assign(buckets_ + 1, 0);
    for (const Vec3& p : points) {
      const Vec3 q = p - lower;
      cells_.push_back({index(q.x / radius), index(q.y / radius), index(q.z / radius)});
      ++begin_[bucket(cells_.back()) + 1];
    }
    for (std::size_t b = 0; b < buckets_; ++b) begin_[b + 1] += begin_[b];
    items_.resize(points.size());
    std::vector<std::size_t> fill(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) items_[fill[bucket(cells_[i])]++] = i;
  }

  /// Calls visit(j, distance) for the other points nearer to point i than the radius, in a fixed order.
  template <class Visit>
  void for_each(std::size_t i, Visit visit) const {
    const Cell& home = cells_[i];
    for (std::int64_t dz = -1; dz <= 1; ++dz) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const Cell cell = {home[0] + dx, home[1] + dy, home[2] + dz};
          const std::size_t b = bucket(cell);
          for (std::size_t k = begin_[b]; k < begin_[b + 1]; ++k) {
            const std::size_t j = items_[k];
            if (j == i || cells_[j] != cell) continue;
            const double d = distance(points_[i], points_[j]);
            if (d < radius_) visit(j, d);
          }
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static std::int64_t index(double x) { return static_cast<std::int64_t>(std::floor(x)); }
  std::size_t bucket(const Cell& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t c : cell) h = mix_hash(h, static_cast<std::uint64_t>(c));
    return h & (buckets_ - 1);
  }

  const std::vector<Vec3>& points_;
  double radius_;
  std::size_t buckets_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> begin_, items_;
};

/// Removes the point with the most crowded neighbourhood until `count` are left (Yuksel 2015, algorithm 1).
std::vector<bool> eliminate(const std::vector<Vec3>& points, double area, std::size_t count,
                            Monitor& monitor) {
  // No `count` discs of a larger radius fit on the area.
  const double largest_radius = std::sqrt(area / (2 * std::sqrt(3.0) * static_cast<double>(count)));
  const double reach = 2 * largest_radius;
  const Neighbourhood neighbourhood(points, reach);
  const auto weight = [reach](double d) {
    const double w = 1 - d / reach, w2 = w * w, w4 = w2 * w2;
    return w4 * w4;
  };
  std::vector<double> weights(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % items_per_step == 0)
      monitor.step(0.5 * static_cast<double>(i) / static_cast<double>(points.size()));
    neighbourhood.for_each(i, [&](std::size_t, double d) { weights[i] += weight(d); });
  }
  // Weights only fall: an entry of the queue that is no longer true is put back with the present weight.
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry> queue;
  for (std::size_t i = 0; i < points.size(); ++i) queue.emplace(weights[i], i);
  std::vector<bool> kept(points.size(), true);
  const std::size_t surplus = points.size() - count;
  for (std::size_t removed = 0; removed < surplus;) {
    const auto [w, i] = queue.top();
    queue.pop();
    if (w != weights[i]) {
      queue.emplace(weights[i], i);
      continue;
    }
    kept[i] = false;
    if (++removed % items_per_step == 0) {
      monitor.step(0.5 + 0.5 * static_cast<double>(removed) / static_cast<double>(surplus));
    }
    neighbourhood.for_each(i, [&](std::size_t j, double d) {
      // Sums of rounded terms may end a little below zero, never above what was there.
      if (kept[j]) weights[j] = std::max(0.0, weights[j] - weight(d));
    });
  }
  return kept;
}

}  // namespace

PointSet sample_surface(const TriangleMesh& mesh, const SurfaceSampleOptions& options, Monitor& monitor) {
  if (options.count < fewest || options.count > most) {
    throw InputError("count is " + std::to_string(options.count),
                     "count is from " + std::to_string(fewest) + " to " + std::to_string(most));
  }
  const Triangles triangles(mesh);
  if (!(triangles.area() > 0) || !std::isfinite(triangles.area())) {
    throw InputError(mesh.triangles.empty() ? "the model has no faces to sample"
                                            : "the faces of the model have no finite area",
                     "take its vertices instead");
  }
  const auto count = static_cast<std::size_t>(options.count);
  const std::size_t drawn = options.spread == Spread::poisson ? candidates_per_point * count : count;
  Random random(options.seed);
  const Candidates candidates = triangles.draw(drawn, random);

  std::vector<Vec3> distinct;
  std::vector<std::int32_t> owners;
  const std::vector<std::int32_t> first = first_equal_point(candidates.points);
  for (std::size_t i = 0; i < drawn; ++i) {
    if (first[i] != static_cast<std::int32_t>(i)) continue;
    distinct.push_back(candidates.points[i]);
    owners.push_back(candidates.triangles[i]);
  }
  std::vector<bool> kept(distinct.size(), true);
  if (distinct.size() > count) kept = eliminate(distinct, triangles.area(), count, monitor);
  std::vector<Vec3> points, normals;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    if (!kept[i]) continue;
    points.push_back(distinct[i]);
    normals.push_back(triangles.normal(owners[i]));
  }
  return {std::move(points), std::move(normals)};
}

}  // namespace ballflow::geometry
