// Which of several shapes stands for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

struct ChooseTemplateOptions {
  std::int64_t instance = -1;  // this one, from 0 on; -1: the medoid
};

/// How a shape's pairs of points are spread: quantiles of the distances of all pairs of a few hundred evenly
/// chosen points, by their root mean square. It does not depend on pose and scale, and mirror images have the
/// same. [Osada et al. 2002, D2]
std::vector<double> distance_quantiles(std::span<const Vec3> points, Monitor& monitor = no_monitor());

/// The index of the medoid: the shape on which all others lie best, aligned roughly in pairs, by the sum of
/// residuals; of equal ones the first. Of more than two dozen shapes those whose quantiles are the most usual
/// are looked at. Or the one that is asked for. The order of the shapes does not matter but for equal sums.
///
/// Warns of shapes that are equal but for pose and size. Throws InputError for no shapes, an index that is
/// none, and a shape with fewer than 4 points or all at one place.
std::size_t choose_template(std::span<const PointSet> shapes, const ChooseTemplateOptions& options,
                            Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
