#include "mesh/grid_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "mesh/creases.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// The edges of the tetrahedra that begin at a corner, by the bits x = 1, y = 2, z = 4 of their step: 1 .. 7.
// Edges 1, 2 and 3 stay in the layer of the corner.
constexpr std::size_t edges_of_corner = 8;

/// The six tetrahedra of a cell around its diagonal, positively oriented; corners by the bits of their place
/// in it.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// A few balls without repetition.
class Nearby {
 public:
  void clear() { count_ = 0; }
  void add(std::int32_t ball) {
    if (ball < 0) return;
    for (std::size_t k = count_; k-- > 0;) {
      if (balls_[k] == ball) return;
    }
    balls_[count_++] = ball;
  }
  const std::int32_t* begin() const { return balls_.data(); }
  const std::int32_t* end() const { return balls_.data() + count_; }

 private:
  std::array<std::int32_t, 64> balls_{};
  std::size_t count_ = 0;
};

class Grid {
 public:
  Grid(const Balls& balls, double cell, Monitor& monitor)
      : balls_(balls), cell_(cell), monitor_(monitor), tree_(balls.centers.span()) {
    tree_.set_slacks(balls.radii);
    const Box box = bounding_box(balls);
    middle_ = 0.5 * (box.lower + box.upper);
    const Vec3 size = box.upper - box.lower;
    for (const auto& [axis, length] : {std::pair(0, size.x), std::pair(1, size.y), std::pair(2, size.z)}) {
      // Two layers of corners outside on either side.
      const double steps = std::ceil(length / cell) + 4;
      count_[at(axis)] = steps < 1e9 ? static_cast<std::int64_t>(steps) + 1 : 1000000000;
    }
  }

  double corners() const {
    return static_cast<double>(count_[0]) * static_cast<double>(count_[1]) * static_cast<double>(count_[2]);
  }

  std::optional<GridMesh> run(std::size_t most_faces) {
    fill();
    number_edges();
    if (static_cast<double>(first_vertex_.back()) > 0.6 * static_cast<double>(most_faces)) return {};
    place_vertices();
    GridMesh mesh = triangles();
    if (mesh.mesh.triangles.size() > most_faces) return {};
    return mesh;
  }

 private:
  struct Corner {
    float power;        // of the corner to the ball, divided by the squared edge of a cell: negative inside
    std::int32_t ball;  // or -1
  };

