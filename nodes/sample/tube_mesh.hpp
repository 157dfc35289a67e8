// Tubes around curves.
#pragma once

#include <cstdint>
#include <functional>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct TubeCurve {
  std::function<Vec3(double)> point;    // of t in [0, 1]
  std::function<Vec3(double)> tangent;  // derivative, of any positive length
  std::function<Vec3(double)> side;     // continuous, nowhere parallel to the tangent; periodic when closed
  bool closed = false;
};

/// The tube of radius r, less than the curve's radius of curvature, with about n vertices in rings of equal
/// arc length; open curves end in half spheres. Closed, manifold, outward oriented.
TriangleMesh tube_mesh(const TubeCurve& curve, double r, std::int64_t n);

}  // namespace ballflow::geometry
