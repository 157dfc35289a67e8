#include "search/lattice_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ballflow::geometry {
namespace {

std::array<double, 3> coordinates(Vec3 p) { return {p.x, p.y, p.z}; }

/// Twice the area of (a, b, p) in the plane (u, v), the same but for the sign when a and b change places.
double side(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> p) {
  const bool swapped = b < a;
  if (swapped) std::swap(a, b);
  const double area = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  return swapped ? -area : area;
}

}  // namespace

std::vector<Crossing> crossings_along(std::size_t axis, const Lattice& lattice,
                                      std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                      Lookout& look) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Crossing> result;
  std::vector<std::array<double, 3>> scaled;  // in units of the lattice
  for (const Vec3& p : vertices)
    scaled.push_back(coordinates(1.0 / lattice.spacing() * (p - lattice.lower())));
  for (const Triangle& triangle : triangles) {
    std::array<std::array<double, 3>, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = scaled[static_cast<std::size_t>(triangle[k])];
    const auto low = [&](std::size_t c) { return std::min({p[0][c], p[1][c], p[2][c]}); };
    const auto high = [&](std::size_t c) { return std::max({p[0][c], p[1][c], p[2][c]}); };
    const auto first = [&](std::size_t c) {
      return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(low(c))));
    };
    const auto last = [&](std::size_t c) {
      return std::min<std::int64_t>(lattice.count()[c] - 1, static_cast<std::int64_t>(std::floor(high(c))));
    };
    const auto flat = [&](std::size_t k) { return std::array<double, 2>{p[k][u], p[k][v]}; };
    look(static_cast<std::size_t>(
        std::max<std::int64_t>(1, (last(u) - first(u) + 1) * (last(v) - first(v) + 1))));
    for (std::int64_t j = first(v); j <= last(v); ++j) {
      for (std::int64_t i = first(u); i <= last(u); ++i) {
        const std::array<double, 2> q{static_cast<double>(i), static_cast<double>(j)};
        const double a = side(flat(1), flat(2), q), b = side(flat(2), flat(0), q),
                     c = side(flat(0), flat(1), q);
        const bool left = a > 0 && b > 0 && c > 0, right = a < 0 && b < 0 && c < 0;
        if (!left && !right) continue;
        const double at = (a * p[0][axis] + b * p[1][axis] + c * p[2][axis]) / (a + b + c);
        result.push_back({j * lattice.count()[u] + i, at, left ? 1 : -1});
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace ballflow::geometry
