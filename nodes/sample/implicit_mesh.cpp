#include "sample/implicit_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;
using Quad = std::array<Index, 4>;

// Rounds of relaxation: more change the spacing by less than a percent.
constexpr int relaxation_rounds = 16;
// Newton steps that finish a vertex; four reach rounding error from where relaxation leaves it.
constexpr int newton_steps = 6;
// Two neighbouring cells may still meet in a face whose two cuts belong to one sheet in both: a non-manifold
// edge. Then the grid is moved.
constexpr int most_grids = 8;
// Cells of the grid that measures the area.
constexpr double probe_cells = 60 * 60 * 60;

/// The grid is turned against the axes, so that the symmetries of the shapes do not become exactly
/// cospherical samples: the rotation of the quaternion (20, 1, 2, 3), about 21 degrees.
struct Frame {
  std::array<Vec3, 3> axes;

  Frame() {
    constexpr double w = 20, x = 1, y = 2, z = 3, s = 2 / (w * w + x * x + y * y + z * z);
    axes = {Vec3{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            Vec3{s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
            Vec3{s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
  }
  Vec3 local(const Vec3& p) const { return {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)}; }
  Vec3 world(const Vec3& q) const { return q.x * axes[0] + q.y * axes[1] + q.z * axes[2]; }
};

/// The sheets of the surface in a cell, by the signs of its corners (bit a of the mask: corner a is inside;
/// bits 0, 1, 2 of a are its x, y, z). Inside corners are connected along edges, outside corners also across
/// faces; a cut edge belongs to the sheet between the sets of its ends.
class Sheets {
 public:
  Sheets() {
    for (std::size_t mask = 0; mask < 256; ++mask) {
      std::array<int, 8> set{0, 1, 2, 3, 4, 5, 6, 7};
      const auto inside = [mask](std::size_t corner) { return ((mask >> corner) & 1) != 0; };
      const auto join = [&set](std::size_t a, std::size_t b) {
        const int from = set[a], to = set[b];
        std::replace(set.begin(), set.end(), from, to);
      };
      for (std::size_t a = 0; a < 8; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          const int differing = std::popcount(a ^ b);
          if (inside(a) == inside(b) && (differing == 1 || (differing == 2 && !inside(a)))) join(a, b);
        }
      }
      std::vector<std::pair<int, int>> sheets;
      for (std::size_t a = 0; a < 8; ++a) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t b = a ^ (std::size_t{1} << axis);
          if (inside(a) == inside(b)) continue;
          const std::pair sheet = inside(a) ? std::pair(set[a], set[b]) : std::pair(set[b], set[a]);
          const auto found = std::find(sheets.begin(), sheets.end(), sheet);
          of_edge_[mask][a][axis] = static_cast<Index>(found - sheets.begin());
          if (found == sheets.end()) sheets.push_back(sheet);
        }
      }
      count_[mask] = static_cast<Index>(sheets.size());
    }
  }
  Index count(std::size_t mask) const { return count_[mask]; }
  /// The sheet that cuts the edge of corner a along an axis.
  Index of_edge(std::size_t mask, std::size_t a, std::size_t axis) const { return of_edge_[mask][a][axis]; }

 private:
  std::array<std::array<std::array<Index, 3>, 8>, 256> of_edge_{};
  std::array<Index, 256> count_{};
};

/// One pass over a grid of spacing h, two layers of values in memory.
class Contouring {
 public:
  /// `shift` in [0, 1) moves the grid by this part of a cell in all directions.
  Contouring(const ImplicitSurface& surface, double h, double shift, Monitor& monitor)
      : surface_(surface), h_(h), monitor_(monitor) {
    Box box;
    for (int corner = 0; corner < 8; ++corner) {
      box.add(frame_.local({corner & 1 ? surface.box.upper.x : surface.box.lower.x,
                            corner & 2 ? surface.box.upper.y : surface.box.lower.y,
                            corner & 4 ? surface.box.upper.z : surface.box.lower.z}));
    }
    const auto cells = [h](double length) { return static_cast<Index>(std::ceil(length / h)) + 5; };
    origin_ = box.lower - (2 + shift) * Vec3{h, h, h};
    nx_ = cells(box.upper.x - box.lower.x);
    ny_ = cells(box.upper.y - box.lower.y);
    nz_ = cells(box.upper.z - box.lower.z);
    below_.resize(nodes());
    above_.resize(nodes());
    previous_.resize(nodes());
    current_.resize(nodes());
  }

