// What of a medial axis is there for rounding alone is taken away, as far as its homotopy type stays.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "axis/voronoi_facets.hpp"
#include "base/monitor.hpp"

namespace ballflow::geometry {

struct TidyOptions {
  std::int32_t balls = 0;  // names below are centres of balls, which stay
  /// Whether two corners that share a side are one place but for rounding.
  std::function<bool(std::int32_t, std::int32_t)> same;
};

/// Two kinds of steps, each a homotopy equivalence, until none is left:
/// - a piece marked as needless that hangs on the rest with all but one run of its sides goes, with these
/// sides (a
///   collapse);
/// - two corners that are the same, not both of them balls, become one, where whatever is at both of them is
/// a
///   triangle (a contraction of their side, under the link condition): the ball, else the lower name.
/// `edges` are the edges in no piece.
void tidy_pieces(std::vector<AxisPiece>& pieces, std::span<const std::array<std::int32_t, 2>> edges,
                 const TidyOptions& options, Monitor& monitor);

}  // namespace ballflow::geometry
