// The Voronoi vertices of a sample and of far-away points around it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

/// What the poles of a sample are chosen from. Every cell of the Delaunay triangulation has a Voronoi vertex,
/// the centre of the sphere through its four sites; cells whose five and more sites are cospherical share
/// one, and one of them stands for it.
///
/// The sites are the n samples and, numbered from n on, twelve far-away points, so that every Voronoi cell of
/// a sample is bounded.
struct VoronoiDiagram {
  static constexpr std::int32_t far_count = 12;
  /// In ascending order of their coordinates, so that rounding does not depend on the numbering of the
  /// sample.
  using Sites = std::array<std::int32_t, 4>;

  Array<Vec3> samples;              // n x 3
  std::array<Vec3, far_count> far;  // the other sites

  std::vector<Sites> sites;             // per cell
  std::vector<Vec3> centers;            // per cell, equal for the cells of one Voronoi vertex
  std::vector<std::int32_t> vertex;     // per cell, the cell that stands for its Voronoi vertex
  std::vector<std::uint8_t> unbounded;  // per cell that stands for a Voronoi vertex, 1 with a far-away site

  std::size_t size() const { return sites.size(); }
  bool is_sample(std::int32_t site) const { return static_cast<std::size_t>(site) < samples.size(); }
  Vec3 point(std::int32_t site) const {
    const auto i = static_cast<std::size_t>(site);
    return i < samples.size() ? samples[i] : far[i - samples.size()];
  }
  /// Orders distinct cells by the coordinates of their sites.
  bool cell_before(std::int32_t a, std::int32_t b) const;
};

/// The far-away points are at least `bounding_distance` longest box edges from the centre of the sample's
/// bounding box. Which vertices coincide is decided exactly; centres are within about 1e-10 radii of the true
/// ones.
///
/// Refuses (InputError) samples that voronoi_poles refuses. The result does not depend on the number of
/// threads; the numbering of the cells does depend on that of the sample.
VoronoiDiagram voronoi_diagram(const PointSet& sample, double bounding_distance,
                               Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
