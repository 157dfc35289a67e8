// The most plausible whole shape for an observation of a part of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/shape_fit.hpp"
#include "types/shape_pose.hpp"
#include "types/shape_prior.hpp"

namespace ballflow::geometry {

struct ShapeFitOptions {
  double effective = 30;       // as many independent observations: see below
  double width = 10;           // of the first correspondences, % of the root mean square radius of the model
  bool scale = false;          // the shape may be scaled, too
  std::int64_t modes = 0;      // at most; 0: all of the model
  std::int64_t points = 2000;  // of the observation that are used, at most
  int iterations = 100;        // at most
};

/// Fits a model of a shape to points on a part of its surface: posterior mean and covariance of its scores,
/// and the pose.
///
/// Every point of the observation comes from a Gaussian around a surface point of the shape, or, as an
/// outlier, from anywhere (Myronenko and Song 2010); scores are standard normal beforehand. By turns the
/// probabilities of all pairs are taken, then scores and pose together from one least squares system, in
/// which points are drawn to tangent planes rather than to points, so that they may slide; then the width and
/// the part of outliers. Where the observation has normals, pairs with other directions are less probable.
/// Parts of the shape that nobody has seen are not drawn anywhere.
///
/// Points of one surface do not err independently: N of them tell as much as `effective` independent ones, so
/// their squares count effective / N. This keeps a few modes from explaining what they do not know; the
/// covariance is that of the tempered posterior, the pose unknown beforehand.
///
/// - `start`: from the observation to the coordinates of the model, 10 degrees and a tenth of its size or so
///   right; none: it lies there already
/// - Throws InputError for a model without surface points, and for fewer than 4 points.
/// - Warns where the observation is far from the model: most of it unexplained, a residual far above that of
///   unknown instances, scores beyond those of instances.
ShapeFit shape_fit(const ShapePrior& prior, const PointSet& observation,
                   const std::optional<ShapePose>& start, const ShapeFitOptions& options = {},
                   Monitor& monitor = no_monitor());

/// The same for balls on a part of the shape, whose centers come from Gaussians around the centers of the
/// model's balls; logarithms of radii are observed as lengths in the metric of the model. Balls below a
/// twentieth of the median radius are left out.
ShapeFit shape_fit(const ShapePrior& prior, const Balls& observation, const std::optional<ShapePose>& start,
                   const ShapeFitOptions& options = {}, Monitor& monitor = no_monitor());

/// The fitted balls, and its surface points, in the coordinates of the observation.
Balls balls_of(const ShapeFit& fit);
PointSet points_of(const ShapePrior& prior, const ShapeFit& fit);

}  // namespace ballflow::geometry
