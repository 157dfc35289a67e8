// Small solids for the tests of poles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::test {

using geometry::PointSet;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3;

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  TriangleMesh mesh() const { return {vertices, triangles}; }
  PointSet points() const { return {vertices, {}}; }

  Mesh& turn() {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
    return *this;
  }
  Mesh& add(const Mesh& other) {
    const auto shift = static_cast<std::int32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Triangle& t : other.triangles) triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return *this;
  }
  Mesh& move(Vec3 by, double scale = 1) {
    for (Vec3& v : vertices) v = scale * v + by;
    return *this;
  }
};

// [-1, 1]^3, faces outwards.
inline Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Unit sphere: an octahedron, every triangle split in four `levels` times.
inline Mesh sphere(int levels) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.vertices.size()));
      if (fresh) {
        const Vec3 sum =
            mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)];
        mesh.vertices.push_back(1 / length(sum) * sum);
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

// Circle of radius `tube` around the circle of radius 1 in the plane z = 0, sheared so that the rows of
// vertices are not aligned.
inline Mesh torus(int around, int across, double tube) {
  Mesh mesh;
  const double turn = 2 * 3.14159265358979323846;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = turn * (i + 0.37 * j / across) / around, v = turn * (j + 0.61 * i / around) / across;
      const double reach = 1 + tube * std::cos(v);
      mesh.vertices.push_back({reach * std::cos(u), reach * std::sin(u), tube * std::sin(v)});
    }
  }
  // The shear of 0.61 rows does not close up; the last column meets the first without it.
  const auto id = [&](int i, int j) { return static_cast<std::int32_t>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

// A mesh of lattice points with equal points welded; which way its triangles face is left open.
class LatticeMesh {
 public:
  using Cell = std::array<int, 3>;
  void add_triangle(Cell a, Cell b, Cell c) { triangles_.push_back({vertex(a), vertex(b), vertex(c)}); }
  void add_quad(Cell a, Cell b, Cell c, Cell d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  }
  template <class Place>
  Mesh placed(const Place& place) const {
    Mesh mesh;
    mesh.triangles = triangles_;
    mesh.vertices.resize(vertices_.size());
    for (const auto& [cell, id] : vertices_) mesh.vertices[static_cast<std::size_t>(id)] = place(cell);
    return mesh;
  }

 private:
  std::int32_t vertex(Cell cell) {
    return vertices_.try_emplace(cell, static_cast<std::int32_t>(vertices_.size())).first->second;
  }
  std::map<Cell, std::int32_t> vertices_;
  std::vector<Triangle> triangles_;
};

// A coordinate moved by up to `jitter` cells where it is not at an end of [0, last].
class Jitter {
 public:
  Jitter(double jitter, unsigned seed) : jitter_(jitter), random_(seed) {}
  double operator()(int i, int last) {
    const double unit = static_cast<double>(random_()) / 2147483648.0 - 1;
    return i == 0 || i == last ? i : i + jitter_ * unit;
  }

 private:
  double jitter_;
  std::mt19937 random_;
};

// [-1, 1]^3 with n x n quads on every face. Samples of faces are moved in them, those of edges along them.
inline Mesh lattice_cube(int n, double jitter, unsigned seed) {
  LatticeMesh lattice;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (const int k : {0, n}) {
        lattice.add_quad({i, j, k}, {i + 1, j, k}, {i + 1, j + 1, k}, {i, j + 1, k});
        lattice.add_quad({k, i, j}, {k, i + 1, j}, {k, i + 1, j + 1}, {k, i, j + 1});
        lattice.add_quad({j, k, i}, {j, k, i + 1}, {j + 1, k, i + 1}, {j + 1, k, i});
      }
    }
  }
  Jitter move(jitter, seed);
  return lattice.placed([&](std::array<int, 3> cell) {
    const double x = move(cell[0], n), y = move(cell[1], n), z = move(cell[2], n);
    return Vec3{2 * x / n - 1, 2 * y / n - 1, 2 * z / n - 1};
  });
}

// A prism of height 1 over the triangle (0, 0), (1, -t/2), (1, t/2): a wedge, sharp at the z axis. Samples
// are moved in the direction of z.
inline Mesh lattice_wedge(int n, double thickness, double jitter) {
  LatticeMesh lattice;  // (i, j, k), 0 <= j <= i
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      lattice.add_quad({i, 0, k}, {i + 1, 0, k}, {i + 1, 0, k + 1}, {i, 0, k + 1});
      lattice.add_quad({i, i, k}, {i + 1, i + 1, k}, {i + 1, i + 1, k + 1}, {i, i, k + 1});
      lattice.add_quad({n, i, k}, {n, i + 1, k}, {n, i + 1, k + 1}, {n, i, k + 1});
    }
    for (const int k : {0, n}) {
      for (int j = 0; j <= i; ++j) {
        lattice.add_triangle({i, j, k}, {i + 1, j, k}, {i + 1, j + 1, k});
        if (j < i) lattice.add_triangle({i, j, k}, {i + 1, j + 1, k}, {i, j + 1, k});
      }
    }
  }
  Jitter move(jitter, 17);
  return lattice.placed([&](std::array<int, 3> cell) {
    const double x = static_cast<double>(cell[0]) / n, z = move(cell[2], n) / n;
    return Vec3{x, thickness * (static_cast<double>(cell[1]) / n - x / 2), z};
  });
}

}  // namespace ballflow::test
