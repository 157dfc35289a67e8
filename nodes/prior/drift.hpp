// Coherent point drift: points of a template move smoothly onto those of an instance.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Points that look for partners among points of the same kind only.
struct DriftGroup {
  std::size_t first = 0, count = 0;      // of the template's points
  std::span<const Vec3> normals;         // of these, one for each, or none
  std::span<const Vec3> targets;         // of the instance
  std::span<const Vec3> target_normals;  // one for each, or none
  bool planes = false;                   // distances along the target's normals count; needs target normals
};

struct DriftOptions {
  double width = 2;       // of the kernel: how far a displacement reaches
  double stiffness = 30;  // how much smoothness counts: lambda of the literature
  double outliers = 0.1;  // share of the targets that have no counterpart, in [0, 1)
  double start = 0.1;     // standard deviation of the distances to begin with
  double normals = 0.7;   // normals of pairs differ by so much: 1 - n.n' at which their weight is 1/e
  double across = 0.01;   // of planes: what a distance along the plane counts, beside 1 across
  int most_steps = 60;
  double stop = 1e-3;  // relative change of the variance
  std::size_t most_rank = 150;
};

struct Drift {
  std::vector<Vec3> points;   // where the template's points came to
  std::vector<Vec3> normals;  // of the targets they were drawn to, for groups with target normals; else 0
  double deviation = 0;       // root of the variance of distances in the end
  int steps = 0;
};

/// Expectation maximisation: every target is a sample of a mixture of Gaussians around the moved points of
/// its group, all of one variance, and uniform noise; the field that moves them is smooth in the norm of a
/// Gaussian kernel, at low rank. Lengths are to be about 1: divide by the radius of the shape.
///
/// - template and targets are aligned already: the variance begins with `start`, not with the mean distance
/// - points of the template that belong to no group are moved along
///
/// Same bytes for any number of threads. [Myronenko and Song 2010]
Drift drift(std::span<const Vec3> points, std::span<const DriftGroup> groups, const DriftOptions& options,
            Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
