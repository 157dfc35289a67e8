#include "power/power_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "exact/ball_predicates.hpp"
#include "power/complex_flags.hpp"
#include "power/regular_cells.hpp"

namespace ballflow::geometry {
namespace {

using Row = std::array<std::int32_t, 4>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Writes every cell with ascending vertices, exchanges the last two where that keeps the orientation, and
/// puts cells in the order of their ascending vertices.
RegularCells canonical(RegularCells flat, std::size_t balls, Monitor& monitor) {
  const std::size_t n = flat.size(), corners = static_cast<std::size_t>(flat.dimension + 1);
  Lookout look(monitor);
  std::vector<std::uint8_t> odd(n);
  std::vector<std::size_t> begin(balls + 2);  // by the lowest vertex, which may be the infinite one
  for (std::size_t c = 0; c < n; ++c) {
    look(16);
    Row &cell = flat.cells[c], &around = flat.neighbors[c];
    for (std::size_t k = 1; k < corners; ++k) {
      for (std::size_t i = k; i > 0 && cell[i] < cell[i - 1]; --i) {
        std::swap(cell[i], cell[i - 1]);
        std::swap(around[i], around[i - 1]);
        odd[c] ^= 1U;
      }
    }
    ++begin[at(cell[0] + 2)];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> order(n), place(n);
  for (std::size_t c = 0; c < n; ++c) order[begin[at(flat.cells[c][0] + 1)]++] = static_cast<std::int32_t>(c);
  for (std::size_t v = 0, first = 0; v + 1 < begin.size(); ++v) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = order.begin() + static_cast<std::ptrdiff_t>(begin[v]);
    std::sort(from, to, [&](std::int32_t a, std::int32_t b) {
      look(2);
      return flat.cells[at(a)] < flat.cells[at(b)];
    });
    first = begin[v];
  }
  for (std::size_t i = 0; i < n; ++i) place[at(order[i])] = static_cast<std::int32_t>(i);
  RegularCells sorted{flat.dimension, std::vector<Row>(n), std::vector<Row>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    look(16);
    const std::size_t c = at(order[i]);
    Row cell = flat.cells[c], around = flat.neighbors[c];
    for (std::size_t k = 0; k < corners; ++k) {
      if (around[k] >= 0) around[k] = place[at(around[k])];
    }
    if (flat.dimension == 3 && odd[c] != 0) {
      std::swap(cell[2], cell[3]);
      std::swap(around[2], around[3]);
    }
    sorted.cells[i] = cell;
    sorted.neighbors[i] = around;
  }
  return sorted;
}

}  // namespace

double alpha_delta(const Balls& balls, AlphaTolerance kind) {
  if (kind == AlphaTolerance::none) return 0;
  const double edge = bounding_box(balls).longest_edge();
  return std::ldexp(edge * edge, -36);
}

std::vector<double> ball_weights(const Balls& balls, AlphaTolerance kind) {
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball before computing the alpha-shape");
  }
  if (balls.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError(std::to_string(balls.size()) + " balls, but indices have 31 bits",
                     "prune the balls first");
  }
  const double delta = alpha_delta(balls, kind);
  std::vector<double> weights;
  weights.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    weights.push_back(balls.radii[i] * balls.radii[i] + delta);
    if (!std::isfinite(weights.back())) {
      throw InputError("the squared radius of ball " + std::to_string(i) +
                           " is too large for a double (radius " + std::to_string(balls.radii[i]) + ")",
                       "scale the model so that its coordinates are below 1e150");
    }
  }
  return weights;
}

PowerDiagram power_diagram(const Balls& balls, const PowerDiagramOptions& options, Monitor& monitor) {
  PowerDiagram diagram;
  diagram.weights = ball_weights(balls, options.tolerance);
  diagram.centers = balls.centers;
  diagram.delta = alpha_delta(balls, options.tolerance);
  PartMonitor triangulating(monitor, 0, 0.8), flagging(monitor, 0.8, 1);
  RegularCells cells =
      canonical(regular_cells(diagram.centers, diagram.weights, triangulating), balls.size(), monitor);
  diagram.in_complex = complex_flags(cells, BallPredicates(diagram.centers, diagram.weights), flagging);
  diagram.dimension = cells.dimension;
  diagram.cells = std::move(cells.cells);
  diagram.neighbors = std::move(cells.neighbors);
  monitor.step(1);
  return diagram;
}

void check_diagram_of(const PowerDiagram& diagram, const Balls& balls, AlphaTolerance tolerance) {
  const std::string hint = std::string("connect the node PowerDiagram, with tolerance ") +
                           (tolerance == AlphaTolerance::polar ? "polar" : "none") + ", to the same balls";
  if (diagram.centers.size() != balls.size()) {
    throw InputError("the power diagram is that of " + std::to_string(diagram.centers.size()) +
                         " balls, but there are " + std::to_string(balls.size()),
                     hint);
  }
  const std::vector<double> weights = ball_weights(balls, tolerance);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (diagram.centers[i] != balls.centers[i] || diagram.weights[i] != weights[i])
      throw InputError("ball " + std::to_string(i) + " is another one than in the power diagram", hint);
  }
}

void check_diagram_of(const PowerDiagram& diagram, const SimplicialComplex& complex) {
  if (diagram.centers == complex.centers && diagram.weights == complex.weights) return;
  throw InputError("the power diagram and the alpha-shape are about different balls or tolerances",
                   "connect the same node PowerDiagram here and to AlphaShape");
}

}  // namespace ballflow::geometry