  std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return at((z * count_[1] + y) * count_[0] + x);
  }
  double coordinate(double middle, std::int64_t i, int axis) const {
    return middle + (static_cast<double>(i) - 0.5 * static_cast<double>(count_[at(axis)] - 1)) * cell_;
  }
  Vec3 position(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return {coordinate(middle_.x, x, 0), coordinate(middle_.y, y, 1), coordinate(middle_.z, z, 2)};
  }
  /// Corners within `radius` of p along an axis.
  std::pair<std::int64_t, std::int64_t> range(double p, double middle, double radius, int axis) const {
    const double half = 0.5 * static_cast<double>(count_[at(axis)] - 1), c = (p - middle) / cell_ + half;
    const auto low = static_cast<std::int64_t>(std::ceil(c - radius / cell_));
    const auto high = static_cast<std::int64_t>(std::floor(c + radius / cell_));
    return {std::max<std::int64_t>(low, 1), std::min(high, count_[at(axis)] - 2)};
  }

  /// Every corner learns to which ball it has the least power, if it is in the union.
  void fill() {
    const std::size_t layer = at(count_[0]) * at(count_[1]);
    corners_ = std::make_unique_for_overwrite<Corner[]>(layer * at(count_[2]));
    const double scale = 1 / (cell_ * cell_);
    for_each_block(at(count_[2]), 4, monitor_, 0, 0.3, [&](std::size_t, std::size_t first, std::size_t last) {
      Lookout look(monitor_);
      for (std::size_t z = first; z < last; ++z) {
        look(layer);
        std::fill_n(corners_.get() + z * layer, layer, Corner{0, -1});
      }
      for (std::size_t i = 0; i < balls_.size(); ++i) {
        look(4);
        const Vec3 c = balls_.centers[i];
        const double r = balls_.radii[i], r2 = r * r;
        const auto zs = range(c.z, middle_.z, r, 2);
        for (std::int64_t z = std::max(zs.first, static_cast<std::int64_t>(first));
             z <= std::min(zs.second, static_cast<std::int64_t>(last) - 1); ++z) {
          const double dz = coordinate(middle_.z, z, 2) - c.z, in_layer = r2 - dz * dz;
          if (in_layer < 0) continue;
          const auto ys = range(c.y, middle_.y, std::sqrt(in_layer), 1);
          for (std::int64_t y = ys.first; y <= ys.second; ++y) {
            const double dy = coordinate(middle_.y, y, 1) - c.y, in_row = in_layer - dy * dy;
            if (in_row < 0) continue;
            const auto xs = range(c.x, middle_.x, std::sqrt(in_row), 0);
            Corner* row = corners_.get() + slot(0, y, z);
            look(at(std::max<std::int64_t>(0, xs.second - xs.first)));
            for (std::int64_t x = xs.first; x <= xs.second; ++x) {
              const double dx = coordinate(middle_.x, x, 0) - c.x;
              const auto power = static_cast<float>((dx * dx - in_row) * scale);
              if (power < row[x].power) row[x] = {power, static_cast<std::int32_t>(i)};
            }
          }
        }
      }
    });
  }

  bool inside(std::size_t corner) const { return corners_[corner].ball >= 0; }
  std::size_t step(int bits) const {
    return ((bits & 1) != 0 ? 1U : 0U) + ((bits & 2) != 0 ? at(count_[0]) : 0U) +
           ((bits & 4) != 0 ? at(count_[0]) * at(count_[1]) : 0U);
  }

  /// Calls visit(x, y, bits) for the edges of a layer that the mesh crosses, in a fixed order. The last layer
  /// in every direction is outside, so no edge leaves the grid there.
  template <class Visit>
  void for_each_edge(std::int64_t z, const Visit& visit) const {
    if (z + 1 >= count_[2]) return;
    std::array<std::size_t, edges_of_corner> steps{};
    for (int bits = 1; bits < 8; ++bits) steps[at(bits)] = step(bits);
    for (std::int64_t y = 0; y + 1 < count_[1]; ++y) {
      const std::size_t row = slot(0, y, z);
      for (std::int64_t x = 0; x + 1 < count_[0]; ++x) {
        const std::size_t corner = row + at(x);
        const bool here = inside(corner);
        for (int bits = 1; bits < 8; ++bits) {
          if (inside(corner + steps[at(bits)]) != here) visit(x, y, bits);
        }
      }
    }
  }

  void number_edges() {
    std::vector<std::size_t> counts(at(count_[2]));
    for_each_block(
        counts.size(), 4, monitor_, 0.3, 0.4, [&](std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t z = first; z < last; ++z) {
            std::size_t count = 0;
            for_each_edge(static_cast<std::int64_t>(z), [&](std::int64_t, std::int64_t, int) { ++count; });
            counts[z] = count;
          }
        });
    first_vertex_.assign(counts.size() + 1, 0);
    for (std::size_t z = 0; z < counts.size(); ++z) first_vertex_[z + 1] = first_vertex_[z] + counts[z];
    index_of(first_vertex_.back(), "vertices of the mesh");
  }

  /// Balls of the corners of a box, and of those next to it.
  void nearby(std::int64_t x, std::int64_t y, std::int64_t z, int bits, Nearby& balls) const {
    balls.clear();
    const auto last = [&](std::int64_t i, int bit, int axis) {
      return std::min(count_[at(axis)] - 1, i + 1 + ((bits & bit) != 0 ? 1 : 0));
    };
    for (std::int64_t c = std::max<std::int64_t>(z - 1, 0); c <= last(z, 4, 2); ++c) {
      for (std::int64_t b = std::max<std::int64_t>(y - 1, 0); b <= last(y, 2, 1); ++b) {
        for (std::int64_t a = std::max<std::int64_t>(x - 1, 0); a <= last(x, 1, 0); ++a)
          balls.add(corners_[slot(a, b, c)].ball);
      }
    }
  }

  /// Where the way from p, in `ball`, to q leaves the union: a fraction of it. `ball` becomes the one it
  /// leaves last.
  double exit(Vec3 p, Vec3 q, std::int32_t& ball, const Nearby& balls) const {
    const Vec3 d = q - p;
    const double dd = squared_length(d);
    double t = 0;
    for (int rounds = 0; rounds < 8; ++rounds) {
      const auto i = at(ball);
      const Vec3 from = p - balls_.centers[i];
      const double half = dot(from, d), rest = squared_length(from) - balls_.radii[i] * balls_.radii[i];
      t = std::max(t, (-half + std::sqrt(std::max(0.0, half * half - dd * rest))) / dd);
      if (t >= 1) break;
      const Vec3 x = p + t * d;
      // Of the balls that go on, the one in which x is deepest.
      double deepest = -1e-12 * dd;
      std::int32_t next = -1;
      for (const std::int32_t b : balls) {
        const double power =
            squared_distance(x, balls_.centers[at(b)]) - balls_.radii[at(b)] * balls_.radii[at(b)];
        if (b != ball && power < deepest) {
          deepest = power;
          next = b;
        }
      }
      if (next < 0) break;
      ball = next;
    }
    return std::clamp(t, 0.001, 0.999);
  }

  void place_vertices() {
    vertices_.resize(first_vertex_.back());
    spheres_.resize(first_vertex_.back());
    for_each_block(
        at(count_[2]), 4, monitor_, 0.4, 0.6, [&](std::size_t, std::size_t first, std::size_t last) {
          Nearby balls;
          for (std::size_t layer = first; layer < last; ++layer) {
            const auto z = static_cast<std::int64_t>(layer);
            std::size_t next = first_vertex_[layer];
            for_each_edge(z, [&](std::int64_t x, std::int64_t y, int bits) {
              const std::size_t a = slot(x, y, z), b = a + step(bits);
              Vec3 p = position(x, y, z), q = position(x + (bits & 1), y + (bits >> 1 & 1), z + (bits >> 2));
              std::int32_t ball = corners_[a].ball;
              if (ball < 0) {
                std::swap(p, q);
                ball = corners_[b].ball;
              }
              nearby(x, y, z, bits, balls);
              vertices_[next] = p + exit(p, q, ball, balls) * (q - p);
              spheres_[next++] = ball;
            });
          }
        });
  }

  /// The vertices on the edges of a layer, by corner and step; `none` elsewhere.
  using LayerEdges = std::vector<std::int32_t>;
  void table_of(std::int64_t z, LayerEdges& edges) const {
    edges.resize(at(count_[0]) * at(count_[1]) * edges_of_corner);
    auto next = static_cast<std::int32_t>(first_vertex_[at(z)]);
    for_each_edge(z, [&](std::int64_t x, std::int64_t y, int bits) {
      edges[(at(y) * at(count_[0]) + at(x)) * edges_of_corner + at(bits)] = next++;
    });
  }

  GridMesh triangles() {
    constexpr std::size_t block = 4;
    struct Part {
      std::vector<Triangle> triangles;
      double error = 0;
    };
    std::vector<Part> parts(blocks_of(at(count_[2] - 1), block));
    for_each_block(at(count_[2] - 1), block, monitor_, 0.6, 0.8,
                   [&](std::size_t b, std::size_t first, std::size_t last) {
                     LayerEdges low, high;
                     table_of(static_cast<std::int64_t>(first), low);
                     for (std::size_t z = first; z < last; ++z) {
                       table_of(static_cast<std::int64_t>(z) + 1, high);
                       add_layer(static_cast<std::int64_t>(z), low, high, parts[b].triangles, parts[b].error);
                       std::swap(low, high);
                     }
                   });
    GridMesh result;
    std::size_t faces = 0;
    for (const Part& part : parts) faces += part.triangles.size();
    std::vector<Triangle> all;
    all.reserve(faces);
    Lookout look(monitor_);
    for (Part& part : parts) {
      look(16 * part.triangles.size());
      all.insert(all.end(), part.triangles.begin(), part.triangles.end());
      result.error = std::max(result.error, part.error);
    }
    result.first_split = static_cast<std::int32_t>(vertices_.size());
    PartMonitor creasing(monitor_, 0.8, 1);
    result.error =
        std::max(result.error, add_creases(balls_, tree_, spheres_, cell_, vertices_, all, creasing));
    result.mesh = {std::move(vertices_), std::move(all)};
    return result;
  }

  void add_layer(std::int64_t z, const LayerEdges& low, const LayerEdges& high, std::vector<Triangle>& out,
                 double& error) const {
    std::array<std::size_t, 8> steps{};
    for (int bits = 0; bits < 8; ++bits) steps[at(bits)] = step(bits);
    Nearby balls;
    std::vector<std::int32_t> deepest;
    Lookout look(monitor_);
    for (std::int64_t y = 0; y + 1 < count_[1]; ++y) {
      for (std::int64_t x = 0; x + 1 < count_[0]; ++x) {
        const std::size_t corner = slot(x, y, z);
        unsigned mask = 0;
        for (int k = 0; k < 8; ++k) mask |= inside(corner + steps[at(k)]) ? 1U << k : 0U;
        if (mask == 0 || mask == 255) continue;
        const auto vertex = [&](int a, int b) {  // on the edge between two corners of the cell
          const int from = std::min(a, b), bits = std::max(a, b) - from;
          const LayerEdges& edges = (from & 4) != 0 ? high : low;
          const std::int64_t at_y = y + (from >> 1 & 1), at_x = x + (from & 1);
          return edges[(at(at_y) * at(count_[0]) + at(at_x)) * edges_of_corner + at(bits)];
        };
        const std::size_t begin = out.size();
        for (const auto& t : tetrahedra) cut(t, mask, vertex, out);
        // Those between spheres are split, and measured then.
        const auto on_one = [&](const Triangle& t) {
          return spheres_[at(t[0])] == spheres_[at(t[1])] && spheres_[at(t[0])] == spheres_[at(t[2])];
        };
        if (std::none_of(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(), on_one)) continue;
        nearby(x, y, z, 7, balls);
        // Where balls overlap much, many of them must be asked how deep a place is.
        look((out.size() - begin) * (256 + balls_.size()));
        const bool few = deepest_in_cell(0.5 * (position(x, y, z) + position(x + 1, y + 1, z + 1)), deepest);
        for (std::size_t f = begin; f < out.size(); ++f) {
          if (on_one(out[f])) measure(out[f], balls, few ? &deepest : nullptr, error);
        }
      }
    }
  }

  template <class VertexOn>
  void cut(std::array<int, 4> c, unsigned mask, const VertexOn& vertex, std::vector<Triangle>& out) const {
    // Inner corners first; whether the order is still that of a positively oriented tetrahedron.
    bool positive = true;
    std::size_t inner = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if ((mask >> c[k] & 1) == 0) continue;
      if (k != inner) {
        std::swap(c[k], c[inner]);
        positive = !positive;
      }
      ++inner;
    }
    const auto add = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
      if (!positive) std::swap(q, r);
      out.push_back({p, q, r});
    };
    if (inner == 1) add(vertex(c[0], c[1]), vertex(c[0], c[2]), vertex(c[0], c[3]));
    if (inner == 3) add(vertex(c[3], c[0]), vertex(c[3], c[1]), vertex(c[3], c[2]));
    if (inner == 2) {
      const std::int32_t a = vertex(c[0], c[2]), b = vertex(c[0], c[3]), d = vertex(c[1], c[3]),
                         e = vertex(c[1], c[2]);
      if (squared_distance(vertices_[at(a)], vertices_[at(d)]) <=
          squared_distance(vertices_[at(b)], vertices_[at(e)])) {
        add(a, b, d);
        add(a, d, e);
      } else {
        add(a, b, e);
        add(b, d, e);
      }
    }
  }

  /// The balls in one of which each place of a cell is deepest, and some others; false where these are many.
  bool deepest_in_cell(Vec3 middle, std::vector<std::int32_t>& balls) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto value = [&](std::size_t i) { return distance(middle, balls_.centers[i]) - balls_.radii[i]; };
    // From the middle to a corner depths change by less than 0.867 cells, each.
    const double limit = tree_.smallest(middle, infinity, -infinity, value) + 1.74 * cell_;
    balls.clear();
    tree_.below(middle, limit, [&](std::size_t i) {
      if (value(i) < limit) balls.push_back(static_cast<std::int32_t>(i));
    });
    return balls.size() <= 48;
  }

  /// Makes `most` the largest distance from the boundary so far, with the middle of a triangle, of those
  /// edges that ascend in it, and half way from the middle to the corners.
  void measure(const Triangle& t, const Nearby& balls, const std::vector<std::int32_t>* deepest,
               double& most) const {
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t u = t[k], v = t[(k + 1) % 3];
      const Vec3 p = vertices_[at(u)];
      sum = sum + p;
      if (u > v) continue;  // every edge is in two triangles, once in each direction
      measure(0.5 * (p + vertices_[at(v)]), balls, deepest, most);
    }
    measure((1.0 / 3) * sum, balls, deepest, most);
    for (const std::int32_t v : t) measure(0.5 * vertices_[at(v)] + (1.0 / 6) * sum, balls, deepest, most);
  }
  void measure(Vec3 p, const Nearby& balls, const std::vector<std::int32_t>* deepest, double& most) const {
    const auto value = [&](std::size_t i) { return distance(p, balls_.centers[i]) - balls_.radii[i]; };
    if (deepest != nullptr) {
      double depth = std::numeric_limits<double>::infinity();
      for (const std::int32_t i : *deepest) depth = std::min(depth, value(at(i)));
      most = std::max(most, std::abs(depth));
      return;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t i : balls) least = std::min(least, value(at(i)));
    // Where p is not farther outside than others were, only a ball counts in which it is deeper than others.
    const double limit = least > most ? least : std::min(least, -most);
    most =
        std::max(most, std::abs(tree_.smallest(p, limit, -std::numeric_limits<double>::infinity(), value)));
  }

  const Balls& balls_;
  const double cell_;
  Monitor& monitor_;
  BoxTree tree_;
  Vec3 middle_;                          // of the grid
  std::array<std::int64_t, 3> count_{};  // corners in each direction
  std::unique_ptr<Corner[]> corners_;
  std::vector<std::size_t> first_vertex_;  // of a layer
  std::vector<Vec3> vertices_;
  std::vector<std::int32_t> spheres_;  // on which the vertices are
};

}  // namespace

std::optional<GridMesh> grid_mesh(const Balls& balls, double cell, std::size_t most_corners,
                                  std::size_t most_faces, Monitor& monitor) {
  Grid grid(balls, cell, monitor);
  if (!(grid.corners() <= static_cast<double>(most_corners))) return {};
  return grid.run(most_faces);
}

}  // namespace ballflow::geometry
