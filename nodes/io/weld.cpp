#include "io/weld.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/first_equal.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;
constexpr Index none = -1;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Points in a table by cubic cells, whose edges are twice the greatest distance that is asked for: what is
/// near a point is in the eight cells around the corner that is next to it. Cells may share a place in the
/// table, so visitors look at distances.
class Grid {
 public:
  Grid(std::span<const Vec3> points, double reach)
      : points_(points),
        cell_(2 * reach),
        heads_(std::bit_ceil(points.size() + 1), none),
        next_(points.size(), none) {}

  void add(Index i) {
    const Vec3& p = points_[at(i)];
    Index& head = heads_[place({std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)})];
    next_[at(i)] = std::exchange(head, i);
  }
  /// Calls visit(i) for all points near p, some perhaps twice, and for some others, until it returns false.
  template <class Visit>
  void near(const Vec3& p, Visit visit) const {
    const Vec3 corner{std::floor(p.x / cell_ - 0.5), std::floor(p.y / cell_ - 0.5),
                      std::floor(p.z / cell_ - 0.5)};
    for (int k = 0; k < 8; ++k) {
      for (Index i = heads_[place(corner + Vec3{k % 2 + 0.0, k / 2 % 2 + 0.0, k / 4 + 0.0})]; i != none;
           i = next_[at(i)]) {
        if (!visit(i)) return;
      }
    }
  }

 private:
  std::size_t place(const Vec3& cell) const {
    std::uint64_t hash = 0;
    for (const double x : {cell.x, cell.y, cell.z})
      hash = mix_hash(hash, std::bit_cast<std::uint64_t>(x + 0.0));
    return mix_hash(hash, hash >> 32) & (heads_.size() - 1);
  }

  std::span<const Vec3> points_;
  double cell_;
  std::vector<Index> heads_, next_;
};

struct OpenEdge {
  Index a, b;
};

/// The edges that one triangle has, each once, ascending; vertices are below `count`.
std::vector<OpenEdge> open_edges(std::span<const Triangle> triangles, std::size_t count, Lookout& look) {
  // By their smaller vertices, which leaves a few edges to sort at a time: that can be cancelled.
  std::vector<std::size_t> begins(count + 1, 0);
  const auto for_each_edge = [&](auto visit) {
    for (const Triangle& t : triangles) {
      look(3);
      for (std::size_t k = 0; k < 3; ++k)
        visit(std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]));
    }
  };
  for_each_edge([&](Index low, Index) { ++begins[at(low) + 1]; });
  for (std::size_t v = 0; v < count; ++v) begins[v + 1] += begins[v];
  std::vector<std::size_t> ends(begins.begin(), begins.end() - 1);
  std::vector<Index> others(3 * triangles.size());
  for_each_edge([&](Index low, Index high) { others[ends[at(low)]++] = high; });
  std::vector<OpenEdge> open;
  for (std::size_t v = 0; v < count; ++v) {
    const auto first = others.begin() + static_cast<std::ptrdiff_t>(begins[v]),
               last = others.begin() + static_cast<std::ptrdiff_t>(begins[v + 1]);
    look(1 + 8 * (begins[v + 1] - begins[v]));
    std::sort(first, last);
    for (auto i = first, end = first; i != last; i = end) {
      while (end != last && *end == *i) ++end;
      if (end == i + 1) open.push_back({static_cast<Index>(v), *i});
    }
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
  const std::vector<OpenEdge> open = open_edges(mesh.triangles.span(), points.size(), look);
  if (open.empty()) return std::nullopt;
  std::vector<double> lengths;
  std::vector<std::pair<Index, Index>> joined;  // both ways, ascending
  for (const auto& [a, b] : open) {
    look(4);
    lengths.push_back(distance(points[at(a)], points[at(b)]));
    joined.emplace_back(a, b);
    joined.emplace_back(b, a);
  }
  std::sort(joined.begin(), joined.end(), [&look](const auto& a, const auto& b) {
    look(1);
    return a < b;
  });
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                   lengths.end());
  const double most = small * lengths[lengths.size() / 2];
  if (!(most > 0)) return std::nullopt;

  std::vector<Index> rim;
  for (const auto& [a, b] : joined) {
    if (rim.empty() || rim.back() != a) rim.push_back(a);
  }
  Grid grid(points, most);
  for (const Index v : rim) {
    look(16);
    grid.add(v);
  }
  SmallGaps gaps;
  gaps.open_edges = static_cast<std::int64_t>(open.size());
  for (const Index v : rim) {
    look(128);
    double nearest = std::nextafter(most, std::numeric_limits<double>::infinity());
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
      look(3);
      const Triangle w{welded[at(t[0])], welded[at(t[1])], welded[at(t[2])]};
      if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) triangles.push_back(w);
    }
    const auto left = static_cast<std::int64_t>(open_edges(triangles, points.size(), look).size());
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
