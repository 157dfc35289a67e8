// The Voronoi vertices of the boundary vertices of a union of balls: where they lie in its dual complex.
//
// Notation as in medial_axis.hpp: K, R, W, V(w).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "axis/delaunay_table.hpp"
#include "axis/grown_sites.hpp"
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
  virtual ~VoronoiPlaces() = default;
  VoronoiPlaces(const VoronoiPlaces&) = delete;
  VoronoiPlaces& operator=(const VoronoiPlaces&) = delete;

  const UnionVertices& sites() const { return sites_; }
  const std::vector<DelaunayCell>& cells() const { return cells_; }
  const VoronoiVertex& vertex(std::int32_t cell) const { return vertices_[static_cast<std::size_t>(cell)]; }
  /// The circumcentre of a cell; meaningless for ball centres.
  Vec3 position(std::int32_t cell) const { return positions_[static_cast<std::size_t>(cell)]; }

  /// Whether the sphere of the ball passes through all the sites.
  bool all_on(std::int32_t ball, std::span<const std::int32_t> sites) const;
  /// Where the centroid of centres of balls lies, a point of the facet between w0 and w1; `on`: so close to
  /// the boundary of R that rounding alone may part them.
  virtual VoronoiVertex::Place place_of_centroid(std::int32_t w0, std::int32_t w1,
                                                 std::span<const std::int32_t> balls) const = 0;
  /// Whether the centre of ball a is nearer to the Voronoi vertex of a cell than the centre of b. The three
  /// lie on a line.
  virtual bool nearer(std::int32_t a, std::int32_t b, std::int32_t cell) const = 0;
  /// Whether w0 and w1 are one point but for rounding.
  virtual bool coincide(std::int32_t w0, std::int32_t w1) const = 0;

 protected:
  /// Keeps a reference.
  explicit VoronoiPlaces(const SimplicialComplex& complex) : complex_(complex) {}

  Vec3 center(std::int32_t ball) const { return complex_.centers[static_cast<std::size_t>(ball)]; }
  std::int32_t balls() const { return static_cast<std::int32_t>(complex_.centers.size()); }
  std::int32_t common_ball(std::span<const std::int32_t> sites) const;

  const SimplicialComplex& complex_;
  UnionVertices sites_;
  std::vector<DelaunayCell> cells_;
  std::vector<VoronoiVertex> vertices_;  // one per cell
  std::vector<Vec3> positions_;          // one per cell
};

/// Places from sites in doubles: those that rounding may have parted were merged, and Voronoi vertices so
/// close to each other, to a ball centre or to the boundary of R that rounding alone may part them are one,
/// or on it. Right where everything else is farther apart.
class RoundedPlaces final : public VoronoiPlaces {
 public:
  /// Keeps a reference. The complex has tetrahedra; `size` is the longest edge of the bounding box of the
  /// union.
  RoundedPlaces(const SimplicialComplex& complex, UnionVertices sites, double size, Monitor& monitor);

  VoronoiVertex::Place place_of_centroid(std::int32_t w0, std::int32_t w1,
                                         std::span<const std::int32_t> balls) const override;
  bool nearer(std::int32_t a, std::int32_t b, std::int32_t cell) const override;
  bool coincide(std::int32_t, std::int32_t) const override { return false; }  // they were merged

 private:
  double depth(std::int32_t w, Vec3 x) const;
  void place_cells(Monitor& monitor);
  void merge_coincident(Monitor& monitor);

  double size_;
  double same_;  // Voronoi vertices so close to each other, to a ball centre or to the boundary of R are one,
                 // or on it
};

/// Places from the sites of grown balls: nothing is a tie and no decision is rounded, however close things
/// are.
class GrownPlaces final : public VoronoiPlaces {
 public:
  /// Keeps references. The complex has tetrahedra; `size` is the longest edge of the bounding box of the
  /// union.
  GrownPlaces(const SimplicialComplex& complex, const GrownSites& sites, double size, Monitor& monitor);

  VoronoiVertex::Place place_of_centroid(std::int32_t w0, std::int32_t w1,
                                         std::span<const std::int32_t> balls) const override;
  bool nearer(std::int32_t a, std::int32_t b, std::int32_t cell) const override;
  bool coincide(std::int32_t w0, std::int32_t w1) const override;

 private:
  const GrownSites& grown_;
  double size_;
};

}  // namespace ballflow::geometry
