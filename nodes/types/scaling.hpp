// A linear map that makes the thin direction of an object thick: what balls of the scaled object are in
// space.
#pragma once

#include <cstdint>
#include <string>

#include "base/rotation.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// What the thickness of an object along an axis was taken from.
enum class ThicknessFrom : std::uint8_t {
  chords = 0,   // the mean length of what the solid leaves of lines along the axis
  extents = 1,  // of the box along the axes
  given = 2,    // the factors were given
};

/// p is mapped to (f_0 u_0.(p - o), f_1 u_1.(p - o), f_2 u_2.(p - o)): coordinates along the axes of the
/// frame, from the origin o on, each times its factor. The least factor is 1, so that no distance becomes
/// shorter.
struct Scaling {
  Vec3 origin;                      // o, model units
  Quaternion rotation;              // its frame has the axes u_0, u_1, u_2
  Vec3 factors{1, 1, 1};            // >= 1, one of them 1
  Vec3 thickness;                   // along the axes, model units; 0 where it was not needed
  double longest_edge = 0;          // of the box of the object along the coordinates: the unit of percents
  std::uint8_t thickness_from = 0;  // ThicknessFrom

  Frame frame() const { return frame_of(rotation); }
  double largest_factor() const;
};

/// A scaling at work.
class ScalingMap {
 public:
  explicit ScalingMap(const Scaling& scaling)
      : origin_(scaling.origin), frame_(scaling.frame()), factors_(scaling.factors) {}
  Vec3 forth(Vec3 p) const {
    const Vec3 v = frame_.into(p - origin_);
    return {factors_.x * v.x, factors_.y * v.y, factors_.z * v.z};
  }
  Vec3 back(Vec3 p) const {
    return origin_ + frame_.out_of({p.x / factors_.x, p.y / factors_.y, p.z / factors_.z});
  }

 private:
  Vec3 origin_;
  Frame frame_;
  Vec3 factors_;
};

/// "1 x 1 x 50 along the axes", with what that came from.
std::string describe(const Scaling& scaling);

/// Empty when the invariants above hold, else what is wrong.
std::string broken_invariant(const Scaling& scaling);

}  // namespace ballflow::geometry
