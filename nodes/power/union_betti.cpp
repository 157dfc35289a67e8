#include "power/union_betti.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "exact/ball_predicates.hpp"
#include "power/alpha_shape.hpp"
#include "power/complex_flags.hpp"
#include "power/regular_cells.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Counts the simplices of a dual complex in a triangulation with cells. Edges are counted by those that are
/// not in the complex: a triangulation of the sphere with v vertices and c cells has v + c edges. So nothing
/// is walked around where the complex is thick, and hardly any predicate is needed.
class Count {
 public:
  Count(const CellTable& table, std::span<const std::uint8_t> in_complex, const BallPredicates& predicates,
        std::size_t balls, Monitor& monitor)
      : table_(table),
        in_complex_(in_complex),
        predicates_(predicates),
        monitor_(monitor),
        components_(balls),
        state_(balls, hidden) {}

  std::array<std::int64_t, 3> betti() {
    count_cells_and_facets();
    count_edges();
    count_vertices();
    const std::int64_t euler = vertices_ - edges_ + triangles_ - tetrahedra_;
    const std::int64_t b0 = vertices_ - joins_;
    return {b0, b0 + cavities_ - euler, cavities_};
  }

 private:
  enum State : std::uint8_t { hidden, alone, joined, attached };  // of a ball

  bool whole(std::size_t c) const { return (in_complex_[c] & PowerDiagram::whole) != 0; }
  bool open(std::size_t c, std::size_t k) const { return (in_complex_[c] >> k & 1) == 0; }
  void step(double from, double part, std::size_t c) {
    if (c % 4096 == 0)
      monitor_.step(from + part * static_cast<double>(c) / static_cast<double>(table_.size()));
  }
  void join(std::int32_t u, std::int32_t v) {
    joins_ += components_.join(u, v) ? 1 : 0;
    state_[at(u)] = state_[at(v)] = joined;
  }

  void count_cells_and_facets() {
    DisjointSets voids(table_.size());
    cavities_ = -1;  // the outer void is none
    for (std::size_t c = 0; c < table_.size(); ++c) {
      step(0, 0.5, c);
      const auto& cell = table_.cells[c];
      for (const std::int32_t ball : cell) {
        if (ball >= 0 && state_[at(ball)] == hidden) state_[at(ball)] = alone;
      }
      if (whole(c)) {
        ++tetrahedra_;
        for (std::size_t k = 1; k < 4; ++k) join(cell[0], cell[k]);
      } else {
        ++cavities_;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t n = table_.neighbors[c][k];
        if (at(n) < c) continue;
        if (open(c, k)) {
          cavities_ -= voids.join(static_cast<std::int32_t>(c), n) ? 1 : 0;
          continue;
        }
        ++triangles_;
        if (whole(c) || whole(at(n))) continue;
        for (std::size_t i = 2; i < 4; ++i) join(cell[(k + 1) & 3], cell[(k + i) & 3]);
      }
    }
  }

