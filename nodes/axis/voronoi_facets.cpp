#include "axis/voronoi_facets.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The vertices strictly between `from` and `to` on a shortest path along the edges; none without a path.
std::vector<std::int32_t> path_between(std::int32_t from, std::int32_t to,
                                       std::span<const std::array<std::int32_t, 2>> edges) {
  std::vector<std::array<std::int32_t, 2>> reached{{from, -1}};  // vertex, index of its predecessor
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const auto& edge : edges) {
      if (edge[0] != reached[i][0] && edge[1] != reached[i][0]) continue;
      const std::int32_t next = edge[0] + edge[1] - reached[i][0];
      const bool known =
          std::any_of(reached.begin(), reached.end(), [&](const auto& r) { return r[0] == next; });
      if (known) continue;
      reached.push_back({next, static_cast<std::int32_t>(i)});
      if (next != to) continue;
      std::vector<std::int32_t> path;
      for (std::int32_t k = reached.back()[1]; k > 0; k = reached[at(k)][1])
        path.push_back(reached[at(k)][0]);
      std::reverse(path.begin(), path.end());
      return path;
    }
  }
  return {};
}

class Facets {
 public:
  Facets(const SimplicialComplex& complex, const VoronoiPlaces& places, Monitor& monitor)
      : complex_(complex), places_(places), monitor_(monitor) {}

  std::vector<AxisPiece> run();

 private:
  using Polygon = std::vector<std::int32_t>;  // names of the corners
  using Edge = std::array<std::int32_t, 2>;

  const UnionVertices& sites() const { return places_.sites(); }
  const std::vector<DelaunayCell>& cells() const { return places_.cells(); }
  std::int32_t balls() const { return static_cast<std::int32_t>(complex_.centers.size()); }

  void add_facet(std::int32_t w0, std::int32_t w1, std::span<const std::int32_t> ring,
                 std::span<const std::int32_t> apexes);
  void keep_inside(Polygon polygon, std::int32_t w0, std::int32_t w1, bool cut);
  void add_polygon(const Polygon& polygon, AxisKind kind, const std::array<std::int32_t, 2>& between);

  const SimplicialComplex& complex_;
  const VoronoiPlaces& places_;
  Monitor& monitor_;
  std::vector<AxisPiece> pieces_;
};

/// Visits every Delaunay edge between two regular sites: its ring of cells is a Voronoi facet.
std::vector<AxisPiece> Facets::run() {
  std::vector<std::int32_t> ring, apexes;
  for (std::size_t i = 0; i < cells().size(); ++i) {
    if (i % 256 == 0) monitor_.step(static_cast<double>(i) / static_cast<double>(cells().size()));
    const DelaunayCell& first = cells()[i];
    for (std::size_t a = 0; a < 3; ++a) {
      if (sites().faces_of(at(first.corners[a])).empty()) continue;
      for (std::size_t b = a + 1; b < 4; ++b) {
        const std::int32_t w0 = first.corners[a], w1 = first.corners[b];
        if (w1 == DelaunayCell::infinite || sites().faces_of(at(w1)).empty()) continue;
        ring.clear();
        apexes.clear();
        // Leave every cell through the triangle of the edge and `ahead`, away from `behind`.
        std::size_t rest[2], m = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          if (k != a && k != b) rest[m++] = k;
        }
        std::int32_t cell = static_cast<std::int32_t>(i);
        std::int32_t behind = first.corners[rest[0]], ahead = first.corners[rest[1]];
        bool lowest = true;
        do {
          ring.push_back(cell);
          apexes.push_back(ahead);
          const DelaunayCell& here = cells()[at(cell)];
          std::size_t k = 0;
          while (here.corners[k] != behind) ++k;
          cell = here.neighbors[k];
          if (cell < static_cast<std::int32_t>(i)) {
            lowest = false;
            break;
          }
          const DelaunayCell& next = cells()[at(cell)];
          for (k = 0; next.corners[k] == w0 || next.corners[k] == w1 || next.corners[k] == ahead;) ++k;
          behind = ahead;
          ahead = next.corners[k];
        } while (cell != static_cast<std::int32_t>(i));
        if (lowest) add_facet(w0, w1, ring, apexes);
      }
    }
  }
  return std::move(pieces_);
}