  void run() {
    evaluate(0, above_);
    for (Index layer = 0; layer < nz_; ++layer) {
      monitor_.step(0.5 * layer / nz_);
      std::swap(below_, above_);
      evaluate(layer + 1, above_);
      std::swap(previous_, current_);
      place_vertices(layer);
      connect();
    }
  }

  std::vector<Vec3> vertices;
  std::vector<Quad> quads;

 private:
  std::size_t nodes() const { return static_cast<std::size_t>(nx_ + 1) * static_cast<std::size_t>(ny_ + 1); }
  std::size_t at(Index i, Index j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_ + 1) + static_cast<std::size_t>(i);
  }
  Vec3 node(Index i, Index j, Index k) const { return origin_ + Vec3{i * h_, j * h_, k * h_}; }

  /// Only signs matter away from the surface: a block of nodes is evaluated where the Lipschitz bound leaves
  /// a zero possible in it or next to it.
  void evaluate(Index k, std::vector<double>& layer) const {
    constexpr Index block = 8;
    const double reach = surface_.lipschitz * h_ * block;
    for (Index j0 = 0; j0 <= ny_; j0 += block) {
      for (Index i0 = 0; i0 <= nx_; i0 += block) {
        const Index j1 = std::min(ny_ + 1, j0 + block), i1 = std::min(nx_ + 1, i0 + block);
        const double middle = surface_.value(frame_.world(node(i0 + block / 2, j0 + block / 2, k)));
        const bool far = reach > 0 && std::abs(middle) > reach;
        for (Index j = j0; j < j1; ++j) {
          for (Index i = i0; i < i1; ++i) {
            layer[at(i, j)] = far ? middle : surface_.value(frame_.world(node(i, j, k)));
          }
        }
      }
    }
  }

  /// One vertex per sheet: the mean of the points where it cuts edges, by linear interpolation.
  void place_vertices(Index k) {
    for (Index j = 0; j < ny_; ++j) {
      for (Index i = 0; i < nx_; ++i) {
        const std::array<double, 8> f = {
            below_[at(i, j)], below_[at(i + 1, j)], below_[at(i, j + 1)], below_[at(i + 1, j + 1)],
            above_[at(i, j)], above_[at(i + 1, j)], above_[at(i, j + 1)], above_[at(i + 1, j + 1)]};
        std::size_t mask = 0;
        for (std::size_t a = 0; a < 8; ++a) mask |= static_cast<std::size_t>(f[a] < 0) << a;
        current_[at(i, j)] = {static_cast<Index>(vertices.size()), static_cast<std::uint8_t>(mask)};
        for (Index sheet = 0; sheet < sheets_.count(mask); ++sheet) {
          Vec3 sum;
          int crossings = 0;
          for (std::size_t a = 0; a < 8; ++a) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
              const std::size_t b = a | (std::size_t{1} << axis);
              if (b == a || (f[a] < 0) == (f[b] < 0) || sheets_.of_edge(mask, a, axis) != sheet) continue;
              const double t = f[a] / (f[a] - f[b]);
              const auto coordinate = [&](std::size_t c) {
                return c == axis ? t : static_cast<double>((a >> c) & 1);
              };
              sum = sum + Vec3{coordinate(0), coordinate(1), coordinate(2)};
              ++crossings;
            }
          }
          vertices.push_back(frame_.world(node(i, j, k) + (h_ / crossings) * sum));
        }
      }
    }
  }

  struct Cell {
    Index first_vertex = 0;  // of its sheets
    std::uint8_t mask = 0;
  };

  /// Vertex of the sheet of a cell that cuts the edge of corner a along an axis.
  Index vertex(const Cell& cell, std::size_t a, std::size_t axis) const {
    return cell.first_vertex + sheets_.of_edge(cell.mask, a, axis);
  }

  void add(Quad quad, bool outward) {
    if (!outward) std::swap(quad[1], quad[3]);
    quads.push_back(quad);
  }

  /// Quads around the cut edges that begin at the nodes of the lower layer.
  void connect() {
    for (Index j = 1; j < ny_; ++j) {
      for (Index i = 1; i < nx_; ++i) {
        const bool inside = below_[at(i, j)] < 0;
        if (inside != (below_[at(i + 1, j)] < 0)) {
          add({vertex(previous_[at(i, j - 1)], 6, 0), vertex(previous_[at(i, j)], 4, 0),
               vertex(current_[at(i, j)], 0, 0), vertex(current_[at(i, j - 1)], 2, 0)},
              inside);
        }
        if (inside != (below_[at(i, j + 1)] < 0)) {
          add({vertex(previous_[at(i - 1, j)], 5, 1), vertex(current_[at(i - 1, j)], 1, 1),
               vertex(current_[at(i, j)], 0, 1), vertex(previous_[at(i, j)], 4, 1)},
              inside);
        }
        if (inside != (above_[at(i, j)] < 0)) {
          add({vertex(current_[at(i - 1, j - 1)], 3, 2), vertex(current_[at(i, j - 1)], 2, 2),
               vertex(current_[at(i, j)], 0, 2), vertex(current_[at(i - 1, j)], 1, 2)},
              inside);
        }
      }
    }
  }

  inline static const Sheets sheets_;
  const ImplicitSurface& surface_;
  double h_;
  Monitor& monitor_;
  Frame frame_;
  Vec3 origin_;
  Index nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<double> below_, above_;     // values at the nodes of two layers
  std::vector<Cell> previous_, current_;  // cells of two layers
};

