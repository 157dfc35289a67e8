// How good a model of a shape is: whether it knows instances that it has not seen, and nothing else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prior/shape_model.hpp"
#include "types/shape_prior.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A mean and its standard deviation for 0, 1, ... modes, model units.
struct ModeCurve {
  std::vector<double> mean, deviation;
};

/// The surface of an instance, for distances from it; `mesh` is null where there is none.
struct InstanceSurface {
  const MatchedBalls* matched = nullptr;
  const TriangleMesh* mesh = nullptr;
};

/// To what distances from these surfaces are measured: to meshes if all have one.
SurfaceMeasure measure_of(std::span<const InstanceSurface> surfaces);

/// Leave one out: the mean distance of the surface points of the model of the others, next to an instance
/// label by label, from the surface of the instance. Modes from 0 to as many as every one of these models
/// has. Instances one beside the other on several threads, sums in their order.
ModeCurve generalization(std::span<const LabelledShape> instances, std::span<const InstanceSurface> surfaces,
                         const ShapeModelOptions& options, Monitor& monitor);

/// The mean distance, label by label, of random shapes with 1, 2, ... modes from the nearest instance:
/// `draws` of them, with standard normal scores. Of the points, or of the balls' centers where there are
/// none.
ModeCurve specificity(std::span<const LabelledShape> instances, const ShapeModel& model, std::int64_t draws,
                      Monitor& monitor);

}  // namespace ballflow::geometry
