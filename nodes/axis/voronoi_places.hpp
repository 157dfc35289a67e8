// The Voronoi vertices of the boundary vertices of a union of balls: where they lie in its dual complex.
//
// Notation as in medial_axis.hpp: K, R, W, V(w).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "axis/delaunay_table.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "power/union_vertices.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// A Voronoi vertex: one or more Delaunay cells with the same circumcentre.
struct VoronoiVertex {
  enum class Place : std::uint8_t { out, in, on };  // of R; `on` a ball centre

  Place place = Place::out;
  // A ball for Place::on, whose centre this is; else (number of balls) + (lowest Delaunay cell).
  std::int32_t name = 0;
};

/// The Voronoi diagram of W with its vertices placed and named.
class VoronoiPlaces {
 public:
  /// Keeps a reference. The complex has tetrahedra.
  VoronoiPlaces(const SimplicialComplex& complex, UnionVertices sites, double size, Monitor& monitor);

  const UnionVertices& sites() const { return sites_; }
  const std::vector<DelaunayCell>& cells() const { return cells_; }
  const VoronoiVertex& vertex(std::int32_t cell) const { return vertices_[static_cast<std::size_t>(cell)]; }
  /// The circumcentre of a cell; meaningless for ball centres.
  Vec3 position(std::int32_t cell) const { return positions_[static_cast<std::size_t>(cell)]; }
  /// Voronoi vertices so close to a ball centre or to the boundary of R are on it.
  double same() const { return same_; }

  /// Whether the sphere of the ball passes through all the sites.
  bool all_on(std::int32_t ball, std::span<const std::int32_t> sites) const;
  /// How deep x, a point of the cell of w, lies in R as seen from w: positive inside, negative outside.
  double depth(std::int32_t w, Vec3 x) const;

 private:
  Vec3 center(std::int32_t ball) const { return complex_.centers[static_cast<std::size_t>(ball)]; }
  std::int32_t balls() const { return static_cast<std::int32_t>(complex_.centers.size()); }
  std::int32_t common_ball(std::span<const std::int32_t> sites) const;
  void place_cells(Monitor& monitor);
  void merge_coincident(Monitor& monitor);

  const SimplicialComplex& complex_;
  UnionVertices sites_;
  double size_;  // longest edge of the bounding box of the union
  double same_;
  std::vector<DelaunayCell> cells_;
  std::vector<VoronoiVertex> vertices_;  // one per cell
  std::vector<Vec3> positions_;          // one per cell
};

}  // namespace ballflow::geometry
