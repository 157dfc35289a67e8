// The corners and arcs of the boundary of a union of balls, cut into chords that the patches on both sides
// share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/lists.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// A chord of the patch on the sphere of a ball: seen from outside the patch lies on the right of it.
struct Chord {
  std::int32_t from = 0, to = 0;   // points of the net
  std::int32_t arc = 0, knot = 0;  // where it is in the net: between a knot of the arc and the next one
  double sagitta = 0;              // how far it is from its arc, model units
};

/// Points on the boundary of the union, and the arcs that are cut at them. In what order points and arcs
/// come, and how they are rounded, depends on the order of the balls and not on what is left and right: balls
/// in `before` order give mirrored nets for mirrored balls.
class ArcNet {
 public:
  /// `error` in model units: no chord is farther from its arc, and none spans more than 60 degrees. Nothing
  /// where rounding hides which balls meet: two corners at the ends of an arc, or a whole circle, within
  /// 2^-44 of `extent`.
  static std::optional<ArcNet> of(const PowerDiagram& diagram, const SimplicialComplex& complex, double error,
                                  double extent, Monitor& monitor);

  const std::vector<Vec3>& points() const { return points_; }
  /// The balls, ascending, whose spheres a point lies on: two, and -1, or three.
  const std::array<std::int32_t, 3>& balls_of(std::int32_t point) const {
    return labels_[static_cast<std::size_t>(point)];
  }
  /// The arcs on the sphere of a ball.
  std::span<const std::int32_t> arcs_of(std::int32_t ball) const {
    return arcs_of_[static_cast<std::size_t>(ball)];
  }
  /// The two balls whose spheres meet in an arc.
  const std::array<std::int32_t, 2>& balls_of_arc(std::int32_t arc) const {
    return arcs_[static_cast<std::size_t>(arc)].balls;
  }
  /// The chords of an arc as the patch on the sphere of `ball` sees them.
  void add_chords(std::int32_t ball, std::int32_t arc, std::vector<Chord>& chords) const;
  /// Cuts the piece of the arc that begins at a knot in two. Numbers of the knots behind it grow by one.
  void bisect(std::int32_t arc, std::int32_t knot);

 private:
  struct Knot {
    std::int32_t point = 0;
    double angle = 0;
  };
  struct Arc {
    std::array<std::int32_t, 2> balls{};  // i < j
    bool forward = true;                  // the knots run counter-clockwise around the axis from i to j
    Vec3 middle, start, side;  // of the circle, model units: a point is middle + cos start + sin side
    double radius = 0;
    std::vector<Knot> knots;  // angles ascend from 0; of a whole circle the last point is the first
  };

  void cut(Arc& arc, double error, bool whole);
  Vec3 point_of(const Arc& arc, double angle) const;
  std::int32_t add_point(Vec3 position, std::array<std::int32_t, 3> balls);

  std::vector<Vec3> points_;
  std::vector<std::array<std::int32_t, 3>> labels_;
  std::vector<Arc> arcs_;
  Lists<std::int32_t> arcs_of_;
};

}  // namespace ballflow::geometry
