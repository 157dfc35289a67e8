// What CGAL alone needs for the same input: the yardstick of geometry_bench. A translation unit of its own,
// because each of these takes half a minute to compile.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "base/vec3.hpp"
#include "types/balls.hpp"

namespace ballflow::bench {

/// The Delaunay triangulation by range insertion, sequential; returns its number of finite cells.
std::size_t delaunay(std::span<const geometry::Vec3> points);

/// The regular triangulation of the balls by range insertion, sequential, hidden points discarded.
class RegularTriangulation {
 public:
  explicit RegularTriangulation(const geometry::Balls& balls);
  ~RegularTriangulation();
  RegularTriangulation(const RegularTriangulation&) = delete;
  RegularTriangulation& operator=(const RegularTriangulation&) = delete;

  std::size_t cells() const;
  /// CGAL's Fixed_alpha_shape_3 for alpha = 0 of this triangulation, which it takes over: the classification
  /// of all simplices. Returns its number of tetrahedra in the complex.
  std::size_t fixed_alpha_shape();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballflow::bench
