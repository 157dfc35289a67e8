// Rotations: unit quaternions as they are stored, and frames of axes as they are computed with.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// w + x i + y j + z k, of length 1: the rotation by v -> q v q*. q and -q are one rotation; w >= 0 is
/// stored.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  using scalar = double;  // how an array of them is stored: n x 4 doubles
  static constexpr std::size_t dimension = 4;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
  friend auto operator<=>(const Quaternion&, const Quaternion&) = default;
};

/// Three perpendicular vectors of length 1, right-handed: the axes of something that is turned.
struct Frame {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  /// Coordinates along the axes, and back.
  Vec3 into(Vec3 v) const { return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)}; }
  Vec3 out_of(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
};

/// The axes are the images of those of the coordinates. Exact length 1 is not needed: only the direction of q
/// counts.
inline Frame frame_of(const Quaternion& q) {
  const double s = 2 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {{Vec3{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y + q.w * q.z), s * (q.x * q.z - q.w * q.y)},
           Vec3{s * (q.x * q.y - q.w * q.z), 1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z + q.w * q.x)},
           Vec3{s * (q.x * q.z + q.w * q.y), s * (q.y * q.z - q.w * q.x), 1 - s * (q.x * q.x + q.y * q.y)}}};
}

/// The rotation that takes the axes of the coordinates to those of the frame (Shepperd 1978: by the largest
/// of its components, so that nothing cancels).
inline Quaternion quaternion_of(const Frame& frame) {
  const auto& [a, b, c] = frame.axes;  // columns of the matrix
  const double trace = a.x + b.y + c.z;
  Quaternion q;
  if (trace >= a.x && trace >= b.y && trace >= c.z) {
    q = {1 + trace, b.z - c.y, c.x - a.z, a.y - b.x};
  } else if (a.x >= b.y && a.x >= c.z) {
    q = {b.z - c.y, 1 + a.x - b.y - c.z, b.x + a.y, a.z + c.x};
  } else if (b.y >= c.z) {
    q = {c.x - a.z, b.x + a.y, 1 + b.y - a.x - c.z, c.y + b.z};
  } else {
    q = {a.y - b.x, a.z + c.x, c.y + b.z, 1 + c.z - a.x - b.y};
  }
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const double sign = q.w < 0 ? -1 : 1;
  // + 0: no component is minus zero.
  return {sign * q.w / norm + 0.0, sign * q.x / norm + 0.0, sign * q.y / norm + 0.0, sign * q.z / norm + 0.0};
}

}  // namespace ballflow::geometry