/// Keeps what lies in R of the facet between w0 and w1. ring[k] and ring[k + 1] are the ends of the Voronoi
/// edge of w0, w1 and apexes[k].
void Facets::add_facet(std::int32_t w0, std::int32_t w1, std::span<const std::int32_t> ring,
                       std::span<const std::int32_t> apexes) {
  const std::size_t n = ring.size();
  const auto vertex = [&](std::size_t k) { return places_.vertex(ring[k % n]); };
  // Appends the ball centres on the Voronoi edge behind ring[edge], beginning at its end ring[from]: those of
  // the balls its three sites share. One is where the edge leaves R, unless its end inside R is.
  const auto pass = [&](std::size_t edge, std::size_t from, Polygon& polygon) {
    if (apexes[edge % n] == DelaunayCell::infinite) return;
    const std::array<std::int32_t, 3> three{w0, w1, apexes[edge % n]};
    const std::size_t before = polygon.size();
    for (const std::int32_t ball : sites().balls_of(at(w0))) {
      if (ball == vertex(edge).name || ball == vertex(edge + 1).name) continue;
      if (places_.all_on(ball, three)) polygon.push_back(ball);
    }
    if (polygon.size() - before < 2) return;
    std::sort(polygon.begin() + static_cast<std::ptrdiff_t>(before), polygon.end(),
              [&](std::int32_t a, std::int32_t b) { return places_.nearer(a, b, ring[from % n]); });
  };

  std::size_t start = 0;  // behind a vertex outside R, if there is one
  while (start < n && vertex(start + n - 1).place != VoronoiVertex::Place::out) ++start;
  if (start == n) {
    Polygon polygon;
    for (std::size_t k = 0; k < n; ++k) {
      polygon.push_back(vertex(k).name);
      pass(k, k, polygon);
    }
    return keep_inside(std::move(polygon), w0, w1, false);
  }
  for (std::size_t k = start; k < start + n; ++k) {
    if (vertex(k).place == VoronoiVertex::Place::out) continue;
    Polygon polygon;
    pass(k + n - 1, k, polygon);
    std::reverse(polygon.begin(), polygon.end());
    for (; vertex(k).place != VoronoiVertex::Place::out; ++k) {
      polygon.push_back(vertex(k).name);
      pass(k, k, polygon);
    }
    keep_inside(std::move(polygon), w0, w1, true);
  }
}

