// Coordinates in which a model is about as large as 1 and parallel to nothing.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Rotated by a fixed rotation, about the middle of the box of the points, whose longest edge becomes 1.
class GenericFrame {
 public:
  explicit GenericFrame(std::span<const Vec3> points) {
    const Box box = bounding_box(points);
    middle_ = 0.5 * (box.lower + box.upper);
    size_ = box.longest_edge();
    const Vec3 a{0.83, 0.41, -0.37}, b{-0.29, 0.89, 0.34};
    rows_[0] = 1 / length(a) * a;
    const Vec3 rest = b - dot(b, rows_[0]) * rows_[0];
    rows_[1] = 1 / length(rest) * rest;
    rows_[2] = cross(rows_[0], rows_[1]);
  }

  /// Model units for 1.
  double size() const { return size_; }
  Vec3 into(Vec3 p) const {
    const Vec3 d = 1 / size_ * (p - middle_);
    return {dot(rows_[0], d), dot(rows_[1], d), dot(rows_[2], d)};
  }
  Vec3 out_of(Vec3 p) const { return middle_ + size_ * (p.x * rows_[0] + p.y * rows_[1] + p.z * rows_[2]); }

 private:
  Vec3 middle_;
  double size_ = 1;
  Vec3 rows_[3];
};

}  // namespace ballflow::geometry
