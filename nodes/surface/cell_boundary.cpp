#include "surface/cell_boundary.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Corners of the facet opposite corner k of a positively oriented cell, counter-clockwise seen from outside
// it.
constexpr std::array<std::array<std::size_t, 3>, 4> facet{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct BoundaryFacet {
  std::int32_t inner;  // its cell inside
  std::size_t k;       // opposite this corner
  std::array<std::int32_t, 3> balls;
};

class Boundary {
 public:
  Boundary(const PowerDiagram& diagram, const std::vector<std::uint8_t>& inside)
      : diagram_(diagram), inside_(inside) {
    number_.assign(diagram.size(), {-1, -1, -1, -1});
    for (std::size_t c = 0; c < diagram.size(); ++c) {
      if (inside[c] == 0) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        if (inside[at(diagram.neighbors[c][k])] == 1) continue;
        number_[c][k] = index_of(facets_.size(), "triangles of a surface");
        BoundaryFacet f{static_cast<std::int32_t>(c), k, {}};
        for (std::size_t j = 0; j < 3; ++j) f.balls[j] = diagram.cells[c][facet[k][j]];
        facets_.push_back(f);
      }
    }
  }
  const std::vector<BoundaryFacet>& facets() const { return facets_; }

  /// The facet on the other side of the outside that begins at facet f, around the edge from its corner j to
  /// the next.
  std::int32_t partner(std::size_t f, std::size_t j) const {
    const std::int32_t a = facets_[f].balls[j], b = facets_[f].balls[(j + 1) % 3];
    std::int32_t from = facets_[f].inner;
    std::array<std::int32_t, 3> through = facets_[f].balls;
    std::int32_t cell = diagram_.neighbors[at(from)][facets_[f].k];
    while (true) {
      // The facet of `cell` with a and b that is not the one through which it was entered.
      const auto& vertices = diagram_.cells[at(cell)];
      const auto is_in = [&](std::int32_t v) {
        return v == through[0] || v == through[1] || v == through[2];
      };
      std::size_t apex = 0;  // the corner that is not in the facet of entry
      while (is_in(vertices[apex])) ++apex;
      std::size_t left =
          0;  // the corner of that facet which is not on the edge; its opposite facet is the exit
      while (left == apex || vertices[left] == a || vertices[left] == b) ++left;
      const std::int32_t next = diagram_.neighbors[at(cell)][left];
      through = {a, b, vertices[apex]};
      if (inside_[at(next)] == 1) {
        std::size_t k = 0;  // the corner of `next` that is not in the facet
        while (is_in(diagram_.cells[at(next)][k])) ++k;
        return number_[at(next)][k];
      }
      cell = next;
    }
  }

 private:
  const PowerDiagram& diagram_;
  const std::vector<std::uint8_t>& inside_;
  std::vector<std::array<std::int32_t, 4>> number_;  // of the boundary facet opposite each corner of a cell
  std::vector<BoundaryFacet> facets_;
};

/// A triangle whose edges may have midpoints, as triangles.
void split(const Triangle& t, const std::array<std::int32_t, 3>& middle, std::vector<Triangle>& out) {
  std::vector<std::int32_t> ring;
  for (std::size_t j = 0; j < 3; ++j) {
    ring.push_back(t[j]);
    if (middle[j] >= 0) ring.push_back(middle[j]);
  }
  if (ring.size() == 6) {
    out.insert(out.end(), {{t[0], middle[0], middle[2]},
                           {middle[0], t[1], middle[1]},
                           {middle[2], middle[1], t[2]},
                           {middle[0], middle[1], middle[2]}});
    return;
  }
  // A fan from the first midpoint: no triangle of it is on one edge.
  const std::size_t n = ring.size();
  std::size_t apex = 0;
  while (apex < n && std::find(middle.begin(), middle.end(), ring[apex]) == middle.end()) ++apex;
  if (apex == n) apex = 0;
  for (std::size_t j = 1; j + 1 < n; ++j)
    out.push_back({ring[apex], ring[(apex + j) % n], ring[(apex + j + 1) % n]});
}

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.vertices[at(t[0])], b = mesh.vertices[at(t[1])], c = mesh.vertices[at(t[2])];
  return 0.5 * length(cross(b - a, c - a));
}

}  // namespace

