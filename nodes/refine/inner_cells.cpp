#include "refine/inner_cells.hpp"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

using Cell = RefinedTriangulation::Cell;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
bool is_inner(const RefineDelaunay& delaunay, Cell cell) {
  return !delaunay.is_infinite(cell) && cell->info().side == Side::inner;
}

/// Which samples spoil the surface that the facets form, and the Euler characteristic if none does.
class Surface {
 public:
  Surface(const std::vector<BoundaryFacet>& facets, std::size_t samples) : bad_(samples, false) {
    struct Corner {
      std::array<std::int32_t, 2> edge;
      std::array<std::int32_t, 2> corners;  // of the facet, at either end: 3 * facet + k
    };
    std::vector<Corner> edges;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        std::int32_t u = facets[f].samples[k], v = facets[f].samples[l];
        auto a = index_of(3 * f + k, "corners of facets"), b = index_of(3 * f + l, "corners of facets");
        if (u > v) std::swap(u, v), std::swap(a, b);
        edges.push_back({{u, v}, {a, b}});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Corner& a, const Corner& b) {
      return std::pair(a.edge, a.corners) < std::pair(b.edge, b.corners);
    });
    DisjointSets around(3 * facets.size());  // corners at one sample that hang together
    std::int64_t count = 0;
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last, ++count) {
      while (last < edges.size() && edges[last].edge == edges[first].edge) ++last;
      if (last - first != 2) {
        for (const std::int32_t v : edges[first].edge) bad_[at(v)] = true;
        continue;
      }
      for (std::size_t k = 0; k < 2; ++k) around.join(edges[first].corners[k], edges[first + 1].corners[k]);
    }
    std::vector<std::int32_t> cycle(samples, -1);
    std::int64_t vertices = 0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = at(facets[f].samples[k]);
        const std::int32_t root = around.root(static_cast<std::int32_t>(3 * f + k));
        if (cycle[v] < 0) {
          cycle[v] = root;
          ++vertices;
        } else if (cycle[v] != root) {
          bad_[v] = true;
        }
      }
    }
    euler_ = vertices - count + static_cast<std::int64_t>(facets.size());
    for (std::size_t v = 0; v < samples; ++v) {
      if (bad_[v]) bad_samples_.push_back(static_cast<std::int32_t>(v));
      if (cycle[v] < 0) off_.push_back(static_cast<std::int32_t>(v));
    }
  }
  const std::vector<std::int32_t>& bad() const { return bad_samples_; }
  const std::vector<std::int32_t>& off() const { return off_; }
  std::int64_t euler() const { return euler_; }

 private:
  std::vector<bool> bad_;
  std::vector<std::int32_t> bad_samples_, off_;
  std::int64_t euler_ = 0;
};

}  // namespace

InnerCells inner_cells(RefinedTriangulation& triangulation) {
  RefineDelaunay& delaunay = triangulation.delaunay();
  InnerCells result;
  std::vector<Cell> cells;
  for (Cell cell : delaunay.all_cell_handles()) {
    cell->info().number = index_of(cells.size(), "cells of the Delaunay triangulation");
    cells.push_back(cell);
  }
  std::vector<bool> covered(triangulation.samples(), false);
  DisjointSets parts(cells.size());
  for (const Cell& cell : cells) {
    const bool inner = is_inner(delaunay, cell);
    for (int k = 0; k < 4; ++k) {
      if (inner) covered[at(cell->vertex(k)->info().number)] = true;
      const Cell beside = cell->neighbor(k);
      if (is_inner(delaunay, beside) == inner) {
        parts.join(cell->info().number, beside->info().number);
      } else if (inner) {
        // Three samples: an inner cell has no far-away point. Cells are oriented, so the three that follow
        // an even k are counter-clockwise seen from outside, those that follow an odd one clockwise.
        const auto sample = [&](int j) { return cell->vertex((k + j) % 4)->info().number; };
        const int second = k % 2 == 0 ? 2 : 3;
        result.boundary.push_back({{sample(1), sample(second), sample(5 - second)}, cell, beside});
      }
    }
  }
  for (std::size_t v = 0; v < covered.size(); ++v) {
    if (!covered[v]) result.uncovered.push_back(static_cast<std::int32_t>(v));
  }
  const Surface surface(result.boundary, triangulation.samples());
  result.bad = surface.bad();
  result.off_boundary = surface.off();
  if (!result.bad.empty() || result.boundary.empty()) return result;
  // The boundary is a surface, so cells hang together by facets, and a cavity is a part of the outer cells
  // beyond the one around everything.
  std::int64_t inner = 0, outer = 0;
  for (const Cell& cell : cells) {
    if (parts.root(cell->info().number) != cell->info().number) continue;
    ++(is_inner(delaunay, cell) ? inner : outer);
  }
  const std::int64_t cavities = outer - 1;
  result.betti = Betti{inner, inner + cavities - surface.euler() / 2, cavities};
  return result;
}

}  // namespace ballflow::geometry
