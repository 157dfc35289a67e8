#include "show/icosphere.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ballflow::show {

using geometry::Vec3;

Icosphere icosphere(int rounds) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Icosphere sphere;
  const auto add = [&sphere](Vec3 v) {
    sphere.vertices.push_back((1 / geometry::length(v)) * v);
    return static_cast<std::uint32_t>(sphere.vertices.size() - 1);
  };
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      add({0, a, b});
      add({a, b, 0});
      add({b, 0, a});
    }
  }
  // Three vertices are a triangle when they are neighbours: at the distance of an edge, the shortest there
  // is.
  const double edge = 1.1;  // is 1.051, the next distance is 1.701
  const auto near = [&sphere, edge](std::uint32_t a, std::uint32_t b) {
    return geometry::distance(sphere.vertices[a], sphere.vertices[b]) < edge;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const Vec3 p = sphere.vertices[a], q = sphere.vertices[b], r = sphere.vertices[c];
        const bool outward = geometry::dot(geometry::cross(q - p, r - p), p) > 0;
        sphere.triangles.push_back({a, outward ? b : c, outward ? c : b});
      }
    }
  }
  for (; rounds > 0; --rounds) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t u, std::uint32_t v) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(u, v), 0);
      if (is_new) at->second = add(sphere.vertices[u] + sphere.vertices[v]);
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    sphere.triangles = std::move(finer);
  }
  return sphere;
}

}  // namespace ballflow::show