  /// Calls visit(ball or infinite) for the corner ahead of every cell around the edge of corners a and b of
  /// cell `first`, until it returns false; `leaves` is given to it too: whether the facet with that corner is
  /// in the complex.
  template <class Visit>
  void around(std::size_t first, std::size_t a, std::size_t b, const Visit& visit) const {
    const std::int32_t u = table_.cells[first][a], v = table_.cells[first][b];
    std::size_t cell = first, behind = 0;
    while (behind == a || behind == b) ++behind;
    std::int32_t ahead = table_.cells[first][6 - a - b - behind];
    do {
      const bool in = (in_complex_[cell] >> behind & 1) != 0;
      const std::size_t next = at(table_.neighbors[cell][behind]);
      if (!visit(next, ahead, in)) return;
      const auto& corners = table_.cells[next];
      std::size_t fresh = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (corners[k] == ahead) {
          behind = k;
        } else if (corners[k] != u && corners[k] != v) {
          fresh = k;
        }
      }
      ahead = corners[fresh];
      cell = next;
    } while (cell != first);
  }

  /// Edges in no triangle of the complex, each at the first of its cells.
  void count_edges() {
    edges_ = static_cast<std::int64_t>(table_.size()) + 1;
    edges_ += static_cast<std::int64_t>(state_.size()) - std::count(state_.begin(), state_.end(), hidden);
    for (std::size_t c = 0; c < table_.size(); ++c) {
      step(0.5, 0.4, c);
      if (whole(c)) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) {
          // The facets at the edge lie opposite the two other corners.
          const std::size_t other = a == 0 ? (b == 1 ? 2 : 1) : 0;
          if (open(c, other) && open(c, 6 - a - b - other)) meet_edge(c, a, b);
        }
      }
    }
  }
  void meet_edge(std::size_t c, std::size_t a, std::size_t b) {
    bool first = true, in = false;
    around(c, a, b, [&](std::size_t next, std::int32_t, bool facet_in) {
      in = facet_in;
      first = next >= c;
      return first && !in;
    });
    if (!first || in) return;
    // Predicates see ascending balls, as everywhere.
    std::array<std::int32_t, 2> edge{table_.cells[c][a], table_.cells[c][b]};
    if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
    if (edge[0] != PowerDiagram::infinite && predicates_.meets(edge)) {
      around(c, a, b, [&](std::size_t, std::int32_t ball, bool) {
        return in = ball == PowerDiagram::infinite || !predicates_.attaches(edge, ball);
      });
    }
    if (in) {
      join(edge[0], edge[1]);
    } else {
      --edges_;
    }
  }

  /// Weights are not negative, so a ball without edges in the complex is a vertex unless a neighbour attaches
  /// it.
  void count_vertices() {
    if (std::find(state_.begin(), state_.end(), alone) != state_.end()) {
      for (const auto& cell : table_.cells) {
        for (const std::int32_t u : cell) {
          if (u < 0 || state_[at(u)] != alone) continue;
          const bool out = std::any_of(cell.begin(), cell.end(), [&](std::int32_t v) {
            return v >= 0 && v != u && predicates_.attaches(u, v);
          });
          if (out) state_[at(u)] = attached;
        }
      }
    }
    vertices_ =
        std::count(state_.begin(), state_.end(), alone) + std::count(state_.begin(), state_.end(), joined);
  }

  const CellTable table_;
  std::span<const std::uint8_t> in_complex_;
  const BallPredicates& predicates_;
  Monitor& monitor_;
  DisjointSets components_;          // of balls
  std::vector<std::uint8_t> state_;  // of balls
  std::int64_t vertices_ = 0, edges_ = 0, triangles_ = 0, tetrahedra_ = 0;
  std::int64_t joins_ = 0, cavities_ = 0;
};

}  // namespace

std::array<std::int64_t, 3> union_betti(const PowerDiagram& diagram, Monitor& monitor) {
  if (diagram.dimension < 3) return alpha_shape(diagram, monitor).betti;  // flat sets are small
  const BallPredicates predicates(diagram.centers, diagram.weights);
  return Count(diagram, diagram.in_complex, predicates, diagram.centers.size(), monitor).betti();
}

std::array<std::int64_t, 3> union_betti(const Balls& balls, AlphaTolerance tolerance, Monitor& monitor) {
  PartMonitor triangulating(monitor, 0, 0.8), flagging(monitor, 0.8, 0.9), counting(monitor, 0.9, 1);
  const std::vector<double> weights = ball_weights(balls, tolerance);
  const RegularCells cells = regular_cells(balls.centers, weights, triangulating);
  if (cells.dimension < 3) return union_betti(power_diagram(balls, {tolerance}, flagging), counting);
  const BallPredicates predicates(balls.centers, weights);
  const std::vector<std::uint8_t> flags = complex_flags(cells, predicates, flagging);
  return Count(cells, flags, predicates, balls.size(), counting).betti();
}

}  // namespace ballflow::geometry
