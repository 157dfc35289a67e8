#include "power/alpha_classes.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/lists.hpp"
#include "base/shared_progress.hpp"
#include "exact/ball_predicates.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;
using Facet = std::array<std::int32_t, 3>;
using Cell = std::array<std::int32_t, 4>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What is known about a simplex of the regular triangulation.
enum class Status : std::uint8_t {
  out,       // not in the complex
  singular,  // in it, no proper coface is
  regular,   // a proper coface is in it
  interior,  // all cells around it are finite and in the complex
};

SimplexClass simplex_class(Status status) {
  switch (status) {
    case Status::interior:
      return SimplexClass::interior;
    case Status::regular:
      return SimplexClass::regular;
    default:
      return SimplexClass::singular;
  }
}

/// The status of a simplex as far as its cofaces of one dimension more decide it.
class Cofaces {
 public:
  void join(Status coface) {
    any_ = any_ || coface != Status::out;
    all_ = all_ && coface == Status::interior;
  }
  Status status() const { return !any_ ? Status::out : all_ ? Status::interior : Status::regular; }

 private:
  bool any_ = false, all_ = true;
};

void sort(Facet& f) {
  if (f[1] < f[0]) std::swap(f[0], f[1]);
  if (f[2] < f[1]) std::swap(f[1], f[2]);
  if (f[1] < f[0]) std::swap(f[0], f[1]);
}
void sort(Cell& c) {
  const auto order = [&c](std::size_t i, std::size_t k) {
    const std::int32_t low = std::min(c[i], c[k]), high = std::max(c[i], c[k]);
    c[i] = low;
    c[k] = high;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
}

/// A facet seen from one of its vertices: the two others and its status, in a number that sorts by vertices.
class Side {
 public:
  Side() = default;
  Side(std::int32_t first, std::int32_t second, Status status)
      : bits_(std::uint64_t{static_cast<std::uint32_t>(first)} << 33 |
              std::uint64_t{static_cast<std::uint32_t>(second)} << 2 | static_cast<std::uint64_t>(status)) {}
  std::int32_t first() const { return static_cast<std::int32_t>(bits_ >> 33); }
  std::int32_t second() const { return static_cast<std::int32_t>(bits_ >> 2 & 0x7fffffff); }
  Status status() const { return static_cast<Status>(bits_ & 3); }
  friend bool operator<(Side a, Side b) { return a.bits_ < b.bits_; }

 private:
  std::uint64_t bits_ = 0;
};

/// Works down from the cells of the regular triangulation to its vertices. A simplex is in the complex when
/// a coface is, or when it is a Gabriel simplex whose orthogonal sphere has a squared radius <= 0. Gabriel
/// is tested against the simplex's link only: another ball that attaches it implies one there, because the
/// power cell of the simplex is convex.
///
/// Nothing is sorted as a whole. Facets are put into lists by their lowest vertex; a list is short, and in it
/// lie, ascending, the triangles of the result and all but one kind of the sides from which edges follow.
class Classification {
 public:
  Classification(const PowerDiagram& diagram, const BallPredicates& predicates, Monitor& monitor)
      : mesh_(diagram),
        predicates_(predicates),
        monitor_(monitor),
        vertices_(diagram.centers.size(), Vertex::hidden),
        cofaces_(diagram.centers.size()) {
    for (const Cell& cell : mesh_.cells) {
      for (const std::int32_t v : cell) {
        if (v >= 0) vertices_[at(v)] = Vertex::seen;
      }
    }
    switch (mesh_.dimension) {
      case 3:
        classify_cells();
        classify_facets();
        break;
      case 2:
        classify_top<3>([this](const Facet& f, Status status) { facets_.push_back({f, status}); });
        break;
      case 1:
        classify_top<2>([this](const Edge& e, Status status) { add_edge(e, status); });
        break;
      default:
        break;
    }
    if (mesh_.dimension >= 2) classify_edges();
    classify_vertices();
  }

  SimplicialComplex result() {
    SimplicialComplex complex;
    complex.betti[0] = static_cast<std::int64_t>(vertex_ids_.size());
    DisjointSets pieces(vertices_.size());
    for (const Edge& e : edges_) complex.betti[0] -= pieces.join(e[0], e[1]) ? 1 : 0;
    complex.vertices = std::move(vertex_ids_);
    complex.vertex_classes = std::move(vertex_classes_);
    complex.edges = std::move(edges_);
    complex.edge_classes = std::move(edge_classes_);
    complex.triangles = std::move(triangles_);
    complex.triangle_classes = std::move(triangle_classes_);
    complex.tetrahedra = std::move(tetrahedra_);
    complex.betti[2] = cavities_;
    complex.betti[1] = complex.betti[0] + complex.betti[2] - complex.euler_characteristic();
    return complex;
  }

 private:
  enum class Vertex : std::uint8_t { hidden, seen };
  struct ClassifiedFacet {
    Facet facet;
    Status status;
  };

  bool in_complex(std::size_t c) const { return (mesh_.in_complex[c] & PowerDiagram::whole) != 0; }
  bool finite(const Cell& cell) const {
    return std::find(cell.begin(), cell.end(), PowerDiagram::infinite) == cell.end();
  }

  void classify_cells() {
    std::vector<Cell> inside;
    Lists<Facet> by_lowest(vertices_.size());
    for (std::size_t c = 0; c < mesh_.size(); ++c) {
      if (c % 4096 == 0) monitor_.step(0.25 * static_cast<double>(c) / static_cast<double>(mesh_.size()));
      if (!in_complex(c)) continue;
      Cell cell = mesh_.cells[c];
      sort(cell);
      inside.push_back(cell);
      by_lowest.count(at(cell[0]));
    }
    by_lowest.allocate();
    for (const Cell& c : inside) by_lowest.put(at(c[0]), {c[1], c[2], c[3]});
    tetrahedra_.reserve(inside.size());
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const auto rest = by_lowest[v];
      std::sort(rest.begin(), rest.end());
      for (const Facet& f : rest) tetrahedra_.push_back({static_cast<std::int32_t>(v), f[0], f[1], f[2]});
    }
  }

  void classify_facets() {
    facets_.reserve(2 * mesh_.size());
    DisjointSets voids(mesh_.size());
    cavities_ = static_cast<std::int64_t>(mesh_.size() - tetrahedra_.size()) - 1;
    for (std::size_t c = 0; c < mesh_.size(); ++c) {
      if (c % 4096 == 0)
        monitor_.step(0.25 + 0.35 * static_cast<double>(c) / static_cast<double>(mesh_.size()));
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t n = at(mesh_.neighbors[c][i]);
        if (n < c) continue;  // met from the other side
        const bool in_complex = classify_facet(c, n, i);
        if (!in_complex && voids.join(static_cast<std::int32_t>(c), static_cast<std::int32_t>(n)))
          --cavities_;
      }
    }
  }

  /// The facet of cells c and n opposite corner i of c; true when it is in the complex.
  bool classify_facet(std::size_t c, std::size_t n, std::size_t i) {
    const Cell& cell = mesh_.cells[c];
    Facet facet{cell[(i + 1) & 3], cell[(i + 2) & 3], cell[(i + 3) & 3]};
    sort(facet);
    if (facet[0] == PowerDiagram::infinite) return false;
    Status status = Status::out;
    if (in_complex(c) && in_complex(n)) {
      status = Status::interior;
    } else if (in_complex(c) || in_complex(n)) {
      status = Status::regular;
    } else if ((mesh_.in_complex[c] >> i & 1) != 0) {
      status = Status::singular;
    }
    facets_.push_back({facet, status});
    return status != Status::out;
  }

  /// Simplices of the highest dimension where that is less than 3; none is interior.
  template <std::size_t N, class Add>
  void classify_top(const Add& add) {
    for (std::size_t c = 0; c < mesh_.size(); ++c) {  // in lexicographic order
      const Cell& cell = mesh_.cells[c];
      if (!finite(cell)) continue;
      std::array<std::int32_t, N> top{};
      std::copy_n(cell.begin(), N, top.begin());
      add(top, in_complex(c) ? Status::singular : Status::out);
    }
  }

  /// Every edge is a side of a facet.
  void classify_edges() {
    Lists<Side> own(vertices_.size()),
        far(vertices_.size());  // facets by their lowest and by their middle vertex
    for (const auto& [f, status] : facets_) {
      own.count(at(f[0]));
      far.count(at(f[1]));
    }
    own.allocate();
    far.allocate();
    for (const auto& [f, status] : facets_) {
      own.put(at(f[0]), {f[1], f[2], status});
      far.put(at(f[1]), {f[2], f[0], status});
    }
    monitor_.step(0.65);
    facets_ = {};

    // Blocks of vertices on all cores; what they find is put together in their order.
    constexpr std::size_t block = 512;
    std::vector<Upwards> found((vertices_.size() + block - 1) / block);
    tbb::enumerable_thread_specific<Scratch> scratch([this] { return Scratch(vertices_.size()); });
    SharedProgress progress(monitor_, found.size(), 0.65, 0.9);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t b) {
      Scratch& own_scratch = scratch.local();
      for (std::size_t u = b * block; u < std::min(vertices_.size(), (b + 1) * block); ++u)
        look_upwards(static_cast<std::int32_t>(u), own[u], far[u], own_scratch, found[b]);
      progress.advance(1);
    });
    std::size_t triangles = 0, edges = 0;
    for (const Upwards& part : found) {
      triangles += part.triangles.size();
      edges += part.edges.size();
    }
    triangles_.reserve(triangles);
    triangle_classes_.reserve(triangles);
    edges_.reserve(edges);
    edge_classes_.reserve(edges);
    for (Upwards& part : found) {
      triangles_.insert(triangles_.end(), part.triangles.begin(), part.triangles.end());
      triangle_classes_.insert(triangle_classes_.end(), part.triangle_classes.begin(),
                               part.triangle_classes.end());
      for (const auto& [edge, status] : part.edges) add_edge(edge, status);
      part = {};
    }
    monitor_.step(0.95);
  }

  /// The triangles and edges of which some vertices are the lowest, ascending; of the edges all.
  struct Upwards {
    std::vector<Facet> triangles;
    std::vector<std::uint8_t> triangle_classes;
    std::vector<std::pair<Edge, Status>> edges;
  };
  /// What a thread needs to look upwards from a vertex.
  struct Scratch {
    explicit Scratch(std::size_t vertices) : place(vertices, -1) {}
    std::vector<std::int32_t> place;                       // of the edge to a vertex, in `around`; else -1
    std::vector<std::pair<std::int32_t, Cofaces>> around;  // upper ends of the edges
  };

  /// From vertex u, with the facets of which it is the lowest and the middle vertex.
  void look_upwards(std::int32_t u, std::span<Side> facets, std::span<const Side> others, Scratch& scratch,
                    Upwards& found) const {
    auto& [place, around] = scratch;
    std::sort(facets.begin(), facets.end());
    around.clear();
    const auto join = [&scratch](std::int32_t v, Status status) {
      std::int32_t& number = scratch.place[at(v)];
      if (number < 0) {
        number = static_cast<std::int32_t>(scratch.around.size());
        scratch.around.emplace_back(v, Cofaces());
      }
      scratch.around[at(number)].second.join(status);
    };
    for (const Side side : facets) {
      join(side.first(), side.status());
      join(side.second(), side.status());
      if (side.status() == Status::out) continue;
      found.triangles.push_back({u, side.first(), side.second()});
      found.triangle_classes.push_back(static_cast<std::uint8_t>(simplex_class(side.status())));
    }
    for (const Side side : others) join(side.first(), side.status());
    for (const auto& [v, cofaces] : around) place[at(v)] = -1;
    std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [v, cofaces] : around) {
      Status status = cofaces.status();
      const Edge edge{u, v};
      if (status == Status::out && predicates_.meets(edge) && !attached(edge, facets, others))
        status = Status::singular;
      found.edges.emplace_back(edge, status);
    }
  }

  /// Whether a vertex of the facets around the edge attaches it.
  bool attached(const Edge& edge, std::span<const Side> own, std::span<const Side> far) const {
    const auto attaches = [&](std::int32_t other) { return predicates_.attaches(edge, other); };
    for (const Side side : own) {
      if (side.first() == edge[1] && attaches(side.second())) return true;
      if (side.second() == edge[1] && attaches(side.first())) return true;
    }
    return std::any_of(far.begin(), far.end(),
                       [&](Side side) { return side.first() == edge[1] && attaches(side.second()); });
  }

  void add_edge(const Edge& edge, Status status) {
    for (const std::int32_t v : edge) cofaces_[at(v)].join(status);
    if (status == Status::out) {
      edges_out_.push_back(edge);
    } else {
      edges_.push_back(edge);
      edge_classes_.push_back(static_cast<std::uint8_t>(simplex_class(status)));
    }
  }

  void classify_vertices() {
    // Weights are not negative, so a vertex is in the complex unless a neighbour attaches it.
    std::vector<Status> statuses(vertices_.size(), Status::out);
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (vertices_[v] == Vertex::hidden) continue;
      statuses[v] = cofaces_[v].status();
      if (statuses[v] == Status::out) statuses[v] = Status::singular;
    }
    for (const Edge& e : edges_out_) {
      for (std::size_t k = 0; k < 2; ++k) {
        Status& status = statuses[at(e[k])];
        if (status == Status::singular && predicates_.attaches(e[k], e[1 - k])) status = Status::out;
      }
    }
    for (std::size_t v = 0; v < statuses.size(); ++v) {
      if (statuses[v] == Status::out) continue;
      vertex_ids_.push_back(static_cast<std::int32_t>(v));
      vertex_classes_.push_back(static_cast<std::uint8_t>(simplex_class(statuses[v])));
    }
  }

  const PowerDiagram& mesh_;
  const BallPredicates& predicates_;
  Monitor& monitor_;
  std::vector<ClassifiedFacet> facets_;  // until edges are classified
  std::vector<Edge> edges_out_;          // edges that are not in the complex
  std::vector<Vertex> vertices_;         // per ball
  std::vector<Cofaces> cofaces_;         // per ball: its edges
  std::int64_t cavities_ = 0;

  // The result, ascending.
  std::vector<std::int32_t> vertex_ids_;
  std::vector<Edge> edges_;
  std::vector<Facet> triangles_;
  std::vector<Cell> tetrahedra_;
  std::vector<std::uint8_t> vertex_classes_, edge_classes_, triangle_classes_;
};

}  // namespace

SimplicialComplex alpha_classes(const PowerDiagram& diagram, Monitor& monitor) {
  const BallPredicates predicates(diagram.centers, diagram.weights);
  SimplicialComplex complex = Classification(diagram, predicates, monitor).result();
  complex.centers = diagram.centers;
  complex.weights = diagram.weights;
  complex.delta = diagram.delta;
  return complex;
}

}  // namespace ballflow::geometry
