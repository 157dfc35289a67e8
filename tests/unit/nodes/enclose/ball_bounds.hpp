// Whether balls stay inside a solid, or within a distance of it, in rational arithmetic.
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "search/winding_number.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

using ExactKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;

inline ExactKernel::Point_3 exact_point(Vec3 p) { return {p.x, p.y, p.z}; }

/// The squared distance of a point from all triangles. Precondition: there are some.
inline CGAL::Exact_rational squared_from_mesh(const TriangleMesh& mesh, Vec3 p) {
  CGAL::Exact_rational least = -1;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) {
      return exact_point(mesh.vertices[static_cast<std::size_t>(t[k])]);
    };
    const CGAL::Exact_rational squared =
        CGAL::squared_distance(exact_point(p), ExactKernel::Triangle_3(corner(0), corner(1), corner(2)));
    if (least < 0 || squared < least) least = squared;
  }
  return least;
}

/// That no point of a ball is farther than `within` from the solid: its centre is inside, and r - within is
/// no more than its distance to any triangle.
inline void expect_bounded(const TriangleMesh& mesh, const Balls& balls, double within) {
  const WindingNumber winding(mesh, no_monitor());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_NE(winding.around(balls.centers[i]).number, 0) << "centre " << i;
    const CGAL::Exact_rational rest = CGAL::Exact_rational(balls.radii[i]) - CGAL::Exact_rational(within);
    if (rest <= 0) continue;
    EXPECT_GE(squared_from_mesh(mesh, balls.centers[i]), rest * rest) << "ball " << i;
  }
}

}  // namespace ballflow::geometry
