#include "shape/alpha_classes.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Edge = std::array<std::int32_t, 2>;
using Facet = std::array<std::int32_t, 3>;
using Cell = std::array<std::int32_t, 4>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What is known about a simplex of the regular triangulation.
struct State {
  bool in_complex = false;
  bool has_coface = false;  // a proper coface is in the complex
  bool interior = false;    // all cells around it are finite and in the complex

  SimplexClass simplex_class() const {
    if (interior) return SimplexClass::interior;
    return has_coface ? SimplexClass::regular : SimplexClass::singular;
  }
  /// Takes note of a coface of one dimension more. Start from `interior` = true.
  void join(const State& coface) {
    has_coface = has_coface || coface.in_complex;
    interior = interior && coface.interior;
  }
};

template <class S>
struct Entry {
  S simplex;
  State state;
  friend bool operator<(const Entry& a, const Entry& b) { return a.simplex < b.simplex; }
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : root_(n) { std::iota(root_.begin(), root_.end(), 0); }
  /// False when a and b were together already.
  bool unite(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    root_[at(std::max(a, b))] = std::min(a, b);
    return true;
  }

 private:
  std::int32_t find(std::int32_t i) {
    while (root_[at(i)] != i) {
      root_[at(i)] = root_[at(root_[at(i)])];
      i = root_[at(i)];
    }
    return i;
  }
  std::vector<std::int32_t> root_;
};

/// The exact decisions.
class Predicates {
 public:
  Predicates(std::span<const Vec3> centers, std::span<const double> weights) {
    balls_.reserve(centers.size());
    for (std::size_t i = 0; i < centers.size(); ++i) {
      balls_.emplace_back(Kernel::Point_3(centers[i].x, centers[i].y, centers[i].z), weights[i]);
    }
  }

  /// The smallest orthogonal sphere has a squared radius <= 0: the balls have a point in common on the
  /// intersection of their bisectors.
  bool meets(const Cell& s) const {
    return compare_(ball(s[0]), ball(s[1]), ball(s[2]), ball(s[3]), 0.0) != CGAL::LARGER;
  }
  bool meets(const Facet& s) const {
    return compare_(ball(s[0]), ball(s[1]), ball(s[2]), 0.0) != CGAL::LARGER;
  }
  bool meets(const Edge& s) const { return compare_(ball(s[0]), ball(s[1]), 0.0) != CGAL::LARGER; }

  /// Ball `other` has strictly negative power to the smallest orthogonal sphere: no Gabriel simplex.
  bool attaches(const Facet& s, std::int32_t other) const {
    return side_(ball(s[0]), ball(s[1]), ball(s[2]), ball(other)) == CGAL::ON_BOUNDED_SIDE;
  }
  bool attaches(const Edge& s, std::int32_t other) const {
    return side_(ball(s[0]), ball(s[1]), ball(other)) == CGAL::ON_BOUNDED_SIDE;
  }
  bool attaches(std::int32_t s, std::int32_t other) const {
    return side_(ball(s), ball(other)) == CGAL::ON_BOUNDED_SIDE;
  }

 private:
  const Kernel::Weighted_point_3& ball(std::int32_t i) const { return balls_[at(i)]; }
  std::vector<Kernel::Weighted_point_3> balls_;
  Kernel::Compare_weighted_squared_radius_3 compare_ = Kernel().compare_weighted_squared_radius_3_object();
  Kernel::Power_side_of_bounded_power_sphere_3 side_ = Kernel().power_side_of_bounded_power_sphere_3_object();
};

/// Works down from the cells of the regular triangulation to its vertices. A simplex is in the complex when
/// a coface is, or when it is a Gabriel simplex whose orthogonal sphere has a squared radius <= 0. Gabriel
/// is tested against the simplex's link only: another ball that attaches it implies one there, because the
/// power cell of the simplex is convex.
class Classification {
 public:
  Classification(const RegularCells& cells, const Predicates& predicates, std::size_t balls, Monitor& monitor)
      : mesh_(cells), predicates_(predicates), monitor_(monitor), vertices_(balls) {
    switch (mesh_.dimension) {
      case 3:
        classify_cells();
        classify_facets();
        classify_edges();
        break;
      case 2:
        classify_top(facets_);
        classify_edges();
        break;
      case 1:
        classify_top(edges_);
        break;
      default:
        break;
    }
    classify_vertices();
  }