Vec3 newton_step(const ImplicitSurface& surface, const Vec3& p, double longest) {
  const Dual f = surface.value_and_gradient(p);
  const double square = squared_length(f.gradient);
  if (!(square > 0)) return p;
  const Vec3 step = (-f.value / square) * f.gradient;
  const double size = length(step);
  return p + (size > longest ? longest / size : 1.0) * step;
}

/// Two triangles per quad, along the shorter diagonal, or any when there are no vertices to measure it.
std::vector<Triangle> split(const std::vector<Quad>& quads, const std::vector<Vec3>& vertices) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (const Quad& quad : quads) {
    const auto diagonal = [&](std::size_t k) {
      return squared_distance(vertices[static_cast<std::size_t>(quad[k])],
                              vertices[static_cast<std::size_t>(quad[k + 2])]);
    };
    const std::size_t first = vertices.empty() || diagonal(0) <= diagonal(1) ? 0 : 1;
    triangles.push_back({quad[first], quad[first + 1], quad[first + 2]});
    triangles.push_back({quad[first], quad[first + 2], quad[(first + 3) % 4]});
  }
  return triangles;
}

}  // namespace

TriangleMesh implicit_mesh(const ImplicitSurface& surface, std::int64_t n, Monitor& monitor) {
  // A surface of area A cuts about 1.5 A / h^2 cells: one coarse pass measures A.
  const Vec3 extent = surface.box.upper - surface.box.lower;
  double h = std::sqrt(extent.x * extent.x + extent.y * extent.y + extent.z * extent.z);
  while (extent.x * extent.y * extent.z / (h * h * h) < probe_cells) h *= 0.875;
  {
    Contouring probe(surface, h, 0, no_monitor());
    probe.run();
    if (probe.vertices.empty()) return {};
    h *= std::sqrt(static_cast<double>(probe.vertices.size()) / static_cast<double>(n));
  }
  std::vector<Vec3> vertices;
  std::vector<Quad> quads;
  for (int attempt = 0; attempt < most_grids; ++attempt) {
    Contouring grid(surface, h, static_cast<double>(attempt) / most_grids, monitor);
    grid.run();
    vertices = std::move(grid.vertices);
    quads = std::move(grid.quads);
    if (mesh_topology({vertices, split(quads, {})}).manifold) break;
  }

  // Every undirected edge appears once in each direction: a vertex meets each neighbour once.
  std::vector<Vec3> sums(vertices.size());
  std::vector<Index> degrees(vertices.size(), 0);
  for (const Quad& quad : quads) {
    for (const Index v : quad) ++degrees[static_cast<std::size_t>(v)];
  }
  for (int round = 0; round < relaxation_rounds; ++round) {
    monitor.step(0.5 + 0.4 * round / relaxation_rounds);
    std::fill(sums.begin(), sums.end(), Vec3{});
    for (const Quad& quad : quads) {
      for (std::size_t k = 0; k < 4; ++k) {
        Vec3& sum = sums[static_cast<std::size_t>(quad[k])];
        sum = sum + vertices[static_cast<std::size_t>(quad[(k + 1) % 4])];
      }
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const Vec3 middle = (1.0 / degrees[v]) * sums[v];
      vertices[v] = newton_step(surface, 0.5 * (vertices[v] + middle), h);
    }
  }
  monitor.step(0.9);
  for (Vec3& p : vertices) {
    for (int step = 0; step < newton_steps; ++step) p = newton_step(surface, p, h);
  }

  return {vertices, split(quads, vertices)};
}

}  // namespace ballflow::geometry
