#include "ellipsoids/verify_ellipsoids.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "search/ellipsoid.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t block = 32;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What has to be covered, ascending along one axis.
class Demands {
 public:
  Demands(const PointSet& points, const TriangleMesh& patches) : points_(points), patches_(patches) {}

  bool whole() const { return !patches_.triangles.empty(); }
  std::size_t size() const { return whole() ? patches_.triangles.size() : points_.points.size(); }
  Vec3 place(std::int32_t j) const {
    return whole() ? patches_.vertices[at(patches_.triangles[at(j)][0])] : points_.points[at(j)];
  }
  bool in(const Ellipsoid& e, std::int32_t j) const {
    if (!whole()) return e.contains(points_.points[at(j)]);
    return std::all_of(patches_.triangles[at(j)].begin(), patches_.triangles[at(j)].end(),
                       [&](std::int32_t v) { return e.contains(patches_.vertices[at(v)]); });
  }
  std::string name(std::int32_t j) const {
    char text[128];
    const Vec3 p = place(j);
    std::snprintf(text, sizeof text, "%s %d at (%.9g, %.9g, %.9g)", whole() ? "triangle" : "sample", j, p.x,
                  p.y, p.z);
    return text;
  }

 private:
  const PointSet& points_;
  const TriangleMesh& patches_;
};

/// Some of the demands by their x, so that those in the box of an ellipsoid are found.
class Sweep {
 public:
  Sweep(const Demands& demands, std::vector<std::int32_t> listed)
      : demands_(demands), listed_(std::move(listed)) {
    std::sort(listed_.begin(), listed_.end(), [&](std::int32_t a, std::int32_t b) {
      const double x = demands.place(a).x, y = demands.place(b).x;
      return x != y ? x < y : a < b;
    });
  }
  template <class Found>
  void in(const Ellipsoids& all, std::size_t i, const Found& found) const {
    const Box box = bounding_box(all, i);
    const double slack = 0x1p-29 * (box.upper.x - box.lower.x);  // of the membership
    const Ellipsoid e(all, i);
    auto first = std::lower_bound(listed_.begin(), listed_.end(), box.lower.x - slack,
                                  [&](std::int32_t j, double x) { return demands_.place(j).x < x; });
    for (; first != listed_.end() && demands_.place(*first).x <= box.upper.x + slack; ++first)
      if (demands_.in(e, *first)) found(*first);
  }

 private:
  const Demands& demands_;
  std::vector<std::int32_t> listed_;
};

[[noreturn]] void refuse(const std::string& cause) {
  throw InputError(cause, "compute the cover again from these ellipsoids and samples");
}

std::int64_t checked_bound(const CoverState& cover, const Ellipsoids& candidates, const Demands& demands,
                           Monitor& monitor) {
  const auto& listed = cover.certificate_samples;
  std::vector<std::int32_t> entry(demands.size(), -1);
  for (std::size_t k = 0; k < listed.size(); ++k) entry[at(listed[k])] = static_cast<std::int32_t>(k);
  const Sweep sweep(demands, {listed.begin(), listed.end()});
  std::vector<std::string> causes(blocks_of(candidates.size(), block));
  for_each_block(
      candidates.size(), block, monitor, 0.3, 0.9, [&](std::size_t b, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && causes[b].empty(); ++i) {
          std::int64_t cost = 0;
          std::int32_t group = -1;
          bool groups = false;
          sweep.in(candidates, i, [&](std::int32_t s) {
            const std::size_t k = at(entry[at(s)]);
            cost += cover.certificate_prices[k];
            const std::int32_t here = cover.certificate_groups[k];
            groups = groups || (group >= 0 && here != group);
            group = here;
          });
          if (cost > price_unit || groups) {
            causes[b] = "ellipsoid " + std::to_string(i) + " contains samples of the certificate " +
                        (groups ? "of two groups" : "whose prices sum to more than 1");
          }
        }
      });
  for (const std::string& cause : causes)
    if (!cause.empty()) refuse(cause);
  return cover.certified_bound();
}

}  // namespace

CoverCheck verify_ellipsoids(const Ellipsoids& ellipsoids, const PointSet& points,
                             const TriangleMesh& patches, const CoverState* cover,
                             const Ellipsoids* candidates, Monitor& monitor) {
  const Demands demands(points, patches);
  for (const std::string& broken :
       {broken_invariant(ellipsoids), broken_invariant(points), broken_invariant(patches),
        cover != nullptr ? broken_invariant(*cover) : "",
        candidates != nullptr ? broken_invariant(*candidates) : ""}) {
    if (!broken.empty()) throw InputError("the input is damaged: " + broken, "compute it again");
  }
  const std::size_t n = demands.size();
  if (cover != nullptr && candidates != nullptr &&
      (cover->samples != static_cast<std::int64_t>(n) ||
       cover->balls != static_cast<std::int64_t>(candidates->size()))) {
    refuse("the cover is about " + std::to_string(cover->balls) + " ellipsoids and " +
           std::to_string(cover->samples) + " samples, and there are " + std::to_string(candidates->size()) +
           " and " + std::to_string(n));
  }
  std::vector<std::int32_t> all(n);
  std::iota(all.begin(), all.end(), 0);
  const Sweep sweep(demands, std::move(all));
  std::vector<std::uint8_t> covered(n);
  for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
    if (i % block == 0) monitor.step(0.3 * static_cast<double>(i) / static_cast<double>(ellipsoids.size()));
    sweep.in(ellipsoids, i, [&](std::int32_t j) { covered[at(j)] = 1; });
  }
  std::vector<std::int32_t> uncovered;
  for (std::size_t j = 0; j < n; ++j)
    if (covered[j] == 0) uncovered.push_back(static_cast<std::int32_t>(j));
  CoverCheck result;
  result.balls = static_cast<std::int64_t>(ellipsoids.size());
  result.samples = static_cast<std::int64_t>(n);
  if (cover != nullptr && candidates != nullptr) {
    const Sweep hopeless(demands, {cover->uncovered.begin(), cover->uncovered.end()});
    for (std::size_t i = 0; i < candidates->size() && !cover->uncovered.empty(); ++i) {
      hopeless.in(*candidates, i, [&](std::int32_t j) {
        refuse(demands.name(j) + " is said to be in no ellipsoid, and lies in ellipsoid " +
               std::to_string(i));
      });
    }
  }
  for (const std::int32_t j : uncovered) {
    const bool known = cover != nullptr && candidates != nullptr &&
                       std::binary_search(cover->uncovered.begin(), cover->uncovered.end(), j);
    if (!known)
      refuse(demands.name(j) + " lies in none of the " + std::to_string(ellipsoids.size()) + " ellipsoids");
  }
  if (cover != nullptr && candidates != nullptr && cover->certificate_samples.size() != 0) {
    result.certified_bound = checked_bound(*cover, *candidates, demands, monitor);
  }
  result.uncovered = std::move(uncovered);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
