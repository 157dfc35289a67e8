#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/circle.hpp"
#include "mesh/sphere_geometry.hpp"
#include "mesh/sphere_patch.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

SpherePatch whole_sphere(Vec3 center, double radius, double error) {
  SpherePatch result;
  // Not even equilateral triangles are enough for a smaller n.
  for (auto n = std::max(1, static_cast<std::int32_t>(std::sqrt(0.6 * radius / error)));; ++n) {
    // Vertices of the octahedron |i| + |j| + |k| = n, by (i, j) and the sign of k.
    result.inside.clear();
    result.triangles.clear();
    std::vector<std::array<std::int32_t, 2>> index(at((2 * n + 1) * (2 * n + 1)), {-1, -1});
    const auto slot = [&](std::int32_t i, std::int32_t j) -> auto& {
      return index[at((i + n) * (2 * n + 1) + j + n)];
    };
    for (std::int32_t i = -n; i <= n; ++i) {
      for (std::int32_t j = -n; j <= n; ++j) {
        const std::int32_t k = n - std::abs(i) - std::abs(j);
        if (k < 0) continue;
        for (const int below : {0, 1}) {
          if (k == 0 && below == 1) {
            slot(i, j)[1] = slot(i, j)[0];
            continue;
          }
          // With sines, equal steps along the edges of the octahedron are equal angles.
          const auto sine = [n](std::int32_t of) {
            const double s = on_circle(static_cast<double>(std::abs(of)) / static_cast<double>(4 * n))[1];
            return of < 0 ? -s : s;
          };
          const Vec3 d{sine(i), sine(j), sine(below == 1 ? -k : k)};
          slot(i, j)[at(below)] = static_cast<std::int32_t>(result.inside.size());
          result.inside.push_back(center + (radius / length(d)) * d);
        }
      }
    }
    const auto vertex = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
      return -1 - slot(i, j)[k < 0 ? 1 : 0];
    };
    for (int octant = 0; octant < 8; ++octant) {
      const std::int32_t sx = (octant & 1) != 0 ? -1 : 1, sy = (octant & 2) != 0 ? -1 : 1,
                         sz = (octant & 4) != 0 ? -1 : 1;
      const auto corner = [&](std::int32_t i, std::int32_t j) {
        return vertex(sx * i, sy * j, sz * (n - i - j));
      };
      const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        if (sx * sy * sz < 0) std::swap(b, c);
        result.triangles.push_back({a, b, c});
      };
      for (std::int32_t i = 0; i < n; ++i) {
        for (std::int32_t j = 0; i + j < n; ++j) {
          add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
          if (i + j + 2 <= n) add(corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j));
        }
      }
    }
    result.error = 0;
    for (const Triangle& t : result.triangles) {
      const Vec3 a = result.inside[at(-1 - t[0])], b = result.inside[at(-1 - t[1])],
                 c = result.inside[at(-1 - t[2])];
      result.error = std::max(result.error, radius - distance_to_triangle(center, a, b, c));
    }
    if (result.error <= error) break;
  }
  result.state = SpherePatch::State::made;
  return result;
}

}  // namespace ballflow::geometry
