// The balls and surface points of a template, found again on one instance of the same kind of shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"
#include "types/balls.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

/// k balls in the order of the template's balls, and m surface points in the order of the template's points:
/// ball i, or point j, of every instance that was matched to one template means the same place of the
/// anatomy. Everything is IN THE INSTANCE'S OWN COORDINATES and model units, not in those of the template;
/// pose_of() leads from the instance to the template.
///
/// What statistics need lies here: the labelled points for Procrustes analysis are `points` (and `centers`),
/// the vector of an instance is `centers` with `radii`, and pose_of() is a first transform into a common
/// frame, already refined with the labels. Distances from the instance's surface are measured on its mesh,
/// which goes beside this artifact in a list of its own in the same order; `samples` are what the match
/// itself saw of the surface, and stand in for it where there is no mesh.
struct MatchedBalls {
  // k balls. Each is one of the instance's own balls (inside by construction) where it has a partner;
  // where it has none, center and radius are what the template's ball was carried to.
  Array<Vec3> centers;  // k x 3, finite
  Array<double> radii;  // k, above 0
  // k x 3 and k (or none): the template's balls as the smooth field carried them, before a partner was looked
  // for. Radii keep their proportion to the distances of the carried surface points that are nearest. Without
  // the noise of one shape's poles beside another's, and so what statistics should take; but in thin parts
  // they may stand out of the instance.
  Array<Vec3> carried;
  Array<double> carried_radii;
  Array<double> residuals;       // k: from the carried ball to its partner, in (x, y, z, r); 0 without one
  Array<std::uint8_t> partners;  // k: 1, or 0: no ball of the instance is near enough
  Array<std::uint8_t>
      unique;  // k: 1, or 0: another ball of the template has the same partner, or there is none

  // m points on the surface, carried from those of the template.
  Array<Vec3> points;             // m x 3, finite
  Array<Vec3> normals;            // m x 3, of length 1, outwards: of the instance's surface there
  Array<double> point_residuals;  // m: from the instance's surface as its samples tell, >= 0

  // n samples of the instance's surface.
  Array<Vec3> samples;         // n x 3
  Array<Vec3> sample_normals;  // n x 3, of length 1, outwards

  // x -> scale * rotation * x + translation from the instance to the template, by the labelled points.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // as in ShapePose
  double scale = 1;
  Vec3 translation;             // model units of the template
  std::uint8_t similarity = 0;  // 1: the scale was free
  std::uint8_t mirrored = 0;    // 1: the instance is mirrored on its way to the template
  double diagonal = 0;          // of the bounding box of the instance's samples, model units

  std::size_t size() const { return radii.size(); }
};

/// From the instance to the template; without residuals.
ShapePose pose_of(const MatchedBalls& matched);

/// Centers and radii.
Balls balls_of(const MatchedBalls& matched);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const MatchedBalls& matched);

}  // namespace ballflow::geometry
