// One-sided distances between a surface and the boundary of a union, from samples of both.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "measure/blocks.hpp"
#include "measure/boundary_samples.hpp"
#include "measure/surface_samples.hpp"
#include "types/comparison.hpp"

namespace ballflow::geometry {

inline constexpr std::size_t samples_in_task = 128;

/// Largest and weighted mean values, summed in a fixed order.
struct Tally {
  double at_least = 0, value = 0, at_most = 0;  // the largest distance of a sample, and bounds of it
  double outside = 0, weight = 0, sum = 0, covered = 0;

  void add(const Tally& more) {
    at_least = std::max(at_least, more.at_least);
    value = std::max(value, more.value);
    at_most = std::max(at_most, more.at_most);
    outside = std::max(outside, more.outside);
    weight += more.weight;
    sum += more.sum;
    covered += more.covered;
  }
  double mean() const { return weight > 0 ? sum / weight : value; }
};

inline Tally merged(const std::vector<Tally>& parts) {
  Tally all;
  for (const Tally& part : parts) all.add(part);
  return all;
}

/// From the samples of the surface to the boundary of the union, whose depth(p) is minus how deep p is in
/// one piece of it.
template <class Union>
Tally from_surface(const ComparedSurface& surface, const Union& all, const BoxTree& boundary,
                   const std::vector<Vec3>& on_boundary, double spacing, double tolerance, Monitor& monitor) {
  const auto of_sample = [&](Vec3 p, double area) {
    const double depth = all.depth(p);
    Tally tally{std::abs(depth), depth, depth, std::max(depth, 0.0), area, 0, depth <= tolerance ? area : 0};
    if (depth < 0) {
      // The ball in which p is deepest has no boundary of the union in it; where there is a sample little
      // farther than that the boundary is taken to be there. Near the centre of a ball all samples on it are
      // about as near, and searching for the nearest would take as long as looking at all.
      const double near = -depth + spacing / 16;
      const double nearest = boundary.smallest(p, std::numeric_limits<double>::infinity(), near,
                                               [&](std::size_t k) { return distance(p, on_boundary[k]); });
      tally.value = nearest < near ? -depth : nearest;
      tally.at_most = std::max(nearest, near);
    }
    tally.sum = area * tally.value;
    return tally;
  };
  return merged(
      by_blocks<Tally>(surface.samples(), samples_in_task, monitor, [&](auto first, auto last, Tally& tally) {
        surface.for_samples(first, last, [&](Vec3 p, double area) { tally.add(of_sample(p, area)); });
      }));
}

/// From the samples of the boundary of the union to the surface.
inline Tally from_union(const BoundarySamples& boundary, const ComparedSurface& surface, bool has_area,
                        Monitor& monitor) {
  return merged(
      by_blocks<Tally>(boundary.size(), samples_in_task, monitor, [&](auto first, auto last, Tally& tally) {
        for (std::size_t k = first; k < last; ++k) {
          const double d = surface.distance_to(boundary.positions[k]);
          const bool on = boundary.on_boundary[k] != 0;
          const double area = !on ? 0 : has_area ? boundary.areas[k] : 1;
          tally.add({on ? d : 0, on ? d : 0, d, 0, area, area * d, 0});
        }
      }));
}

/// What the samples say, with their spacing, which result.spacing holds, and tolerance.
inline void put_distances(Comparison& result, const Tally& of_surface, const Tally& of_union, bool cloud,
                          double tolerance) {
  result.surface_to_union = {of_surface.at_least, of_surface.value,
                             of_surface.at_most + (cloud ? 0 : result.spacing), of_surface.mean()};
  result.union_to_surface = {of_union.at_least, of_union.value, of_union.at_most + result.spacing,
                             of_union.mean()};
  result.coverage = of_surface.weight > 0 ? std::min(1.0, of_surface.covered / of_surface.weight)
                                          : (of_surface.outside > tolerance ? 0.0 : 1.0);
  result.uncovered = of_surface.outside > tolerance ? of_surface.outside : 0;
}

}  // namespace ballflow::geometry