  SimplicialComplex result() {
    SimplicialComplex complex;
    std::vector<std::int32_t> vertices;
    std::vector<std::uint8_t> vertex_classes;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (!vertices_[i].in_complex) continue;
      vertices.push_back(static_cast<std::int32_t>(i));
      vertex_classes.push_back(static_cast<std::uint8_t>(vertices_[i].simplex_class()));
    }
    complex.betti[0] = static_cast<std::int64_t>(vertices.size());
    complex.vertices = std::move(vertices);
    complex.vertex_classes = std::move(vertex_classes);
    emit(edges_, complex.edges, complex.edge_classes);
    emit(facets_, complex.triangles, complex.triangle_classes);
    std::sort(tetrahedra_.begin(), tetrahedra_.end());
    complex.tetrahedra = std::move(tetrahedra_);

    UnionFind pieces(vertices_.size());
    for (const Edge& e : complex.edges) complex.betti[0] -= pieces.unite(e[0], e[1]) ? 1 : 0;
    complex.betti[2] = cavities_;
    complex.betti[1] = complex.betti[0] + complex.betti[2] - complex.euler_characteristic();
    return complex;
  }

 private:
  bool finite(const Cell& cell) const {
    return std::find(cell.begin(), cell.end(), RegularCells::infinite) == cell.end();
  }

  void classify_cells() {
    in_complex_.assign(mesh_.size(), false);
    for (std::size_t c = 0; c < mesh_.size(); ++c) {
      if (c % 4096 == 0)
        monitor_.step(0.6 + 0.1 * static_cast<double>(c) / static_cast<double>(mesh_.size()));
      Cell cell = mesh_.cells[c];
      if (!finite(cell)) continue;
      std::sort(cell.begin(), cell.end());
      if (!predicates_.meets(cell)) continue;
      in_complex_[c] = true;
      tetrahedra_.push_back(cell);
    }
  }

  void classify_facets() {
    facets_.reserve(2 * mesh_.size());
    UnionFind voids(mesh_.size());
    cavities_ = static_cast<std::int64_t>(mesh_.size() - tetrahedra_.size()) - 1;
    for (std::size_t c = 0; c < mesh_.size(); ++c) {
      if (c % 4096 == 0)
        monitor_.step(0.7 + 0.15 * static_cast<double>(c) / static_cast<double>(mesh_.size()));
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t n = at(mesh_.neighbors[c][i]);
        if (n < c) continue;  // met from the other side
        const bool in_complex = classify_facet(c, n, i);
        if (!in_complex && voids.unite(static_cast<std::int32_t>(c), static_cast<std::int32_t>(n)))
          --cavities_;
      }
    }
  }

  /// The facet of cells c and n opposite corner i of c; true when it is in the complex.
  bool classify_facet(std::size_t c, std::size_t n, std::size_t i) {
    const Cell& cell = mesh_.cells[c];
    Entry<Facet> facet{{cell[(i + 1) & 3], cell[(i + 2) & 3], cell[(i + 3) & 3]}, {}};
    std::sort(facet.simplex.begin(), facet.simplex.end());
    if (facet.simplex[0] == RegularCells::infinite) return false;
    State& state = facet.state;
    state.has_coface = in_complex_[c] || in_complex_[n];
    state.interior = in_complex_[c] && in_complex_[n];
    state.in_complex = state.has_coface;
    if (!state.in_complex && predicates_.meets(facet.simplex)) {
      const auto& around = mesh_.neighbors[n];
      const auto back =
          std::find(around.begin(), around.end(), static_cast<std::int32_t>(c)) - around.begin();
      const std::int32_t opposite[] = {cell[i], mesh_.cells[n][static_cast<std::size_t>(back)]};
      state.in_complex = std::none_of(std::begin(opposite), std::end(opposite), [&](std::int32_t other) {
        return other != RegularCells::infinite && predicates_.attaches(facet.simplex, other);
      });
    }
    facets_.push_back(facet);
    return state.in_complex;
  }

  /// Simplices of the highest dimension where that is less than 3; none is interior.
  template <class S>
  void classify_top(std::vector<Entry<S>>& simplices) {
    for (const Cell& cell : mesh_.cells) {
      if (!finite(cell)) continue;
      Entry<S> top{};
      std::copy_n(cell.begin(), top.simplex.size(), top.simplex.begin());
      std::sort(top.simplex.begin(), top.simplex.end());
      top.state.in_complex = predicates_.meets(top.simplex);
      simplices.push_back(top);
    }
  }

  /// Every edge is a side of a facet.
  void classify_edges() {
    // Sides of facets by their lower end: upper end and facet in one number, so that sorting a short
    // list puts all facets around an edge side by side.
    std::vector<std::size_t> begin(vertices_.size() + 2);
    for (const auto& [f, state] : facets_) {
      begin[at(f[0]) + 2] += 2;
      begin[at(f[1]) + 2] += 1;
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint64_t> sides(3 * facets_.size());
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      const Facet& f = facets_[i].simplex;
      const auto put = [&](std::int32_t u, std::int32_t v) {
        sides[begin[at(u) + 1]++] = std::uint64_t{static_cast<std::uint32_t>(v)} << 32 | i;
      };
      put(f[0], f[1]);
      put(f[0], f[2]);
      put(f[1], f[2]);
    }
    edges_.reserve(facets_.size() / 2 + facets_.size() / 8);
    for (std::size_t u = 0; u < vertices_.size(); ++u) {
      if (u % 256 == 0)
        monitor_.step(0.85 + 0.1 * static_cast<double>(u) / static_cast<double>(vertices_.size()));
      const std::span<std::uint64_t> around(sides.data() + begin[u], sides.data() + begin[u + 1]);
      std::sort(around.begin(), around.end());
      for (std::size_t first = 0; first < around.size();) {
        std::size_t last = first;
        while (last < around.size() && around[last] >> 32 == around[first] >> 32) ++last;
        const Edge edge{static_cast<std::int32_t>(u), static_cast<std::int32_t>(around[first] >> 32)};
        classify_edge(edge, around.subspan(first, last - first));
        first = last;
      }
    }
  }

  void classify_edge(const Edge& edge, std::span<const std::uint64_t> facets) {
    const auto facet = [&](std::uint64_t side) -> const Entry<Facet>& { return facets_[side & 0xffffffffu]; };
    State state{false, false, true};
    for (const std::uint64_t side : facets) state.join(facet(side).state);
    state.in_complex = state.has_coface;
    if (!state.in_complex && predicates_.meets(edge)) {
      state.in_complex = std::none_of(facets.begin(), facets.end(), [&](std::uint64_t side) {
        const Facet& f = facet(side).simplex;
        const std::int32_t opposite = f[0] != edge[0] ? f[0] : f[1] != edge[1] ? f[1] : f[2];
        return predicates_.attaches(edge, opposite);
      });
    }
    edges_.push_back({edge, state});
  }

  void classify_vertices() {
    // Weights are not negative, so a vertex is in the complex unless a neighbor attaches it.
    for (const Cell& cell : mesh_.cells) {
      for (const std::int32_t v : cell) {
        if (v >= 0) vertices_[at(v)] = {true, false, mesh_.dimension == 3};
      }
    }
    for (const auto& [e, state] : edges_) {
      for (const std::int32_t v : e) vertices_[at(v)].join(state);
    }
    for (const auto& [e, state] : edges_) {
      for (std::size_t k = 0; k < 2; ++k) {
        State& vertex = vertices_[at(e[k])];
        if (vertex.in_complex && !vertex.has_coface)
          vertex.in_complex = !predicates_.attaches(e[k], e[1 - k]);
      }
    }
  }

  template <class S>
  static void emit(std::vector<Entry<S>>& entries, Array<S>& simplices, Array<std::uint8_t>& classes) {
    std::erase_if(entries, [](const Entry<S>& entry) { return !entry.state.in_complex; });
    std::sort(entries.begin(), entries.end());
    std::vector<S> sorted;
    std::vector<std::uint8_t> kinds;
    sorted.reserve(entries.size());
    kinds.reserve(entries.size());
    for (const auto& [simplex, state] : entries) {
      sorted.push_back(simplex);
      kinds.push_back(static_cast<std::uint8_t>(state.simplex_class()));
    }
    entries = {};
    simplices = std::move(sorted);
    classes = std::move(kinds);
  }

  const RegularCells& mesh_;
  const Predicates& predicates_;
  Monitor& monitor_;
  std::vector<bool> in_complex_;  // per cell
  std::vector<Cell> tetrahedra_;  // those in the complex
  std::vector<Entry<Facet>> facets_;
  std::vector<Entry<Edge>> edges_;
  std::vector<State> vertices_;  // per ball
  std::int64_t cavities_ = 0;
};

}  // namespace

SimplicialComplex alpha_classes(const RegularCells& cells, const Array<Vec3>& centers,
                                const Array<double>& weights, Monitor& monitor) {
  const Predicates predicates(centers, weights);
  SimplicialComplex complex = Classification(cells, predicates, centers.size(), monitor).result();
  complex.centers = centers;
  complex.weights = weights;
  return complex;
}

}  // namespace ballflow::geometry
