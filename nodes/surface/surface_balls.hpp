// Balls around the samples of a surface, as large as its local feature size allows (thesis, 4.5 and 4.7).
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/local_feature_size.hpp"
#include "types/point_set.hpp"
#include "types/surface_balls_report.hpp"

namespace ballflow::geometry {

struct SurfaceBallsOptions {
  // rho: times D^, the distance to the nearest pole. 0 chooses it: 0.56 for `shrink` up to 0.3, 0.8 from 0.6
  // on (smaller ones leave holes), and between them in proportion.
  double radius = 0;
  double shrink = 0.3;  // rho_bar: of the copies that have to cover the samples; at most rho
  // A ball is at least so many times as large as the distance to the third neighbour (thesis, 4.9.3,
  // has 1.5): where the spacing is as large as the feature size balls of radius rho D^ do not meet.
  double floor = 0.7;
  // At least this one where part of the cloud is too coarse: where at more than 2 % of the samples, and all
  // in all at no more than half of them, d3 is above 0.8 D^, and above twice its median at these 2 %.
  double uneven_floor = 0.9;
  double smallest = 0;  // and at least this, model units (the second heuristic of 4.9.3)
  // Balls by their place instead of in the order of the samples: what breaks ties by number then depends
  // neither on the order of the samples nor on a mirror.
  bool by_place = false;
};

struct SurfaceBalls {
  Balls balls;      // n, at the samples: radius max(rho D^, floor d3, smallest), each defined by its sample
  Balls shrunk;     // n, the same times rho_bar / rho; ball i is defined by point i of `points`
  PointSet points;  // n x 3: the centres, which the shrunken balls cover
  SurfaceBallsReport report;
};

/// Ball i is that of sample i, unless balls are ordered `by_place`. Then equal balls whose centres are images
/// of each other in coordinate planes are the only ones whose order a mirror changes.
///
/// d3 is the distance to the third nearest other sample, of the whole sample.
///
/// Theorem 4.14 as printed exchanges the balls of two samples. Repaired it proves, for sufficiently dense
/// samples, rho_bar <= .020 at rho = .24, .0315 at .30, .025 at .35, and nothing above about .39; between
/// these values the bound here is linear. Raised balls are outside of what it says, and so are radii from
/// fewer poles than all: the regime is then heuristic.
///
/// Warns where at more than half of the samples d3 is above 0.8 D^, and where at more than 2 % it is, and
/// above twice its median, too.
///
/// Throws InputError for a `shrink` above `radius` and options out of range.
SurfaceBalls surface_balls(const LocalFeatureSize& size, const SurfaceBallsOptions& options,
                           Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
