// The surface that balls are compared with: samples of it, and the distance to it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "measure/blocks.hpp"
#include "search/box_tree.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The distance of p to a triangle. Degenerate triangles are their edges.
double triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

/// Triangles, or points where there are none. A triangle is split in k x k equal parts, the smallest k for
/// which none of its points is farther than the spacing from the centroid of a part; each centroid is a
/// sample and stands for the area of its part. Points are samples themselves, of area 1 each.
class ComparedSurface {
 public:
  /// `mesh` must outlive it.
  ComparedSurface(const PointSet& points, const TriangleMesh& mesh);

  bool is_cloud() const { return mesh_.triangles.empty(); }
  Box box() const { return bounding_box(is_cloud() ? points_.span() : mesh_.vertices.span()); }

  /// The distance to the nearest point of the surface: the same bits whatever the order of the triangles.
  double distance_to(Vec3 p) const;

  /// Calls visit(corners) for the triangles that may be nearer to p than `limit`; points have equal corners.
  template <class Visit>
  void near(Vec3 p, double limit, const Visit& visit) const {
    tree_.below(p, limit, [&](std::size_t i) {
      visit(is_cloud() ? std::array<Vec3, 3>{points_[i], points_[i], points_[i]} : triangle(i));
    });
  }

  /// Decides on the samples, and spends them. Once.
  void sample(double spacing, Budget& budget);
  std::size_t samples() const {
    return is_cloud() ? points_.size() : static_cast<std::size_t>(first_.back());
  }
  /// Calls visit(position, area) for samples [first, last).
  template <class Visit>
  void for_samples(std::size_t first, std::size_t last, const Visit& visit) const {
    if (is_cloud()) {
      for (std::size_t k = first; k < last; ++k) visit(points_[k], 1.0);
      return;
    }
    const auto after = std::upper_bound(first_.begin(), first_.end(), static_cast<std::int64_t>(first));
    for (auto t = static_cast<std::size_t>(after - first_.begin()) - 1; first < last; ++t) {
      const std::size_t end = std::min(last, static_cast<std::size_t>(first_[t + 1]));
      Parts parts(triangle(t), edges_[t], static_cast<std::int64_t>(first) - first_[t]);
      for (; first < end; ++first, parts.advance()) visit(parts.centroid(), parts.area());
    }
  }

 private:
  /// The parts of a triangle, row by row from the edge ac; those that are turned around follow those that are
  /// not.
  class Parts {
   public:
    /// At part `number` of edges * edges.
    Parts(const std::array<Vec3, 3>& corners, std::int32_t edges, std::int64_t number);
    Vec3 centroid() const;
    double area() const { return area_; }
    void advance();

   private:
    Vec3 a_, ab_, ac_;
    std::int32_t edges_, row_, column_;
    bool turned_;
    double area_;
  };

  std::array<Vec3, 3> triangle(std::size_t t) const {
    const Triangle& ids = mesh_.triangles[t];
    return {mesh_.vertices[static_cast<std::size_t>(ids[0])],
            mesh_.vertices[static_cast<std::size_t>(ids[1])],
            mesh_.vertices[static_cast<std::size_t>(ids[2])]};
  }

  const Array<Vec3> points_;
  const TriangleMesh& mesh_;
  BoxTree tree_;
  std::vector<std::int32_t> edges_;  // per triangle: parts of each edge
  std::vector<std::int64_t> first_;  // per triangle and one more: its first sample
};

}  // namespace ballflow::geometry
