#include "io/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/first_equal.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;
constexpr Index none = -1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Points in cubic cells whose edge is the greatest distance that is asked for.
class Grid {
 public:
  Grid(std::span<const Vec3> points, double cell)
      : points_(points), cell_(cell), next_(points.size(), none) {}

  void add(Index i) {
    Index& head = heads_[key(cell_of(points_[at(i)]))];
    next_[at(i)] = std::exchange(head, i + 1) - 1;
  }
  /// Calls visit(i) for points in the cell of p and the cells around it, until it returns false.
  template <class Visit>
  void near(const Vec3& p, Visit visit) const {
    const Vec3 cell = cell_of(p);
    for (int k = 0; k < 27; ++k) {
      const auto found = heads_.find(key(cell + Vec3{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0}));
      if (found == heads_.end()) continue;
      for (Index i = found->second - 1; i != none; i = next_[at(i)]) {
        if (!visit(i)) return;
      }
    }
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const double x : key) hash = mix_hash(hash, std::bit_cast<std::uint64_t>(x));
      return hash;
    }
  };
  Vec3 cell_of(const Vec3& p) const {
    return {std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)};
  }
  static Key key(const Vec3& cell) { return {cell.x + 0.0, cell.y + 0.0, cell.z + 0.0}; }  // no -0

  std::span<const Vec3> points_;
  double cell_;
  std::unordered_map<Key, Index, Hash> heads_;  // the first point of a cell, from 1
  std::vector<Index> next_;
};

struct OpenEdge {
  Index a, b;
};

/// The edges that one triangle has, each once.
std::vector<OpenEdge> open_edges(std::span<const Triangle> triangles, Lookout& look) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back(static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high));
    }
  }
  look(edges.size());
  std::sort(edges.begin(), edges.end());
  look(edges.size());
  std::vector<OpenEdge> open;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end == i + 1)
      open.push_back({static_cast<Index>(edges[i] >> 32), static_cast<Index>(edges[i] & 0xffffffffu)});
  }
  return open;
}

/// The next number of two digits that is not smaller.
double rounded_up(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit) * unit;
}

}  // namespace

std::vector<Index> weld(std::span<const Vec3> points, std::span<const Index> first, double tolerance,
                        Monitor& monitor) {
  Lookout look(monitor);
  std::vector<Index> result(first.begin(), first.end());
  Grid grid(points, tolerance);
  for (std::size_t i = 0; i < points.size(); ++i) {
    look(64);
    if (at(first[i]) != i) {
      result[i] = result[at(first[i])];
      continue;
    }
    double best = tolerance;
    Index nearest = none;
    grid.near(points[i], [&](Index other) {
      const double d = distance(points[at(other)], points[i]);
      if (d < best || (d == best && (nearest == none || other < nearest))) {
        best = d;
        nearest = other;
      }
      return true;
    });
    if (nearest == none) {
      grid.add(static_cast<Index>(i));
    } else {
      result[i] = nearest;
    }
  }
  return result;
}

std::optional<SmallGaps> small_gaps(const TriangleMesh& mesh, Monitor& monitor) {
  constexpr double small = 0.05;       // of the median length of open edges
  constexpr int most_neighbours = 64;  // that are looked at; more are no crack
  Lookout look(monitor);
  const std::span<const Vec3> points = mesh.vertices.span();
  const std::vector<OpenEdge> open = open_edges(mesh.triangles.span(), look);
  if (open.empty()) return std::nullopt;
  std::vector<double> lengths;
  std::vector<std::pair<Index, Index>> joined;  // both ways, ascending
  for (const auto& [a, b] : open) {
    lengths.push_back(distance(points[at(a)], points[at(b)]));
    joined.emplace_back(a, b);
    joined.emplace_back(b, a);
  }
  std::sort(joined.begin(), joined.end());
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                   lengths.end());
  const double most = small * lengths[lengths.size() / 2];
  if (!(most > 0)) return std::nullopt;

  std::vector<Index> rim;
  for (const auto& [a, b] : joined) {
    if (rim.empty() || rim.back() != a) rim.push_back(a);
  }
  Grid grid(points, most);
  for (const Index v : rim) grid.add(v);
  SmallGaps gaps;
  gaps.open_edges = static_cast<std::int64_t>(open.size());
  for (const Index v : rim) {
    double nearest = std::numeric_limits<double>::infinity();
    int seen = 0;
    grid.near(points[at(v)], [&](Index other) {
      look(1);
      const double d = distance(points[at(v)], points[at(other)]);
      if (other != v && d < nearest && !std::binary_search(joined.begin(), joined.end(), std::pair(v, other)))
        nearest = d;
      return ++seen < most_neighbours;
    });
    if (nearest <= most) gaps.widest = std::max(gaps.widest, nearest);
  }
  if (gaps.widest == 0) return std::nullopt;
  // Where several vertices belong together, the farthest two may be apart more than neighbours are.
  std::vector<Index> self(points.size());
  for (std::size_t i = 0; i < self.size(); ++i) self[i] = static_cast<Index>(i);
  gaps.left = gaps.open_edges;
  for (double tolerance = rounded_up(gaps.widest); tolerance <= most; tolerance = rounded_up(2 * tolerance)) {
    const std::vector<Index> welded = weld(points, self, tolerance, monitor);
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles) {
      const Triangle w{welded[at(t[0])], welded[at(t[1])], welded[at(t[2])]};
      if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) triangles.push_back(w);
    }
    const auto left = static_cast<std::int64_t>(open_edges(triangles, look).size());
    if (left < gaps.left) {
      gaps.left = left;
      gaps.tolerance = tolerance;
    }
    if (left == 0) break;
  }
  if (2 * gaps.left > gaps.open_edges) return std::nullopt;
  return gaps;
}

}  // namespace ballflow::geometry
