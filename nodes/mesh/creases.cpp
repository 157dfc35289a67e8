#include "mesh/creases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "base/for_each_block.hpp"
#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t none = -1;
constexpr std::size_t block = 1024;

// In cells, of which the error that is asked for is four tenths. On fertility (511 balls) notches from 0, .1,
// .2 gave 159 000, 116 000, 107 000 triangles and the same error.
constexpr double shallow = 0.2;       // a notch that is not worth a vertex
constexpr double dispensable = 0.25;  // one without which the mesh is still near enough
constexpr double far = 3;             // a place that belongs to another part of the mesh
constexpr double close = 0.02;        // vertices nearer than this make needles
constexpr double rounding = 1e-6;     // as far may a place be inside a ball

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Creases {
 public:
  Creases(const Balls& balls, const BoxTree& tree, std::span<const std::int32_t> spheres, double cell,
          std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, Monitor& monitor)
      : balls_(balls),
        tree_(tree),
        spheres_(spheres),
        cell_(cell),
        vertices_(vertices),
        triangles_(triangles),
        monitor_(monitor) {}

  double run() {
    find_edges();
    place();
    unfold();
    number();
    split();
    return measure();
  }

 private:
  /// A vertex that may come.
  struct Split {
    Vec3 place;
    double depth = 0;  // how far that is from the edge or triangle
    bool wanted = false;
    std::int32_t vertex = none;
  };
  struct Edge {
    std::int32_t from, to;  // from < to
    std::int32_t next;      // of the edges with the same `from`, or none
    Split split;
    Vec3 crossing{};  // where it goes from one sphere to the other
  };
  /// A triangle between different spheres.
  struct Mixed {
    std::int32_t triangle;
    std::array<std::int32_t, 3> spheres;
    std::array<std::int32_t, 3> edges;  // between different spheres, the one after a corner; or none
    Split split;
    std::size_t first_piece = 0, last_piece = 0;
  };

  std::int32_t sphere(std::int32_t v) const { return spheres_[at(v)]; }
  double radius(std::int32_t i) const { return balls_.radii[at(i)]; }
  Vec3 center(std::int32_t i) const { return balls_.centers[at(i)]; }
  Vec3 vertex(std::int32_t v) const { return vertices_[at(v)]; }

  void find_edges() {
    Lookout look(monitor_);
    std::vector<std::int32_t> first(vertices_.size(), none);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      look(4);
      const auto [a, b, c] = triangles_[t];
      if (sphere(a) == sphere(b) && sphere(a) == sphere(c)) continue;
      mixed_.push_back(
          {static_cast<std::int32_t>(t), {sphere(a), sphere(b), sphere(c)}, {none, none, none}, {}});
      for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        if (u > v || sphere(u) == sphere(v)) continue;
        const auto e = static_cast<std::int32_t>(edges_.size());
        edges_.push_back({u, v, std::exchange(first[at(u)], e), {}});
      }
    }
    for (Mixed& m : mixed_) {
      look(16);
      const Triangle& t = triangles_[at(m.triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [u, v] = std::minmax(t[k], t[(k + 1) % 3]);
        if (sphere(u) == sphere(v)) continue;
        std::int32_t e = first[at(u)];
        while (edges_[at(e)].to != v) e = edges_[at(e)].next;
        m.edges[k] = e;
      }
    }
  }

  /// The ball in which p is deepest, or none.
  std::int32_t ball_around(Vec3 p) const {
    std::int32_t deepest = none;
    double least = -rounding * cell_;
    tree_.smallest(p, least, -infinity, [&](std::size_t i) {
      const double value = distance(p, balls_.centers[i]) - balls_.radii[i];
      if (value < least) {
        least = value;
        deepest = static_cast<std::int32_t>(i);
      }
      return value;
    });
    return deepest;
  }

  /// Where the edge is to be split.
  std::optional<Split> split_of(Edge& e) const {
    const std::int32_t i = sphere(e.from), j = sphere(e.to);
    const Vec3 u = vertex(e.from), v = vertex(e.to), between = center(j) - center(i);
    e.crossing = 0.5 * (u + v);
    const double d = length(between);
    if (!(d > 0)) return {};
    const double along = (d * d + radius(i) * radius(i) - radius(j) * radius(j)) / (2 * d);
    const double squared = radius(i) * radius(i) - along * along;
    if (!(squared > 0)) return {};
    const Vec3 axis = 1 / d * between, middle = center(i) + along * axis;
    // Each end is in the cell of its sphere of the power diagram, but for rounding.
    const double before = dot(u - middle, axis), after = dot(v - middle, axis);
    const double t = before < 0 && after > 0 ? -before / (after - before) : 0.5;
    const Vec3 x = u + t * (v - u), from_middle = x - middle;
    e.crossing = x;
    const Vec3 out = from_middle - dot(from_middle, axis) * axis;
    const double l = length(out);
    if (!(l > 0)) return {};
    Vec3 p = middle + std::sqrt(squared) / l * out;
    for (int rounds = 0;; ++rounds) {
      const double depth = distance(p, x);
      if (!(depth >= shallow * cell_ && depth <= far * cell_)) return {};
      if (std::min(distance(p, u), distance(p, v)) < close * cell_) return {};
      const std::int32_t ball = ball_around(p);
      if (ball == none) return Split{p, depth, true, none};
      if (rounds == 4) return {};
      const Vec3 way = x - p, from = p - center(ball);
      const double half = dot(from, way), ww = depth * depth;
      const double rest = squared_length(from) - radius(ball) * radius(ball);
      const double exit = (-half + std::sqrt(std::max(0.0, half * half - ww * rest))) / ww;
      if (!(exit < 1)) return {};
      p = p + exit * way;
    }
  }

  /// Where the triangle is to be split.
  std::optional<Split> split_of(const Mixed& m) const {
    const Triangle& t = triangles_[at(m.triangle)];
    const auto [i, j, k] = m.spheres;
    if (i == j || j == k || k == i) return {};
    const Vec3 u = vertex(t[0]), v = vertex(t[1]), w = vertex(t[2]);
    const Vec3 x = (1.0 / 3) * (u + v + w), across = cross(v - u, w - u);
    const Vec3 a = center(j) - center(i), b = center(k) - center(i), n = cross(a, b);
    const double aa = squared_length(a), bb = squared_length(b), nn = squared_length(n);
    if (!(nn > 1e-12 * aa * bb) || !(squared_length(across) > 0)) return {};
    const double ri = radius(i) * radius(i);
    const double alpha = 0.5 * (aa + ri - radius(j) * radius(j));
    const double beta = 0.5 * (bb + ri - radius(k) * radius(k));
    const Vec3 foot = (1 / nn) * (alpha * cross(b, n) + beta * cross(n, a));
    const double squared = (ri - squared_length(foot)) / nn;
    if (!(squared > 0)) return {};
    const Vec3 middle = center(i) + foot;
    const Vec3 p = middle + (dot(x - middle, n) < 0 ? -1 : 1) * std::sqrt(squared) * n;
    const double depth = std::abs(dot(p - u, across)) / length(across);
    if (!(depth >= shallow * cell_) || !(distance(p, x) <= far * cell_)) return {};
    if (std::min({distance(p, u), distance(p, v), distance(p, w)}) < close * cell_) return {};
    for (const std::int32_t e : m.edges) {
      const Split& split = edges_[at(e)].split;
      if (split.wanted && distance(split.place, p) < close * cell_) return {};
    }
    if (ball_around(p) != none) return {};
    return Split{p, depth, true, none};
  }

  void place() {
    const auto place_all = [&](auto& things, double begin, double end) {
      for_each_block(things.size(), block, monitor_, begin, end,
                     [&](std::size_t, std::size_t first, std::size_t last) {
                       Lookout look(monitor_);
                       for (std::size_t k = first; k < last; ++k) {
                         look(4096);
                         if (const auto split = split_of(things[k])) things[k].split = *split;
                       }
                     });
    };
    place_all(edges_, 0, 0.4);
    place_all(mixed_, 0.4, 0.5);
  }

  /// Whether a piece would face into the ball whose boundary it is near to. Pieces between two spheres do not
  /// tell.
  bool folds(const Mixed& m) const {
    const Triangle& t = triangles_[at(m.triangle)];
    std::array<const Split*, 3> on{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (m.edges[k] != none && edges_[at(m.edges[k])].split.wanted) on[k] = &edges_[at(m.edges[k])].split;
    }
    const auto inwards = [&](std::int32_t v, Vec3 a, Vec3 b, Vec3 c) {
      return !(dot(cross(b - a, c - a), vertex(v) - center(sphere(v))) > 0);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t u = t[k], v = t[(k + 1) % 3];
      const Split *next = on[k], *last = on[(k + 2) % 3];
      if (m.split.wanted) {
        if (next != nullptr && inwards(u, m.split.place, vertex(u), next->place)) return true;
        if (last != nullptr && inwards(u, m.split.place, last->place, vertex(u))) return true;
        continue;
      }
      if (next != nullptr && last != nullptr && inwards(u, vertex(u), next->place, last->place)) return true;
      if (sphere(u) != sphere(v)) continue;
      // The edge of one sphere, and what splits the other two.
      for (const Split* s : {on[(k + 1) % 3], last}) {
        if (s != nullptr && inwards(u, vertex(u), vertex(v), s->place)) return true;
      }
    }
    return false;
  }

  /// Of what splits its edges, or null.
  Split* shallowest(const Mixed& m) {
    Split* least = nullptr;
    for (const std::int32_t e : m.edges) {
      if (e == none || !edges_[at(e)].split.wanted) continue;
      if (least == nullptr || edges_[at(e)].split.depth < least->depth) least = &edges_[at(e)].split;
    }
    return least;
  }

  /// Does without splits that would fold triangles, where it can.
  void unfold() {
    std::vector<std::uint8_t> bad(mixed_.size());
    for (int rounds = 0; rounds < 4; ++rounds) {
      for_each_block(mixed_.size(), block, monitor_, 0.5, 0.6,
                     [&](std::size_t, std::size_t first, std::size_t last) {
                       for (std::size_t m = first; m < last; ++m) bad[m] = folds(mixed_[m]) ? 1 : 0;
                     });
      bool changed = false;
      for (std::size_t m = 0; m < mixed_.size(); ++m) {
        if (bad[m] == 0) continue;
        Split* least = mixed_[m].split.wanted ? &mixed_[m].split : shallowest(mixed_[m]);
        if (least == nullptr || least->depth > dispensable * cell_) continue;
        least->wanted = false;
        changed = true;
      }
      if (!changed) break;
    }
  }

  void number() {
    const auto add = [&](Split& split) {
      if (!split.wanted) return;
      split.vertex = index_of(vertices_.size(), "vertices of the mesh");
      vertices_.push_back(split.place);
    };
    Lookout look(monitor_);
    look(8 * (edges_.size() + mixed_.size()));
    for (Edge& e : edges_) add(e.split);
    for (Mixed& m : mixed_) add(m.split);
  }

  void split() {
    Lookout look(monitor_);
    std::vector<Triangle> all;
    all.reserve(triangles_.size() + 3 * mixed_.size());
    auto next = triangles_.begin();
    for (Mixed& m : mixed_) {
      const auto here = triangles_.begin() + m.triangle;
      look(16);
      all.insert(all.end(), next, here);
      next = here + 1;
      m.first_piece = all.size();
      add_pieces(m, all);
      m.last_piece = all.size();
    }
    all.insert(all.end(), next, triangles_.end());
    triangles_ = std::move(all);
  }

  void add_pieces(const Mixed& m, std::vector<Triangle>& out) const {
    const Triangle& t = triangles_[at(m.triangle)];
    // The triangle is a polygon, with its corners and what splits its edges.
    std::array<std::int32_t, 3> on{none, none, none};
    for (std::size_t k = 0; k < 3; ++k) {
      if (m.edges[k] != none) on[k] = edges_[at(m.edges[k])].split.vertex;
    }
    if (m.split.vertex != none) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t u = t[k], v = t[(k + 1) % 3];
        if (on[k] != none) out.push_back({m.split.vertex, u, on[k]});
        out.push_back({m.split.vertex, on[k] != none ? on[k] : u, v});
      }
      return;
    }
    const auto count = 3 - std::count(on.begin(), on.end(), none);
    if (count == 0) {
      out.push_back(t);
    } else if (count == 1) {
      const std::size_t k = on[0] != none ? 0 : on[1] != none ? 1 : 2;
      out.push_back({t[k], on[k], t[(k + 2) % 3]});
      out.push_back({on[k], t[(k + 1) % 3], t[(k + 2) % 3]});
    } else if (count == 2) {
      const std::size_t k = on[0] == none ? 2 : on[1] == none ? 0 : 1;  // the corner between both
      const std::int32_t b = t[(k + 1) % 3], c = t[(k + 2) % 3], p = on[k], q = on[(k + 2) % 3];
      out.push_back({t[k], p, q});
      if (squared_distance(vertex(p), vertex(c)) <= squared_distance(vertex(q), vertex(b))) {
        out.push_back({p, b, c});
        out.push_back({p, c, q});
      } else {
        out.push_back({p, b, q});
        out.push_back({q, b, c});
      }
    } else {
      for (std::size_t k = 0; k < 3; ++k) out.push_back({t[k], on[k], on[(k + 2) % 3]});
      out.push_back({on[0], on[1], on[2]});
    }
  }

  /// Distances from the boundary of places that are near each other.
  class Distances {
   public:
    Distances(const Balls& balls, const BoxTree& tree, double reach)
        : balls_(balls), tree_(tree), reach_(reach) {}

    /// The larger one of `most` and the distance of p. p is near the given spheres.
    double larger(double most, Vec3 p, const std::array<std::int32_t, 3>& spheres) {
      const auto value = [&](std::size_t i) { return distance(p, balls_.centers[i]) - balls_.radii[i]; };
      if (!(distance(p, middle_) <= reach_)) look_around(p);
      double least = infinity;
      if (few_) {
        for (const std::size_t i : around_) least = std::min(least, value(i));
        return std::max(most, std::abs(least));
      }
      for (const std::int32_t i : spheres) least = std::min(least, value(at(i)));
      // Where p is not farther outside than others were, only a ball counts in which it is deeper than
      // others.
      const double limit = least > most ? least : std::min(least, -most);
      return std::max(most, std::abs(tree_.smallest(p, limit, -infinity, value)));
    }

   private:
    /// Finds the balls in one of which each place within reach of p is deepest.
    void look_around(Vec3 p) {
      const auto value = [&](std::size_t i) { return distance(p, balls_.centers[i]) - balls_.radii[i]; };
      const double limit = tree_.smallest(p, infinity, -infinity, value) + 2.01 * reach_;
      middle_ = p;
      around_.clear();
      tree_.below(p, limit, [&](std::size_t i) {
        if (value(i) < limit) around_.push_back(i);
      });
      few_ = around_.size() <= 48;
    }

    const Balls& balls_;
    const BoxTree& tree_;
    const double reach_;
    Vec3 middle_{infinity, infinity, infinity};
    std::vector<std::size_t> around_;
    bool few_ = false;
  };

  double measure() const {
    std::vector<double> most(blocks_of(mixed_.size(), block), 0);
    for_each_block(
        mixed_.size(), block, monitor_, 0.6, 1, [&](std::size_t b, std::size_t first, std::size_t last) {
          Lookout look(monitor_);
          Distances distances(balls_, tree_, cell_);
          for (std::size_t m = first; m < last; ++m) {
            const auto look_at = [&](Vec3 p) { most[b] = distances.larger(most[b], p, mixed_[m].spheres); };
            for (const std::int32_t e : mixed_[m].edges) {
              if (e != none && edges_[at(e)].split.vertex == none) look_at(edges_[at(e)].crossing);
            }
            for (std::size_t f = mixed_[m].first_piece; f < mixed_[m].last_piece; ++f) {
              look(256 + balls_.size());
              const Triangle& t = triangles_[f];
              const Vec3 sum = vertex(t[0]) + vertex(t[1]) + vertex(t[2]);
              look_at((1.0 / 3) * sum);
              for (std::size_t k = 0; k < 3; ++k) {
                look_at(0.5 * vertex(t[k]) + (1.0 / 6) * sum);
                // Every edge is in two triangles, once in each direction.
                if (t[k] < t[(k + 1) % 3]) look_at(0.5 * (vertex(t[k]) + vertex(t[(k + 1) % 3])));
              }
            }
          }
        });
    return most.empty() ? 0 : *std::max_element(most.begin(), most.end());
  }

  const Balls& balls_;
  const BoxTree& tree_;
  const std::span<const std::int32_t> spheres_;
  const double cell_;
  std::vector<Vec3>& vertices_;
  std::vector<Triangle>& triangles_;
  Monitor& monitor_;
  std::vector<Edge> edges_;
  std::vector<Mixed> mixed_;
};

}  // namespace

double add_creases(const Balls& balls, const BoxTree& tree, std::span<const std::int32_t> spheres,
                   double cell, std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                   Monitor& monitor) {
  return Creases(balls, tree, spheres, cell, vertices, triangles, monitor).run();
}

}  // namespace ballflow::geometry