void drop_specks(CellBoundary& surface, double smallest) {
  const auto& triangles = surface.mesh.triangles;
  DisjointSets parts(surface.mesh.vertices.size());
  for (const Triangle& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  std::map<std::int32_t, double> area;  // per component
  for (const Triangle& t : triangles) area[parts.root(t[0])] += area_of(surface.mesh, t);
  double largest = 0;
  for (const auto& [part, of_part] : area) largest = std::max(largest, of_part);
  for (const auto& [part, of_part] : area) surface.specks += of_part < smallest * largest ? 1 : 0;
  std::vector<std::int32_t> number(surface.mesh.vertices.size(), -1), ball;
  std::vector<Vec3> vertices;
  std::vector<Triangle> kept;
  std::vector<CellFacet> facets;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (area[parts.root(triangles[i][0])] < smallest * largest) continue;
    Triangle t = triangles[i];
    for (std::int32_t& v : t) {
      if (number[at(v)] < 0) {
        number[at(v)] = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(surface.mesh.vertices[at(v)]);
        ball.push_back(surface.ball[at(v)]);
      }
      v = number[at(v)];
    }
    kept.push_back(t);
    facets.push_back(surface.facets[i]);
  }
  surface.mesh = {std::move(vertices), std::move(kept)};
  surface.ball = std::move(ball);
  surface.facets = std::move(facets);
}

CellBoundary cell_boundary(const PowerDiagram& diagram, const std::vector<std::uint8_t>& inside,
                           const CellBoundaryOptions& options, Monitor& monitor) {
  const Boundary boundary(diagram, inside);
  const auto& facets = boundary.facets();
  DisjointSets corners(3 * facets.size());
  const auto corner = [](std::size_t f, std::size_t j) { return static_cast<std::int32_t>(3 * f + j); };
  std::vector<std::array<std::int32_t, 3>> partners(facets.size());
  Lookout look(monitor);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    look(64);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::int32_t g = partners[f][j] = boundary.partner(f, j);
      for (const std::size_t end : {j, (j + 1) % 3}) {
        const auto& other = facets[at(g)].balls;
        const auto place = std::find(other.begin(), other.end(), facets[f].balls[end]) - other.begin();
        corners.join(corner(f, end), corner(at(g), static_cast<std::size_t>(place)));
      }
    }
  }
  CellBoundary result;
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex(3 * facets.size(), -1);  // of the class that a corner names
  std::vector<std::int32_t> copies(diagram.centers.size(), 0);
  std::vector<Triangle> triangles(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t j = 0; j < 3; ++j) {
      std::int32_t& number = vertex[at(corners.root(corner(f, j)))];
      const std::int32_t ball = facets[f].balls[j];
      if (number < 0) {
        number = index_of(vertices.size(), "vertices of a surface");
        vertices.push_back(diagram.centers[at(ball)]);
        result.ball.push_back(ball);
        if (++copies[at(ball)] > 1) ++result.split_vertices;
      }
      triangles[f][j] = number;
    }
  }
  // Edges that several pairs run through.
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const Triangle& t : triangles) {
    for (std::size_t j = 0; j < 3; ++j) ++uses[std::minmax(t[j], t[(j + 1) % 3])];
  }
  std::vector<std::array<std::int32_t, 3>> middle(facets.size(), {-1, -1, -1});
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::int32_t a = triangles[f][j], b = triangles[f][(j + 1) % 3];
      if (middle[f][j] >= 0 || uses[std::minmax(a, b)] <= 2) continue;
      middle[f][j] = index_of(vertices.size(), "vertices of a surface");
      vertices.push_back(0.5 * (vertices[at(a)] + vertices[at(b)]));
      result.ball.push_back(-1);
      ++result.midpoints;
      const std::size_t g = at(partners[f][j]);
      for (std::size_t i = 0; i < 3; ++i) {
        if (triangles[g][i] == b && triangles[g][(i + 1) % 3] == a) middle[g][i] = middle[f][j];
      }
    }
  }
  std::vector<Triangle> all;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    split(triangles[f], middle[f], all);
    result.facets.resize(all.size(), {facets[f].inner, static_cast<std::uint8_t>(facets[f].k)});
  }
  result.mesh = {std::move(vertices), std::move(all)};
  drop_specks(result, options.smallest_component);
  return result;
}

}  // namespace ballflow::geometry
