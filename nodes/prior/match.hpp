// The balls of a template on another shape of its kind.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/matched_balls.hpp"
#include "types/point_set.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

enum class MatchTo {
  planes,  // distances along a surface hardly count: samples of a flat face lie where they lie
  points,  // distances count the same in all directions
};

struct MatchOptions {
  double width = 2;       // of the smoothing kernel, by the radius of the template's samples
  double stiffness = 30;  // how much smoothness counts beside distances
  MatchTo to = MatchTo::planes;
  double outliers = 0.1;  // share of the instance that has no counterpart, below 1
  double start = 0.1;     // deviation of the distances after alignment, by the radius of the template
  double reach =
      0.04;  // farther than this from the instance's own balls, by its diagonal, there is no partner
  // Of the instance's own balls, evenly chosen, that draw the template's centers besides what samples do.
  // They help where distances count the same in all directions; with planes samples alone are more exact.
  std::int64_t centers = 0;
};

/// Balls of a template as their own shape has them before they grew: for each of `balls` the center and
/// radius of the nearest of `inner`, the template's inner balls. Balls with less than a twentieth of the
/// median radius are left out (such were put in for samples that no other ball reaches), and all but the
/// first of those that come to one ball.
///
/// Throws InputError where there are no balls, or no inner ones.
Balls template_balls(const Balls& balls, const Balls& inner);

/// The balls and points of the template, carried to the instance by coherent point drift of surface samples
/// and of centers, then replaced by the nearest of the instance's own balls in (x, y, z, r).
///
/// - `balls`: k >= 1, radii above 0, those of template_balls; `points`: m >= 4 samples of the template's
///   surface, with normals
/// - `samples`: of the instance, n >= 4, with normals; `inner`: its own inner balls before they grow, of
/// which
///   those with less than a twentieth of the median radius are left out
/// - `pose`: from the instance to the template, good to a few degrees (align)
/// - warns where the instance has fewer balls than the template, and where a fifth has no partner
///
/// Throws InputError for empty input, missing normals and radii of 0. [Myronenko and Song 2010]
MatchedBalls match(const Balls& balls, const PointSet& points, const PointSet& samples, const Balls& inner,
                   const ShapePose& pose, const MatchOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
