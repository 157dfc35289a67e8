#include "power/gabriel_points.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "exact/ball_predicates.hpp"

namespace ballflow::geometry {
namespace {

using Exact = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Edge = std::array<std::int32_t, 2>;
using Facet = std::array<std::int32_t, 3>;
using Cell = std::array<std::int32_t, 4>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The simplex without its corner k.
template <std::size_t N>
std::array<std::int32_t, N - 1> without(const std::array<std::int32_t, N>& simplex, std::size_t k) {
  std::array<std::int32_t, N - 1> side{};
  for (std::size_t i = 0, j = 0; i < N; ++i) {
    if (i != k) side[j++] = simplex[i];
  }
  return side;
}

class Search {
 public:
  Search(const PowerDiagram& diagram, Monitor& monitor)
      : centers_(diagram.centers),
        weights_(diagram.weights),
        mesh_(diagram),
        monitor_(monitor),
        predicates_(diagram.centers, diagram.weights) {}

  std::vector<Vec3> run() {
    std::vector<Facet> facets;
    std::vector<Edge> edges;
    if (mesh_.dimension == 3) facets = visit_cells();
    if (mesh_.dimension == 2) facets = visit_top<Facet>();
    if (mesh_.dimension >= 2) visit_edges(facets);
    if (mesh_.dimension == 1) visit_top<Edge>();
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    return std::move(points_);
  }

 private:
  /// The smallest orthogonal sphere has a positive squared radius: its centre is in none of the balls.
  template <class S>
  bool apart(const S& simplex) const {
    return !predicates_.meets(simplex);
  }

  /// The centre of the smallest orthogonal sphere lies in the simplex. It lies beyond a side exactly when the
  /// corner opposite attaches the side: on the line through the two centres the powers to side and corner are
  /// equal at power / (2 height) towards the corner, where power is that of the corner's ball to the sphere
  /// of the side.
  template <std::size_t N>
  bool holds_its_center(const std::array<std::int32_t, N>& s) const {
    for (std::size_t k = 0; k < N; ++k) {
      if constexpr (N == 2) {
        if (predicates_.attaches(s[1 - k], s[k])) return false;
      } else if (predicates_.attaches(without(s, k), s[k])) {
        return false;
      }
    }
    return true;
  }

  template <class S>
  void add(const S& s) {
    const auto exact = [this](std::int32_t i) {
      const Vec3 c = centers_[at(i)];
      return Exact::Weighted_point_3(Exact::Point_3(c.x, c.y, c.z), weights_[at(i)]);
    };
    const auto center = Exact().construct_weighted_circumcenter_3_object();
    Exact::Point_3 point;
    if constexpr (std::tuple_size_v<S> == 4) {
      point = center(exact(s[0]), exact(s[1]), exact(s[2]), exact(s[3]));
    } else if constexpr (std::tuple_size_v<S> == 3) {
      point = center(exact(s[0]), exact(s[1]), exact(s[2]));
    } else {
      point = center(exact(s[0]), exact(s[1]));
    }
    points_.push_back({CGAL::to_double(point.x()), CGAL::to_double(point.y()), CGAL::to_double(point.z())});
  }

  bool finite(const Cell& cell) const {
    return std::find(cell.begin(), cell.end(), PowerDiagram::infinite) == cell.end();
  }

  /// Simplices of the highest dimension where that is less than 3: no ball attaches them.
  template <class S>
  std::vector<S> visit_top() {
    std::vector<S> all;
    for (const Cell& cell : mesh_.cells) {
      if (!finite(cell)) continue;
      S simplex{};
      std::copy_n(cell.begin(), simplex.size(), simplex.begin());
      if (apart(simplex) && holds_its_center(simplex)) add(simplex);
      all.push_back(simplex);
    }
    return all;
  }

  /// Tetrahedra and triangles; returns the triangles.
  std::vector<Facet> visit_cells() {
    std::vector<Facet> facets;
    facets.reserve(2 * mesh_.size());
    for (std::size_t c = 0; c < mesh_.size(); ++c) {
      if (c % 4096 == 0) monitor_.step(0.7 * static_cast<double>(c) / static_cast<double>(mesh_.size()));
      const Cell& cell = mesh_.cells[c];
      if (finite(cell) && (mesh_.in_complex[c] & PowerDiagram::whole) == 0 && holds_its_center(cell))
        add(cell);
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t n = at(mesh_.neighbors[c][i]);
        if (n < c) continue;  // met from the other side
        const Facet facet = without(cell, i);
        if (std::find(facet.begin(), facet.end(), PowerDiagram::infinite) != facet.end()) continue;
        facets.push_back(facet);
        if ((mesh_.in_complex[c] >> i & 1) != 0 || !apart(facet) || !holds_its_center(facet)) continue;
        const auto& around = mesh_.neighbors[n];
        const auto back =
            std::find(around.begin(), around.end(), static_cast<std::int32_t>(c)) - around.begin();
        const std::int32_t opposite[] = {cell[i], mesh_.cells[n][static_cast<std::size_t>(back)]};
        if (std::none_of(std::begin(opposite), std::end(opposite), [&](std::int32_t other) {
              return other != PowerDiagram::infinite && predicates_.attaches(facet, other);
            })) {
          add(facet);
        }
      }
    }
    return facets;
  }

  /// Every edge is a side of a facet, and Gabriel when the third corner of no facet around attaches it.
  void visit_edges(const std::vector<Facet>& facets) {
    struct Side {
      Edge edge;
      std::int32_t opposite;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      if (f % 4096 == 0)
        monitor_.step(0.7 + 0.2 * static_cast<double>(f) / static_cast<double>(facets.size()));
      for (std::size_t k = 0; k < 3; ++k) {
        Edge edge = without(facets[f], k);
        if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
        // Most edges lie inside the union: a quick look saves the sorting of their sides.
        if (!surely_together(edge)) sides.push_back({edge, facets[f][k]});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
    monitor_.step(0.95);
    for (std::size_t first = 0; first < sides.size();) {
      std::size_t last = first;
      bool attached = false;
      const Edge edge = sides[first].edge;
      const bool candidate = apart(edge) && holds_its_center(edge);
      for (; last < sides.size() && sides[last].edge == edge; ++last) {
        attached = attached || (candidate && predicates_.attaches(edge, sides[last].opposite));
      }
      if (candidate && !attached) add(edge);
      first = last;
    }
  }

  /// The balls overlap so far that rounding cannot matter.
  bool surely_together(const Edge& e) const {
    const double u = weights_[at(e[0])], v = weights_[at(e[1])];
    const double d = squared_distance(centers_[at(e[0])], centers_[at(e[1])]);
    return d < 0.999 * std::max(u, v);
  }

  std::span<const Vec3> centers_;
  std::span<const double> weights_;
  const PowerDiagram& mesh_;
  Monitor& monitor_;
  BallPredicates predicates_;
  std::vector<Vec3> points_;
};

}  // namespace

std::vector<Vec3> critical_gabriel_points(const PowerDiagram& diagram, Monitor& monitor) {
  return Search(diagram, monitor).run();
}

}  // namespace ballflow::geometry
