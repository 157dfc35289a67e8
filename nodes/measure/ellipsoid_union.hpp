// The union of ellipsoids, and samples of its boundary.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "measure/blocks.hpp"
#include "measure/boundary_samples.hpp"
#include "search/box_tree.hpp"
#include "search/ellipsoid.hpp"

namespace ballflow::geometry {

class EllipsoidUnion {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  explicit EllipsoidUnion(const Ellipsoids& ellipsoids);

  std::size_t size() const { return items_.size(); }
  const Ellipsoid& operator[](std::size_t i) const { return items_[i]; }

  /// The smallest signed distance to the ellipsoids but `except`: outside the union its distance, inside at
  /// least minus its depth in the one it is deepest in. Where it is below `enough`, some value below it.
  double depth(Vec3 p, double enough = -std::numeric_limits<double>::infinity(),
               std::size_t except = none) const;

  /// Calls visit(j) for all others whose boxes meet that of ellipsoid i, and perhaps for some more.
  template <class Visit>
  void for_neighbours(std::size_t i, const Visit& visit) const {
    tree_.below(items_[i].center(), items_[i].longest() * (1 + 0x1p-20), visit);
  }

 private:
  std::vector<Ellipsoid> items_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

/// As boundary_samples() of balls: the spheres' parts are mapped, and how far their points are from the
/// sample is at most the longest half-axis times what it was on the unit sphere.
BoundarySamples boundary_samples(const EllipsoidUnion& all, double spacing, double tolerance, Budget& budget,
                                 Monitor& monitor = no_monitor());

/// The volume of the union: along lines of a grid, on each of which the union is a set of intervals that
/// formulas give; `lines` along each edge of the grid, in the middle of equal strips of the box, along its
/// shortest edge. Exact but for what lies between lines: typically 1e-4 of the volume.
double union_volume(const EllipsoidUnion& all, const Ellipsoids& ellipsoids, int lines, Monitor& monitor);

}  // namespace ballflow::geometry
