// What several instances of one shape have in common: their mean and how they vary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// What distances from an instance's surface were measured to.
enum class SurfaceMeasure : std::uint8_t {
  labels,  // its balls, label by label: there were no surface points
  planes,  // the tangent planes of its nearest surface points
  meshes,  // its mesh
};

/// A point distribution model of k balls and m surface points. An instance has scores b, in standard
/// deviations: center i is centers[i] + sum_j b[j] (x, y, z of modes[j k + i]), its radius is radii[i]
/// exp(sum_j b[j] * fourth number of modes[j k + i]), point i is points[i] + sum_j b[j] point_modes[j m + i].
///
/// The metric of vectors is a mean squared displacement, squared model units: (1 - point_share) times the
/// mean over the balls of dx^2 + dy^2 + dz^2 + (radius_unit * d log r)^2, plus point_share times the mean
/// over the points of the squared displacement along the normal plus `along` times the square of the rest of
/// it.
struct ShapePrior {
  Array<Vec3> centers;  // k x 3, of the mean, model units
  Array<double> radii;  // k, above 0: geometric means
  Array<Vec3> points;   // m x 3, of the mean surface
  Array<Vec3> normals;  // m x 3, of length 1, outwards
  // The template's own surface where the mean has it: ShapeMesh. None of both where it was not given.
  Array<Vec3> vertices;       // v x 3
  Array<Triangle> triangles;  // t x 3: as in TriangleMesh
  double point_share = 0, radius_unit = 0, along = 1;

  // q modes, those of largest variance first. Signs: of the scores of a mode the one of largest absolute
  // value is positive.
  Array<std::array<double, 4>> modes;  // q k: x, y, z, log r that one standard deviation adds
  Array<Vec3> point_modes;             // q m
  Array<double> variances;             // q, descending, in the metric
  double total_variance = 0;           // of the instances; of all modes, also those that are not kept

  // The n instances, in the order in which they were given.
  Array<double> scores;  // n q, row by row, in standard deviations
  Array<std::array<double, 12>>
      poses;                // n: 3 x 4 by rows, from the coordinates of an instance to those of the model
  Array<double> distances;  // n: of the instance from the mean, root of the metric

  // How good the model is; model units. Distances with j modes, j = 0 (the mean shape), 1, ...
  Array<double> generalization;  // g: of an instance from the model of the others, mean over instances
  Array<double> generalization_deviation;  // g: standard deviation over instances
  Array<double> specificity;               // q: of random shapes with j + 1 modes from the nearest instance
  Array<double> specificity_deviation;     // q
  std::uint8_t measure = 0;                // of generalization: SurfaceMeasure
  std::uint8_t scaled = 0;                 // 1: the instances were scaled to one size

  std::size_t balls() const { return radii.size(); }
  std::size_t mode_count() const { return variances.size(); }
  std::size_t instances() const { return distances.size(); }
};

/// "the balls of the instance", "tangent planes", "meshes".
const char* in_words(SurfaceMeasure measure);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const ShapePrior& prior);

}  // namespace ballflow::geometry
