// Which sums of discs contribute: the regular triangulation of sums in the plane, in bulk and one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "minkowski/power_triangulation.hpp"
#include "minkowski/sums.hpp"

namespace ballflow::geometry {

/// As PowerTriangulation, of balls with z = 0; begins with three whose centers are not on one line.
class PlaneSums {
 public:
  PlaneSums(const Ball& a, const Ball& b, const Ball& c);
  ~PlaneSums();
  PlaneSums(const PlaneSums&) = delete;
  PlaneSums& operator=(const PlaneSums&) = delete;

  /// Inserts fewer than 2^31 balls, in an order that makes it fast.
  void insert(std::vector<Ball> balls, Monitor& monitor);
  /// Inserts the ball. Quick when the last one was near.
  void insert(const Ball& ball);

  /// False when the ball certainly contributes nothing to those inserted so far, and nothing that lies in it
  /// does. It is not inserted: its cell is asked for among the neighbours that it would have.
  bool may_contribute(const Ball& ball);

  std::size_t vertices() const;

  /// The balls that contribute among all inserted; `touching_boundary` have an arc, for radius 0 their point,
  /// on the boundary of the union. Ends the triangulation.
  Contributing contributing(Monitor& monitor);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ballflow::geometry
