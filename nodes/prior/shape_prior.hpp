// A statistical model of a shape from several instances of it: mean, modes of variation, and how good it is.
#pragma once

#include <cstdint>
#include <span>

#include "base/monitor.hpp"
#include "types/matched_balls.hpp"
#include "types/shape_prior.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class ModelBalls {
  carried,   // as the field of the match carried them: smooth in what differs, some may stand out
  replaced,  // balls of the instances themselves: inside, with the noise of which one was near
};

struct ShapePriorOptions {
  ModelBalls balls = ModelBalls::carried;
  bool scale = false;        // instances are scaled to one size, and differ in shape alone
  double radius_weight = 1;  // how much logarithms of radii count, in mean radii
  double point_share = 0.5;  // of the surface points in the metric, from 0 to 1; the rest is the balls'
  double along = 0.1;        // weight of what moves points along the surface, against what moves them off it
  std::int64_t modes = 0;    // at most; 0: as many as there are
  std::int64_t draws = 200;  // random shapes for the specificity; 0: neither that nor the generalization
};

/// A point distribution model (Cootes et al. 1995) of instances that were matched to one template:
/// generalized Procrustes analysis of their balls and surface points, then principal components of the
/// vectors of (x, y, z, w log r) of balls and (x, y, z) of points; see ShapePrior for the metric,
/// shape_model.hpp for how.
///
/// Evaluation (Davies 2002, Cates et al. 2007): generalization leaves out one instance after the other,
/// learns from the rest, and measures the mean distance of the surface points of the nearest model with 0, 1,
/// ..., n
/// - 2 modes from the instance's surface: its mesh where there are `meshes`, else the tangent planes of its
/// nearest surface points; without points its balls' centers, label by label. Specificity is the mean
/// distance, label by label, of random shapes with standard normal scores from the nearest instance.
///
/// - `instances`: at least two, with as many balls and points each, not all equal; `meshes`: none, or one for
///   each in the same order. Mirrored matches are mirrored back; matches without carried radii have replaced
///   balls only.
/// - The order of the instances changes the order of scores, poses and distances and nothing else; more
///   threads change nothing.
/// - Throws InputError for one instance, for other numbers of balls, for instances without any difference.
///   Warns of two equal ones, of one that fits better as its mirror image, of one that is much farther from
///   the others than they are from each other.
/// - Time O((k + m) n^2 modes) and n^2 m nearest points of meshes.
ShapePrior shape_prior(std::span<const MatchedBalls> instances, std::span<const TriangleMesh> meshes,
                       const ShapePriorOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
