// The regular triangulation of sums of balls, made step by step, and which of them contribute.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "minkowski/sums.hpp"

namespace ballflow::geometry {

struct Contributing {
  std::vector<Ball> balls;  // in no particular order
  // Of these, have a piece of their sphere (radius 0: their point) on the boundary of the union.
  std::int64_t touching_boundary = 0;
};

/// What a triangulation is asked about its balls.
enum class Share : std::uint8_t {
  none,   // nothing
  whole,  // whether it contributes
  part,   // also who is around it, when it does: other triangulations know the rest
};

struct Shared : Contributing {  // `balls` and `touching_boundary` of share `whole`
  std::vector<Ball> parts;      // those of share `part` that contribute here
  std::vector<std::size_t> around_offsets{0};
  std::vector<Ball> around;  // the neighbors of part i are around[around_offsets[i] .. around_offsets[i + 1])
};

/// Of balls at one place the largest stays. Hidden points are forgotten: they do not contribute. Which points
/// without a cell of their own are vertices is a matter of symbolic perturbation; which contribute is not.
class PowerTriangulation {
 public:
  PowerTriangulation();
  ~PowerTriangulation();
  PowerTriangulation(const PowerTriangulation&) = delete;
  PowerTriangulation& operator=(const PowerTriangulation&) = delete;

  /// Inserts fewer than 2^31 balls, in an order that makes it fast.
  void insert(std::vector<Ball> balls, Monitor& monitor);

  /// Inserts the ball when it contributes among those that are vertices. Quick when the last one was near.
  void insert_if_contributing(const Ball& ball);

  /// Inserts the ball. Quick when the last one was near.
  void insert(const Ball& ball);

  /// False when the ball certainly contributes nothing to those inserted so far, and nothing that lies in it
  /// does. It is not inserted: its cell is asked for among the neighbours that it would have.
  bool may_contribute(const Ball& ball);

  std::size_t vertices() const;

  /// The balls that contribute among all inserted. Ends the triangulation.
  Contributing contributing(Monitor& monitor);
  Shared contributing(const std::function<Share(const Ball&)>& share, Monitor& monitor);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ballflow::geometry
