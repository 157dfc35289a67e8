// One ellipsoid as it is asked: what lies in it, and how far something is from it.
#pragma once

#include "search/membership.hpp"
#include "types/ellipsoids.hpp"

namespace ballflow::geometry {

/// "p lies in the ellipsoid" iff (v_0 / a_0)^2 + (v_1 / a_1)^2 + (v_2 / a_2)^2 <= 1 + 2^-30, v the
/// coordinates of p - c along its axes, in double arithmetic and in the order of operations of this class.
/// The one definition behind the covering matrix of ellipsoids and its check; the slack is that of balls.
class Ellipsoid {
 public:
  Ellipsoid(const Ellipsoids& all, std::size_t i)
      : center_(all.centers[i]), radii_(all.radii[i]), frame_(frame_of(all.rotations[i])) {}
  Ellipsoid(Vec3 center, Vec3 radii, const Frame& frame) : center_(center), radii_(radii), frame_(frame) {}

  Vec3 center() const { return center_; }
  Vec3 radii() const { return radii_; }
  double shortest() const { return std::min({radii_.x, radii_.y, radii_.z}); }
  double longest() const { return std::max({radii_.x, radii_.y, radii_.z}); }

  /// Of p - c along the axes, in units of the half-axes.
  Vec3 relative(Vec3 p) const {
    const Vec3 v = frame_.into(p - center_);
    return {v.x / radii_.x, v.y / radii_.y, v.z / radii_.z};
  }
  bool contains(Vec3 p) const {
    const Vec3 u = relative(p);
    return squared_norm(u.x, u.y, u.z) <= 1 + membership_slack;
  }
  /// The image of a point of the unit ball.
  Vec3 at(Vec3 u) const { return center_ + frame_.out_of({radii_.x * u.x, radii_.y * u.y, radii_.z * u.z}); }

  /// The distance of p to the surface of the ellipsoid, negative inside. Right to 2^-42 of the longest
  /// half-axis, or of |p - c| where that is larger.
  ///
  /// The nearest point x has x_i = a_i^2 v_i / (t + a_i^2) for the one t > -min a_i^2 with x on the surface;
  /// 1 / |x / a| is a concave and rising function of t there, and nearly linear (as in trust regions, More
  /// and Sorensen 1983), so that Newton's steps approach the root from below, in few steps. They are made in
  /// u = (t + a^2) / a^2 of the shortest half-axis a, in which nothing cancels (the trouble of flat
  /// ellipsoids, and of points in their plane of symmetry, where u -> 0).
  double signed_distance(Vec3 p) const;

  /// No larger than the distance of p to the ellipsoid: that to its box along its axes.
  double distance_at_least(Vec3 p) const {
    const Vec3 v = frame_.into(p - center_);
    return std::max({std::abs(v.x) - radii_.x, std::abs(v.y) - radii_.y, std::abs(v.z) - radii_.z, 0.0});
  }

 private:
  Vec3 center_, radii_;
  Frame frame_;
};

}  // namespace ballflow::geometry
