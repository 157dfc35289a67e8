// Which vertex of a surface every sample belongs to (thesis, 4.5.3).
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/sample_assignment.hpp"
#include "types/surface_report.hpp"

namespace ballflow::geometry {

/// Every sample belongs to the ball to which it has the least power, |p - c|^2 - r^2, the one with the lower
/// index where several have the same. Powers are compared exactly (with r^2 as it is rounded, as in
/// PowerDiagram), so this is the assignment by the power diagram; it is searched in a tree and needs none.
///
/// - `balls`: the kept surface balls, at least one
/// - `sample`: n points, usually all samples
/// - `surface`: the report of the surface through these balls, or null. A few balls are no vertex of it (the
///   surface passes them by, or a speck was left out): `vertices` looks at the others alone. Of several
///   vertices with one ball, where sheets touch, it has the first.
///
/// - `original`: n points that the result lists in place of the samples (where these were before they were
/// denoised), or null
///
/// Throws InputError without balls, for another number of originals, for a report of other balls, and for a
/// surface without vertices.
SampleAssignment assign_samples(const Balls& balls, const PointSet& sample, const SurfaceReport* surface,
                                const PointSet* original = nullptr, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
