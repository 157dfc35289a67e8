#include "enclose/grow_over.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/for_each_block.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

using Part = std::array<Vec3, 3>;

struct Asking {
  Part part;
  double growth = 0;     // from the radii at the beginning, above 0
  std::size_t ball = 0;  // that needs no more
};

/// The longest edge is that opposite the result; the first of equal ones.
std::size_t opposite_longest_edge(const Part& p) {
  std::array<double, 3> squared{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
    squared[k] = dot(edge, edge);
  }
  return static_cast<std::size_t>(std::max_element(squared.begin(), squared.end()) - squared.begin());
}

/// How far the part reaches from p: the distance from a point is convex.
double reach(const Part& part, Vec3 p) {
  return std::max({distance(part[0], p), distance(part[1], p), distance(part[2], p)});
}

// Of the growth that some vertex asks for: parts need not be told apart by less.
constexpr double share_of_most = 0.05;

class Growing {
 public:
  Growing(std::span<const Vec3> centers, std::span<double> radii, double tolerance)
      : centers_(centers),
        radii_(radii),
        start_(radii.begin(), radii.end()),
        tolerance_(tolerance),
        tree_(centers) {
    tree_.set_slacks(start_);
  }

  void allow(double tolerance) { tolerance_ = std::max(tolerance_, tolerance); }

  /// The growth that a point asks for, below 0 in a ball.
  double growth_for(Vec3 p) const {
    return tree_.smallest(p, std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(),
                          [&](std::size_t i) { return distance(p, centers_[i]) - start_[i]; });
  }

  std::vector<Asking> parts_of(const Part& triangle) const {
    constexpr std::size_t most_parts = std::size_t{1} << 20;
    struct Waiting {
      Part part;
      std::vector<std::size_t> balls;  // all that are best for a point of it, and perhaps others
    };
    std::vector<Asking> result;
    std::vector<Waiting> waiting;
    waiting.push_back({triangle, {}});
    const double radius = reach(triangle, middle(triangle));
    tree_.below(middle(triangle), growth_for(middle(triangle)) + 2 * radius + tolerance_,
                [&](std::size_t i) { waiting[0].balls.push_back(i); });
    for (std::size_t parts = 0; !waiting.empty(); ++parts) {
      auto [part, balls] = std::move(waiting.back());
      waiting.pop_back();
      if (parts > 0) keep_near(part, balls);
      Asking asking{part, std::numeric_limits<double>::infinity(), 0};
      std::array<double, 3> corners;
      corners.fill(asking.growth);
      for (const std::size_t i : balls) {
        double farthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double d = distance(part[k], centers_[i]);
          farthest = std::max(farthest, d);
          corners[k] = std::min(corners[k], d - start_[i]);
        }
        if (farthest - start_[i] >= asking.growth) continue;
        asking.growth = farthest - start_[i];
        asking.ball = i;
      }
      if (asking.growth <= 0) continue;
      const double least = std::max({0.0, corners[0], corners[1], corners[2]});
      if (asking.growth <= least + tolerance_ || parts >= most_parts) {
        result.push_back(asking);
        continue;
      }
      const std::size_t k = opposite_longest_edge(part);
      const Vec3 half = 0.5 * (part[(k + 1) % 3] + part[(k + 2) % 3]);
      for (const std::size_t moved : {(k + 1) % 3, (k + 2) % 3}) {
        waiting.push_back({part, balls});
        waiting.back().part[moved] = half;
      }
    }
    return result;
  }

  /// `asking`: descending by growth.
  void grow(std::span<const Asking> asking, Monitor& monitor) {
    if (asking.empty()) return;
    const double most = asking[0].growth;
    std::vector<double> slacks(start_);
    for (double& slack : slacks) slack += most;
    tree_.set_slacks(slacks);
    Lookout look(monitor);
    for (std::size_t a = 0; a < asking.size(); ++a) {
      if (look.due(1000)) monitor.step(static_cast<double>(a) / static_cast<double>(asking.size()));
      const Part& part = asking[a].part;
      if (reach(part, centers_[asking[a].ball]) <= radii_[asking[a].ball]) continue;
      double least = std::numeric_limits<double>::infinity();
      std::size_t best = centers_.size();
      tree_.smallest(middle(part), least, 0, [&](std::size_t i) {
        const double needed = reach(part, centers_[i]);
        if (needed - start_[i] > most) return std::numeric_limits<double>::infinity();
        const double growth = needed - radii_[i];
        if (growth < least || (growth == least && i < best)) {
          least = growth;
          best = i;
        }
        return growth;
      });
      if (least > 0) radii_[best] = reach(part, centers_[best]);
    }
  }

 private:
  static Vec3 middle(const Part& part) { return 1.0 / 3 * (part[0] + part[1] + part[2]); }
  /// Leaves out balls that are best for no point of the part: growth changes by no more than one walks.
  void keep_near(const Part& part, std::vector<std::size_t>& balls) const {
    const Vec3 center = middle(part);
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : balls) least = std::min(least, distance(center, centers_[i]) - start_[i]);
    const double limit = least + 2 * reach(part, center) * (1 + 1e-9) + 1e-3 * tolerance_;
    std::erase_if(balls, [&](std::size_t i) { return distance(center, centers_[i]) - start_[i] > limit; });
  }

  std::span<const Vec3> centers_;
  std::span<double> radii_;
  std::vector<double> start_;
  double tolerance_;
  BoxTree tree_;
};

}  // namespace

void grow_over(const TriangleMesh& mesh, std::span<const Vec3> centers, std::span<double> radii,
               double tolerance, Monitor& monitor) {
  Growing growing(centers, radii, tolerance);
  constexpr std::size_t block = 16;
  const std::size_t count = mesh.triangles.size();
  std::vector<double> farthest(blocks_of(mesh.vertices.size(), block), 0);
  for_each_block(mesh.vertices.size(), block, monitor, 0, 0.1,
                 [&](std::size_t b, std::size_t first, std::size_t last) {
                   for (std::size_t v = first; v < last; ++v)
                     farthest[b] = std::max(farthest[b], growing.growth_for(mesh.vertices[v]));
                 });
  for (const double growth : farthest) growing.allow(share_of_most * growth);
  std::vector<std::vector<Asking>> of_block(blocks_of(count, block));
  for_each_block(count, block, monitor, 0.1, 0.6, [&](std::size_t b, std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      Part triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      const std::vector<Asking> found = growing.parts_of(triangle);
      of_block[b].insert(of_block[b].end(), found.begin(), found.end());
    }
  });
  std::vector<Asking> asking;
  for (std::vector<Asking>& found : of_block) {
    asking.insert(asking.end(), found.begin(), found.end());
    found = {};
  }
  std::stable_sort(asking.begin(), asking.end(),
                   [](const Asking& a, const Asking& b) { return a.growth > b.growth; });
  PartMonitor part(monitor, 0.6, 1);
  growing.grow(asking, part);
}

}  // namespace ballflow::geometry
