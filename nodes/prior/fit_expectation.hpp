// Which parts of a shape the points of an observation come from: the expectation step of ShapeFit.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// Columns are points; `normals` may have none.
struct OrientedPoints {
  Eigen::Matrix3Xd points, normals;
};

struct FitNoise {
  double squared_width = 1;  // of the Gaussians
  double outliers = 0.2;     // part of the observation, below 1
  double volume = 1;         // that outliers may lie in
};

/// Sums over the observation, weighted by the probability that a point comes from part i of the shape.
struct Correspondence {
  Eigen::VectorXd mass;           // of each part
  Eigen::Matrix3Xd sums;          // of points
  Eigen::VectorXd value_sums;     // of values
  std::vector<double> explained;  // of each observed point: the probability that it comes from any part
  double total = 0, squares = 0;  // of probabilities; of squared distances, weighted by them
};

/// All pairs nearer than 7 widths: time O(parts x points). In blocks, merged in order: the same bits for any
/// number of threads. `values` has a number for each observed point, or none.
Correspondence expectation(const OrientedPoints& parts, const OrientedPoints& observed,
                           const Eigen::VectorXd& values, const FitNoise& noise, Monitor& monitor);

}  // namespace ballflow::geometry
