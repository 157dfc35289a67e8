// Samples of a noisy surface, moved onto quadrics through their neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

struct DenoiseOptions {
  std::int32_t neighbors = 48;  // at most; the sample itself is one of them
  std::int32_t rounds = 2;      // each from the points of the round before
};

struct Denoised {
  PointSet points;  // n, in the order of the samples
  // n: how far the neighbours of each sample are from its quadric in the last round, as a deviation; 0 for
  // samples that were left where they were.
  std::vector<double> deviations;
};

/// Every sample goes to the point above it on a quadric: in the frame of the principal axes of its k nearest
/// samples, h = a + b u + c v + d u^2 + e u v + f v^2 is fitted to them by least squares, with Gaussian
/// weights of half the distance to the k-th, and the sample moves by a along h (moving least squares, Levin
/// 2003, in one step). Curvature stays, unlike with averages; what is smaller than the neighbourhood goes.
///
/// k doubles from a quarter of `neighbors`, at least 16, up to `neighbors` as long as the deviation from the
/// quadric is at most 1.5 times that of so few, averaged over these: beyond a thin sheet or an edge the
/// neighbours do not fit one quadric any more, while of noise a larger neighbourhood has no more than a small
/// one. With one k for all samples, thin limbs of noisy shapes melt.
///
/// - samples stay pairwise distinct: those that would meet in one place stay where they are
/// - a sample whose neighbours lie on a line or in few places, or that would move farther than the k-th
///   neighbour, stays
/// - neighbours at equal distances are taken in the order of their coordinates: the result does not depend on
///   the order of samples, nor on the number of threads
/// - normals of `sample` are left out: they are those of the noise
///
/// Throws InputError for options out of range (k from 8 to 1000, rounds from 1 to 100).
Denoised denoise(const PointSet& sample, const DenoiseOptions& options, Monitor& monitor = no_monitor());

/// n: for each sample the deviation of its 16 nearest samples from a quadric through them, corrected for what
/// the fit takes away; 0 where there is no quadric.
std::vector<double> local_noise(const PointSet& sample, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
