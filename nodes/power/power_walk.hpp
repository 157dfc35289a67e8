// Which power cells of a set of balls a point lies in and a segment passes through, decided exactly.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

/// The sign of the power of x to ball b less that to ball a: negative where x is nearer to b. Exact for the
/// doubles given; a weight is a squared radius.
int compare_powers(Vec3 x, Vec3 a, double weight_a, Vec3 b, double weight_b);

/// The power of x to ball i is |x - c_i|^2 - w_i; x lies in the (closed) power cells of the balls to which it
/// has the least power. A ball is a local minimum among its neighbours in the regular triangulation exactly
/// when it is a global one, because the lifted triangulation is convex; this holds for degenerate sets of
/// balls too, where CGAL breaks ties between cells symbolically.
class PowerWalk {
 public:
  /// Keeps a reference.
  explicit PowerWalk(const PowerDiagram& diagram);

  /// Any ball that is in a cell of the triangulation; -1 for no balls.
  std::int32_t any() const { return any_; }
  bool contains(std::int32_t ball) const { return !around(ball).empty() || ball == any_; }

  /// A ball in whose cell x lies, found from ball `from` of the triangulation.
  std::int32_t cell_of(Vec3 x, std::int32_t from) const;

  /// From ball `from`, in whose cell p lies, along the segment pq to a ball in whose cell q lies: visit(u, v)
  /// for every step from one cell to the next. u and v are joined by an edge of the triangulation, and there
  /// is a point of the segment in both cells; so the edge is in the dual complex when the segment is in the
  /// union.
  std::int32_t along(Vec3 p, Vec3 q, std::int32_t from,
                     const std::function<void(std::int32_t, std::int32_t)>& visit) const;

  /// From ball u to ball v, in both of whose cells x lies, over balls in whose cells x lies as well.
  void around_point(Vec3 x, std::int32_t u, std::int32_t v,
                    const std::function<void(std::int32_t, std::int32_t)>& visit) const;

  /// x lies outside of `ball`.
  bool outside(Vec3 x, std::int32_t ball) const;

 private:
  std::span<const std::int32_t> around(std::int32_t ball) const;

  const Array<Vec3>& centers_;
  const Array<double>& weights_;
  std::vector<std::size_t> begin_;       // neighbours of ball i: neighbors_[begin_[i] .. begin_[i + 1])
  std::vector<std::int32_t> neighbors_;  // ascending
  std::int32_t any_ = -1;
};

}  // namespace ballflow::geometry
