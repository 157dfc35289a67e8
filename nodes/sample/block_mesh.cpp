#include "sample/block_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ballflow::geometry {
namespace {

/// Calls visit(axis, cell, towards_upper) for every face between a solid cell and a hollow one.
template <class Visit>
void for_each_face(const std::array<int, 3>& cells, const std::function<bool(int, int, int)>& solid,
                   Visit visit) {
  const auto at = [&](const std::array<int, 3>& c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] < 0 || c[axis] >= cells[axis]) return false;
    }
    return solid(c[0], c[1], c[2]);
  };
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const std::array cell = {i, j, k};
        if (!at(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const bool upper : {false, true}) {
            std::array neighbour = cell;
            neighbour[axis] += upper ? 1 : -1;
            if (!at(neighbour)) visit(axis, cell, upper);
          }
        }
      }
    }
  }
}

std::array<int, 3> cells_between(const std::array<std::vector<double>, 3>& planes) {
  std::array<int, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) cells[axis] = static_cast<int>(planes[axis].size()) - 1;
  return cells;
}

}  // namespace

double block_area(const Blocks& blocks) {
  double area = 0;
  for_each_face(cells_between(blocks.planes), blocks.solid,
                [&](std::size_t axis, const std::array<int, 3>& cell, bool) {
                  double face = 1;
                  for (std::size_t other = 0; other < 3; ++other) {
                    if (other == axis) continue;
                    const auto i = static_cast<std::size_t>(cell[other]);
                    face *= blocks.planes[other][i + 1] - blocks.planes[other][i];
                  }
                  area += face;
                });
  return area;
}

TriangleMesh block_mesh(const Blocks& blocks, double h) {
  std::array<std::vector<double>, 3> lines;
  std::array<std::vector<int>, 3> block_of;  // the block of a fine cell
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double>& planes = blocks.planes[axis];
    for (std::size_t b = 0; b + 1 < planes.size(); ++b) {
      const double size = planes[b + 1] - planes[b];
      const int parts = std::max(1, static_cast<int>(std::ceil(size / h)));
      for (int i = 0; i < parts; ++i) {
        lines[axis].push_back(planes[b] + size * i / parts);
        block_of[axis].push_back(static_cast<int>(b));
      }
    }
    lines[axis].push_back(planes.back());
  }

  using Node = std::array<int, 3>;
  std::vector<std::array<Node, 4>> quads;
  const auto fine_solid = [&](int i, int j, int k) {
    return blocks.solid(block_of[0][static_cast<std::size_t>(i)], block_of[1][static_cast<std::size_t>(j)],
                        block_of[2][static_cast<std::size_t>(k)]);
  };
  for_each_face(cells_between(lines), fine_solid, [&](std::size_t axis, const Node& cell, bool upper) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Node corner = cell;
    corner[axis] += upper;
    std::array<Node, 4> quad = {corner, corner, corner, corner};
    ++quad[1][u];
    ++quad[2][u];
    ++quad[2][v];
    ++quad[3][v];
    if (!upper) std::swap(quad[1], quad[3]);
    quads.push_back(quad);
  });

  std::vector<Node> nodes;
  nodes.reserve(4 * quads.size());
  for (const auto& quad : quads) nodes.insert(nodes.end(), quad.begin(), quad.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vec3> vertices;
  vertices.reserve(nodes.size());
  for (const Node& node : nodes) {
    vertices.push_back({lines[0][static_cast<std::size_t>(node[0])],
                        lines[1][static_cast<std::size_t>(node[1])],
                        lines[2][static_cast<std::size_t>(node[2])]});
  }
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (const auto& quad : quads) {
    std::array<std::int32_t, 4> id{};
    for (std::size_t i = 0; i < 4; ++i) {
      id[i] =
          static_cast<std::int32_t>(std::lower_bound(nodes.begin(), nodes.end(), quad[i]) - nodes.begin());
    }
    triangles.push_back({id[0], id[1], id[2]});
    triangles.push_back({id[0], id[2], id[3]});
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace ballflow::geometry
