// An instance of a model of a shape.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/shape_prior.hpp"

namespace ballflow::geometry {

/// Numbers with commas between them, also as a JSON list: "2,-1", "[2, -1]"; an empty text is none. Throws
/// InputError for what is no number, or not finite.
std::vector<double> parse_scores(std::string_view text);

/// The balls of the mean plus `scores` standard deviations of the first modes, in the coordinates of the
/// model; see ShapePrior. Throws InputError for more scores than modes, and for balls that are not finite.
Balls shape_instance(const ShapePrior& prior, std::span<const double> scores);

/// Its surface points, all of them in the order of the model.
std::vector<Vec3> labelled_instance_points(const ShapePrior& prior, std::span<const double> scores);

/// Its surface points, without normals; those that coincide with an earlier one are left out.
PointSet instance_points(const ShapePrior& prior, std::span<const double> scores);

}  // namespace ballflow::geometry
