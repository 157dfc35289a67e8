// The triangles of a surface: the point of it next to a point, and where rays meet it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "search/box_tree.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A point on a triangle of the surface.
struct SurfacePoint {
  Vec3 point;
  std::int32_t triangle = -1;
  double distance = 0;  // from what was asked for; along a ray in lengths of its direction
};

/// Coordinates are rounded; nothing that decides topology may depend on them alone. A ray that runs through
/// an edge meets one of its triangles, both or, by rounding, none. Answers are functions of mesh and
/// question.
class SurfaceTree {
 public:
  /// Any triangles with finite corners, degenerate ones too, fewer than 2^31.
  explicit SurfaceTree(const TriangleMesh& mesh, Monitor& monitor = no_monitor());

  /// The point of the surface next to p, when it is nearer than `limit`.
  std::optional<SurfacePoint> nearest(Vec3 p, double limit) const;

  /// The first meeting of origin + t * direction with the surface for t in (from, to).
  std::optional<SurfacePoint> first_hit(Vec3 origin, Vec3 direction, double from, double to) const;

  /// All of them, in any order; one on an edge may be there twice.
  std::vector<SurfacePoint> hits(Vec3 origin, Vec3 direction, double from, double to) const;

  /// The normal of a triangle, of length 1; 0 for one without area. It points to where the triangle is seen
  /// counter-clockwise.
  Vec3 normal(std::int32_t triangle) const {
    return items_[place_[static_cast<std::size_t>(triangle)]].normal;
  }

 private:
  struct Item {
    std::array<Vec3, 3> corners;
    Vec3 normal;
    std::int32_t triangle;
  };
  /// What lies between two parallel planes.
  struct Slab {
    Vec3 normal;  // of length 1, or 0 for all space
    double low = 0, high = 0;
  };
  void make_slabs();
  double bound(std::size_t node, Vec3 p, double slack) const;

  template <class Visit>
  void along(Vec3 origin, Vec3 direction, double from, double to, const Visit& visit) const;

  BoxTree tree_;
  std::vector<Item> items_;  // in the order of the tree: those of a leaf are side by side in the memory
  std::vector<std::size_t> place_;  // of each triangle in items_
  // Of every node. A ball that touches the surface is nearly as far from a wide patch of it; boxes of a
  // slanted patch reach into the ball, its slab does not.
  std::vector<Slab> slabs_;
  double reach_ = 0;  // the largest coordinate
};

}  // namespace ballflow::geometry
