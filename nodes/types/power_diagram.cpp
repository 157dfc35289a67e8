#include "types/power_diagram.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {
namespace {

/// What is true of nearly every cell, without words: they take longer than the check.
bool is_sound_tetrahedron(const PowerDiagram& d, std::size_t c) {
  const auto balls = static_cast<std::int32_t>(d.centers.size()), cells = static_cast<std::int32_t>(d.size());
  const auto& cell = d.cells[c];
  bool sound = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::int32_t n = d.neighbors[c][k];
    if (n < 0 || n >= cells) return false;
    const auto& back = d.neighbors[static_cast<std::size_t>(n)];
    const auto number = static_cast<std::int32_t>(c);
    sound &= (back[0] == number) | (back[1] == number) | (back[2] == number) | (back[3] == number);
    sound &= (cell[k] > PowerDiagram::infinite) & (cell[k] < balls);
  }
  sound &= (cell[0] != cell[1]) & (cell[0] != cell[2]) & (cell[0] != cell[3]);
  return sound & (cell[1] != cell[2]) & (cell[1] != cell[3]) & (cell[2] != cell[3]);
}

std::string broken_cell(const PowerDiagram& d, std::size_t c) {
  const auto corners = static_cast<std::size_t>(d.dimension) + 1;
  const auto& cell = d.cells[c];
  const std::string where = "cell " + std::to_string(c);
  std::array<std::int32_t, 4> ascending = cell;
  std::sort(ascending.begin(), ascending.end());  // what fills short cells comes first
  for (std::size_t k = 0; k < 4; ++k) {
    if (k >= corners) {
      if (cell[k] != PowerDiagram::none || d.neighbors[c][k] != PowerDiagram::none)
        return where + " has more than " + std::to_string(corners) + " vertices";
      continue;
    }
    if (cell[k] < PowerDiagram::infinite || cell[k] >= static_cast<std::int32_t>(d.centers.size()))
      return where + " names ball " + std::to_string(cell[k]) + " of " + std::to_string(d.centers.size());
    if (k > 0 && ascending[4 - corners + k] == ascending[3 - corners + k])
      return where + " has one vertex twice";
    const std::int32_t n = d.neighbors[c][k];
    if (n < 0 || static_cast<std::size_t>(n) >= d.size())
      return where + " has the neighbor " + std::to_string(n) + " of " + std::to_string(d.size());
    const auto& back = d.neighbors[static_cast<std::size_t>(n)];
    if (std::find(back.begin(), back.end(), static_cast<std::int32_t>(c)) == back.end())
      return where + " is no neighbor of its neighbor " + std::to_string(n);
  }
  if (ascending[4 - corners] == PowerDiagram::infinite && (d.in_complex[c] & PowerDiagram::whole) != 0)
    return where + " is infinite but in the complex";
  return {};
}

}  // namespace

std::string broken_invariant(const PowerDiagram& d) {
  const std::size_t n = d.centers.size();
  if (d.weights.size() != n)
    return std::to_string(n) + " centers but " + std::to_string(d.weights.size()) + " weights";
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(d.centers[i])) return "the center of ball " + std::to_string(i) + " is not finite";
    if (!std::isfinite(d.weights[i]) || d.weights[i] < 0)
      return "ball " + std::to_string(i) + " has weight " + std::to_string(d.weights[i]);
  }
  if (!std::isfinite(d.delta) || d.delta < 0) return "delta is " + std::to_string(d.delta);
  if (d.dimension < -1 || d.dimension > 3 || (d.dimension == -1) != (n == 0))
    return "the dimension is " + std::to_string(d.dimension) + " for " + std::to_string(n) + " balls";
  if (d.neighbors.size() != d.size() || d.in_complex.size() != d.size()) {
    return std::to_string(d.size()) + " cells but " + std::to_string(d.neighbors.size()) +
           " rows of neighbors and " + std::to_string(d.in_complex.size()) + " flags";
  }
  for (std::size_t c = 0; c < d.size(); ++c) {
    if (d.dimension < 1) break;
    if (d.dimension == 3 && is_sound_tetrahedron(d, c)) continue;
    if (std::string broken = broken_cell(d, c); !broken.empty()) return broken;
  }
  return {};
}

}  // namespace ballflow::geometry