/// Adds a piece of the facet between w0 and w1 with no corner outside R. `cut`: the boundary of R cut it
/// between the last corner and the first.
void Facets::keep_inside(Polygon polygon, std::int32_t w0, std::int32_t w1, bool cut) {
  const auto is_ball = [this](std::int32_t name) { return name < balls(); };
  const auto place_of = [&](const Polygon& of_balls) { return places_.place_of_centroid(w0, w1, of_balls); };
  if (std::count_if(polygon.begin(), polygon.end(), is_ball) < 2)
    return add_polygon(polygon, AxisKind::voronoi, {w0, w1});

  std::vector<Edge> shared;  // edges between triangles of w0 and of w1
  for (const auto& f0 : sites().faces_of(at(w0))) {
    for (const auto& f1 : sites().faces_of(at(w1))) {
      const auto &t0 = complex_.triangles[at(f0.triangle)], &t1 = complex_.triangles[at(f1.triangle)];
      Polygon common;
      std::set_intersection(t0.begin(), t0.end(), t1.begin(), t1.end(), std::back_inserter(common));
      if (common.size() == 2) shared.push_back({common[0], common[1]});
    }
  }
  const auto is_shared = [&shared](std::int32_t a, std::int32_t b) {
    return std::find(shared.begin(), shared.end(), Edge{std::min(a, b), std::max(a, b)}) != shared.end();
  };
  // Between two centres the boundary of R follows shared edges: one, unless w0 and w1 have several triangles.
  Polygon corners;
  bool wall = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const bool last = k + 1 == polygon.size();
    const std::int32_t a = polygon[k], b = polygon[last ? 0 : k + 1];
    corners.push_back(a);
    if (a == b || !is_ball(a) || !is_ball(b)) continue;
    if (is_shared(a, b)) {
      wall = true;
    } else if (shared.size() > 1 && ((last && cut) || place_of({a, b}) != VoronoiVertex::Place::in)) {
      const Polygon path = path_between(a, b, shared);
      corners.insert(corners.end(), path.begin(), path.end());
      wall = wall || !path.empty();
    }
  }
  if (std::all_of(corners.begin(), corners.end(), is_ball)) {
    Polygon centers = corners;
    std::sort(centers.begin(), centers.end());
    centers.erase(std::unique(centers.begin(), centers.end()), centers.end());
    if (centers.size() < 3) return;
    // A facet may lie in the boundary of R: the polytope outside it is then flat.
    if (place_of(centers) == VoronoiVertex::Place::out) return;
  }
  add_polygon(corners, wall ? AxisKind::wall : AxisKind::voronoi, {w0, w1});
}

/// Adds the loops of a closed chain of names: equal neighbours are one corner, and a name that comes back
/// splits the chain.
void Facets::add_polygon(const Polygon& polygon, AxisKind kind, const std::array<std::int32_t, 2>& between) {
  const bool needless = places_.coincide(between[0], between[1]);
  Polygon chain;
  for (const std::int32_t name : polygon) {
    const auto before = std::find(chain.begin(), chain.end(), name);
    if (before == chain.end()) {
      chain.push_back(name);
      continue;
    }
    if (chain.end() - before >= 3) pieces_.push_back({Polygon(before, chain.end()), kind, needless, between});
    chain.erase(before + 1, chain.end());
  }
  if (chain.size() >= 3) pieces_.push_back({std::move(chain), kind, needless, between});
}
}  // namespace

std::vector<AxisPiece> voronoi_facets(const SimplicialComplex& complex, const VoronoiPlaces& places,
                                      Monitor& monitor) {
  return Facets(complex, places, monitor).run();
}

bool cells_are_closed(const SimplicialComplex& complex, const UnionVertices& sites,
                      std::span<const AxisPiece> pieces, Monitor& monitor) {
  using SideOfCell = std::array<std::int32_t, 3>;  // site, ends
  std::vector<SideOfCell> sides;
  Lookout look(monitor);
  const auto add = [&](std::int32_t w, std::int32_t a, std::int32_t b) {
    look(4);
    sides.push_back({w, std::min(a, b), std::max(a, b)});
  };
  for (const AxisPiece& piece : pieces) {
    for (const std::int32_t w : piece.sites) {
      for (std::size_t k = 0; k < piece.corners.size(); ++k)
        add(w, piece.corners[k], piece.corners[(k + 1) % piece.corners.size()]);
    }
  }
  for (std::size_t w = 0; w < sites.size(); ++w) {
    for (const UnionVertices::Face& face : sites.faces_of(w)) {
      const auto& t = complex.triangles[at(face.triangle)];
      for (std::size_t k = 0; k < 3; ++k) add(static_cast<std::int32_t>(w), t[k], t[(k + 1) % 3]);
    }
  }
  std::sort(sides.begin(), sides.end(), [&look](const SideOfCell& a, const SideOfCell& b) {
    look(4);
    return a < b;
  });
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    look(2);
    if (i + 1 == sides.size() || sides[i] != sides[i + 1]) return false;
  }
  return true;
}

}  // namespace ballflow::geometry
