#include "topology/listing_3_2.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "power/alpha_shape.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// B_T and what the boundary of its union looks like. The ball that was inserted last is the last one.
struct Boundary {
  Boundary(const Balls& all, std::span<const std::int32_t> ids, Monitor& monitor)
      : Boundary(power_diagram(select(all, ids), {}, monitor), monitor) {}
  Boundary(const PowerDiagram& diagram, Monitor& monitor)
      : complex(alpha_shape(diagram, monitor)), corners(exposed_sides(complex, diagram, monitor)) {}

  bool contains(std::int32_t ball, Vec3 x) const {
    const Vec3 d = x - complex.centers[at(ball)];
    return dot(d, d) <= complex.weights[at(ball)];
  }
  /// The centre of ball b is not in all of `balls`.
  bool critical(std::int32_t b, std::initializer_list<std::int32_t> balls) const {
    return std::any_of(balls.begin(), balls.end(),
                       [&](std::int32_t i) { return !contains(i, complex.centers[at(b)]); });
  }

  SimplicialComplex complex;
  std::vector<ExposedSide> corners;
};

/// A point of the circle in which two spheres meet.
Vec3 circle_point(const SimplicialComplex& complex, std::int32_t i, std::int32_t j) {
  const Vec3 axis = complex.centers[at(j)] - complex.centers[at(i)];
  const double squared = dot(axis, axis);
  const double t = (squared + complex.weights[at(i)] - complex.weights[at(j)]) / (2 * squared);
  const Vec3 side = std::abs(axis.x) <= std::abs(axis.y) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(axis, side);
  const double radius = std::sqrt(std::max(0.0, complex.weights[at(i)] - t * t * squared));
  return complex.centers[at(i)] + t * axis + (radius / length(across)) * across;
}

/// Whether the insertion of its last ball, which made `after` of `before`, had to do with critical
/// intersections. Arcs that the ball crosses become corners on its sphere, arcs that it covers have corners
/// in it or are whole circles.
bool changes_critically(const Boundary& before, const Boundary& after) {
  const auto b = static_cast<std::int32_t>(after.complex.centers.size()) - 1;
  for (const ExposedSide& corner : before.corners) {
    const auto [i, j, k] = before.complex.triangles[at(corner.triangle)];
    if (after.contains(b, boundary_vertex(before.complex, corner)) && after.critical(b, {i, j, k}))
      return true;
  }
  for (std::size_t e = 0; e < before.complex.edges.size(); ++e) {
    if (before.complex.edge_classes[e] != static_cast<std::uint8_t>(SimplexClass::singular)) continue;
    const auto [i, j] = before.complex.edges[e];
    if (after.contains(b, circle_point(before.complex, i, j)) && after.critical(b, {i, j})) return true;
  }
  for (const ExposedSide& corner : after.corners) {
    const auto [i, j, k] = after.complex.triangles[at(corner.triangle)];
    if (k == b && after.critical(b, {i, j})) return true;
  }
  for (std::size_t e = 0; e < after.complex.edges.size(); ++e) {
    if (after.complex.edge_classes[e] == static_cast<std::uint8_t>(SimplexClass::interior)) continue;
    const auto [i, j] = after.complex.edges[e];
    if (j == b && after.critical(b, {i})) return true;
  }
  return false;
}

}  // namespace

std::vector<std::int32_t> listing_3_2(const Balls& balls, std::span<const std::int32_t> kept,
                                      Monitor& monitor) {
  std::vector<std::int32_t> star(kept.begin(), kept.end()), returned;
  for (;;) {
    std::vector<std::int32_t> ids = star;
    std::int32_t critical = -1;
    Boundary before(balls, ids, monitor);
    for (std::int32_t b = 0; at(b) < balls.size() && critical < 0; ++b) {
      if (std::binary_search(star.begin(), star.end(), b)) continue;
      ids.push_back(b);
      Boundary after(balls, ids, monitor);
      if (changes_critically(before, after)) critical = b;
      before = std::move(after);
    }
    if (critical < 0) break;
    returned.push_back(critical);
    star.insert(std::lower_bound(star.begin(), star.end(), critical), critical);
  }
  std::sort(returned.begin(), returned.end());
  return returned;
}

}  // namespace ballflow::geometry
