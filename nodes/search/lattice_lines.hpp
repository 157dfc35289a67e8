// Where the lines of a lattice meet the triangles of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

using Index3 = std::array<std::int64_t, 3>;

/// Points in a box, `spacing` apart along the axes.
class Lattice {
 public:
  Lattice(const Box& box, double spacing) : lower_(box.lower), spacing_(spacing) {
    const Vec3 size = box.upper - box.lower;
    count_ = {1 + static_cast<std::int64_t>(size.x / spacing),
              1 + static_cast<std::int64_t>(size.y / spacing),
              1 + static_cast<std::int64_t>(size.z / spacing)};
  }
  /// Points along each axis.
  const Index3& count() const { return count_; }
  std::size_t size() const { return static_cast<std::size_t>(count_[0] * count_[1] * count_[2]); }
  std::size_t number(const Index3& i) const {
    return static_cast<std::size_t>((i[2] * count_[1] + i[1]) * count_[0] + i[0]);
  }
  Vec3 point(const Index3& i) const {
    return lower_ +
           spacing_ * Vec3{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])};
  }
  double spacing() const { return spacing_; }
  Vec3 lower() const { return lower_; }

 private:
  Vec3 lower_;
  double spacing_;
  Index3 count_{};
};

/// Where a line along one axis meets the surface.
struct Crossing {
  std::int64_t
      line;   // (place along the axis after the next) * (points along the next) + place along the next
  double at;  // in units of the lattice
  int sign;   // which way the triangle faces: lines enter and leave closed surfaces by opposite ones
  friend bool operator<(const Crossing& a, const Crossing& b) {
    return a.line != b.line ? a.line < b.line : (a.at != b.at ? a.at < b.at : a.sign < b.sign);
  }
};

/// All crossings with the lines along `axis`, line by line and ascending. Where two triangles share an edge,
/// a line between them meets one of them: sides of edges are computed in one way. Lines that run exactly
/// through an edge meet none, so the surface should not be parallel to the lattice.
std::vector<Crossing> crossings_along(std::size_t axis, const Lattice& lattice,
                                      std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                      Lookout& look);

}  // namespace ballflow::geometry
