// Whether a cloud of points is to be denoised before surfaces are made of it, and how.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/local_feature_size.hpp"
#include "types/noise_report.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

struct AssessNoiseOptions {
  bool act = true;        // false: look only
  double suspect = 0.2;   // share of uncertain poles from which on noise is looked for
  double level = 0.07;    // noise, times the distance to the third neighbour, below which there are edges
  double certain = 0.05;  // of denoised samples: fewer uncertain poles are good enough
  std::int32_t neighbors = 24;        // the first to try; then twice as many
  std::int32_t most_neighbors = 192;  // the last
};

/// The rule: fewer than `suspect` of the poles are uncertain: nothing is done. Else the deviation of the
/// samples from quadrics through 16 neighbours is looked at. Of noise all samples have some; samples of
/// shapes with sharp edges, and of sheets as thin as the spacing, have none on smooth patches, so where the
/// tenth percentile is below `level` it is edges, and nothing is done. Else samples are denoised with
/// `neighbors`, 2 neighbors, ... until fewer than `certain` are uncertain; where more neighbours leave more
/// uncertain, with those before, and in the end with `most_neighbors`. Where the first number is enough, and
/// the cloud so dense that twice as many neighbours lie within D^, twice as many are tried once, and taken
/// unless poles are uncertain then: the mean of more is nearer to the surface, and nothing that large can be
/// lost.
///
/// Without noise all labelled poles of a cloud of a smooth surface are certain but some where it is as coarse
/// as its features (15 % of a dragon of 5000 samples); with a deviation of a third of the spacing, half of
/// them are not.
///
/// - `poles`: labelled by angles, with their `uncertain` flags, and `size`: both of `sample`
/// - `before`: null for the cloud as it came; else what the rule said about it, and `sample` is denoised with
/// `before->next`
///
/// Warns where nothing is done although poles are uncertain, and where nothing was enough. Throws InputError
/// for poles and sizes of other samples, poles without flags, and options out of range.
NoiseReport assess_noise(const PointSet& sample, const PoleSet& poles, const LocalFeatureSize& size,
                         const NoiseReport* before, const AssessNoiseOptions& options,
                         Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
