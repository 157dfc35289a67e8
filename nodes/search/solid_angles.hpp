// Solid angles of triangles, summed hierarchically, in arithmetic that gives the same bits on every machine.
#pragma once

#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Solid angle of the triangle seen from `point`, divided by 4 pi; positive when the triangle is
/// counter-clockwise seen from the far side [Van Oosterom and Strackee 1983].
double solid_angle_fraction(Vec3 a, Vec3 b, Vec3 c, Vec3 point);

/// The sum of solid_angle_fraction over triangles: the generalized winding number of the set they form
/// [Jacobson et al. 2013]. Far clusters, and far triangles of near clusters, are replaced by dipoles [Barill
/// et al. 2018], here with a bound of the error: a cluster of area A within distance R of its centroid at
/// distance d deviates by at most A R / (2 pi (d - R)^3), because the derivative of x / |x|^3 has norm 2 /
/// |x|^3. Where all of the area that far would say nothing, A / (4 pi (d - R)^2), they are left out.
class SolidAngles {
 public:
  SolidAngles(std::span<const Vec3> vertices, std::span<const Triangle> triangles, Monitor& monitor);

  struct Sum {
    double value = 0;
    double error = 0;  // bound of the deviation from the exact sum, rounding not counted
  };
  /// The error stays below `tolerance`; 0 adds every triangle.
  Sum sum(Vec3 point, double tolerance) const;

 private:
  struct Cluster {
    Vec3 centroid;
    Vec3 normal;  // sum of area times unit normal
    double area = 0;
    double radius = 0;  // nothing of it is farther from the centroid
  };
  struct Corners : Cluster {
    Vec3 a, b, c;
  };
  struct Node : Cluster {
    std::int32_t link = 0;   // leaf: first triangle; else the second child
    std::int32_t count = 0;  // of triangles in a leaf, else 0
  };
  bool add_far(const Cluster& cluster, Vec3 point, double tolerance, Sum& sum) const;
  void add(std::int32_t index, Vec3 point, double tolerance, Sum& sum) const;

  std::vector<Node> nodes_;  // in preorder
  std::vector<Corners> corners_;
};

}  // namespace ballflow::geometry
