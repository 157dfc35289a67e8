// Samples of a shape as alignment sees them: evenly spread, with a tree, a frame and a size.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {

/// Indices of `count` points, each as far from those before it as any point is (Gonzalez 1985); the first is
/// the farthest from the mean. All of them, in their order, where there are no more. Ties go to the lower
/// index.
std::vector<std::int32_t> farthest_points(std::span<const Vec3> points, std::size_t count,
                                          Monitor& monitor = no_monitor());

/// Mean, root mean square distance from it, and principal axes.
struct PrincipalFrame {
  Vec3 mean;
  double radius = 0;
  std::array<double, 3> variances{};  // along the axes, ascending
  std::array<Vec3, 3> axes;           // orthonormal, right-handed; signs and equal ones are arbitrary
};
PrincipalFrame principal_frame(std::span<const Vec3> points);

struct Cloud {
  /// No more than `count` of the points, farthest points first. Normals are one for each point or none.
  Cloud(std::span<const Vec3> all, std::span<const Vec3> all_normals, std::size_t count,
        Monitor& monitor = no_monitor());

  /// The point next to p; of equally near ones any, but always the same.
  struct Nearest {
    std::size_t index = 0;
    double distance = 0;
  };
  Nearest nearest(Vec3 p) const;

  std::vector<Vec3> points, normals;
  PrincipalFrame frame;

 private:
  BoxTree tree_;
};

}  // namespace ballflow::geometry
