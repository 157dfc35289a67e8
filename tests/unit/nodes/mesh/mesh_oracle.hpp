// What a mesh of the boundary of a union of balls must be, computed the slow way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::test {

using geometry::Balls;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3;

struct Ball {
  Vec3 c;
  double r;
};

inline Balls balls_of(const std::vector<Ball>& list) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Ball& b : list) {
    centers.push_back(b.c);
    radii.push_back(b.r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

/// Empty when every edge is used once in each direction and the triangles around every vertex form one cycle.
inline std::string broken_manifold(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> links;  // of a vertex: what follows what
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (a == b) return "a triangle has a vertex twice";
      if (++uses[{a, b}] > 1) return "an edge is used twice in one direction";
      if (!links[a].emplace(b, c).second) return "a link branches";
    }
  }
  for (const auto& [edge, n] : uses) {
    if (uses.count({edge.second, edge.first}) == 0) return "an edge is used in one direction only";
  }
  if (links.size() != mesh.vertices.size()) return "a vertex is in no triangle";
  for (const auto& [vertex, next] : links) {
    std::size_t length = 0;
    const std::int32_t first = next.begin()->first;
    std::int32_t v = first;
    do {
      const auto found = next.find(v);
      if (found == next.end()) return "a link is open";
      v = found->second;
      ++length;
    } while (v != first && length <= next.size());
    if (length != next.size()) return "a link has several cycles";
  }
  return {};
}

inline std::int64_t euler_of(const TriangleMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  std::set<std::int32_t> vertices;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      vertices.insert(t[k]);
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  return static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangles.size());
}

/// Positive inside the union.
inline double depth(const Balls& balls, Vec3 p) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < balls.size(); ++i)
    most = std::max(most, balls.radii[i] - distance(p, balls.centers[i]));
  return most;
}

/// Points of the boundary of the union: random ones of every sphere that lie in no other ball.
inline std::vector<Vec3> boundary_points(const Balls& balls, std::size_t per_ball, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t k = 0; k < per_ball; ++k) {
      const Vec3 d{normal(random), normal(random), normal(random)};
      const Vec3 p = balls.centers[i] + (balls.radii[i] / length(d)) * d;
      bool on = true;
      for (std::size_t j = 0; on && j < balls.size(); ++j)
        on = j == i || distance(p, balls.centers[j]) >= balls.radii[j];
      if (on) points.push_back(p);
    }
  }
  return points;
}

inline double distance_to(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  // Ericson, Real-Time Collision Detection, 5.1.5.
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return distance(p, a);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return distance(p, b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return distance(p, a + d1 / (d1 - d3) * ab);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return distance(p, c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return distance(p, a + d2 / (d2 - d6) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return distance(p, b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
  const double all = va + vb + vc;
  return distance(p, a + vb / all * ab + vc / all * ac);
}

/// The largest distance of points of the boundary, `per_ball` random ones of every sphere, from the mesh.
inline double boundary_to_mesh(const Balls& balls, const TriangleMesh& mesh, std::size_t per_ball) {
  double most = 0;
  for (const Vec3 p : boundary_points(balls, per_ball, 7)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh.triangles) {
      const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
      const Vec3 a = corner(0), b = corner(1), c = corner(2);
      // No triangle is nearer than a corner less its longest edge.
      if (distance(p, a) - std::max(distance(a, b), distance(a, c)) >= least) continue;
      least = std::min(least, distance_to(p, a, b, c));
    }
    most = std::max(most, least);
  }
  return most;
}

/// The largest |depth| of 45 points of every triangle.
inline double mesh_to_boundary(const Balls& balls, const TriangleMesh& mesh) {
  double most = 0;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; i + j <= 8; ++j) {
        Vec3 p;
        const int weights[3] = {i, j, 8 - i - j};
        for (std::size_t k = 0; k < 3; ++k)
          p = p + weights[k] / 8.0 * mesh.vertices[static_cast<std::size_t>(t[k])];
        most = std::max(most, std::abs(depth(balls, p)));
      }
    }
  }
  return most;
}

/// The volume inside, by the divergence theorem.
inline double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += dot(corner(0), cross(corner(1), corner(2))) / 6;
  }
  return sum;
}

/// Triangles by the coordinates of their corners, in a canonical order.
inline std::vector<std::array<Vec3, 3>> soup_of(const TriangleMesh& mesh) {
  std::vector<std::array<Vec3, 3>> soup;
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[static_cast<std::size_t>(t[k])];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    soup.push_back(corners);
  }
  std::sort(soup.begin(), soup.end());
  return soup;
}

}  // namespace ballflow::test
