#include "mesh/near_splits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ballflow::geometry {

TriangleMesh near_splits(const TriangleMesh& mesh, std::int32_t first_split, double cell) {
  const Box all = bounding_box(mesh.vertices.span());
  const auto count = [&](double from, double to) {
    return static_cast<std::int64_t>(std::floor((to - from) / cell)) + 1;
  };
  const std::int64_t nx = count(all.lower.x, all.upper.x), ny = count(all.lower.y, all.upper.y),
                     nz = count(all.lower.z, all.upper.z);
  std::vector<char> marked(static_cast<std::size_t>(nx * ny * nz));
  // Calls visit for the cells of a grid, not that of the mesh, which the box of a triangle meets, until it
  // returns false.
  const auto each_cell = [&](const Triangle& t, const auto& visit) {
    Box box;
    for (const std::int32_t v : t) box.add(mesh.vertices[static_cast<std::size_t>(v)]);
    const Vec3 low = 1 / cell * (box.lower - all.lower), high = 1 / cell * (box.upper - all.lower);
    const auto place = [](double x, std::int64_t n) {
      return std::min(static_cast<std::int64_t>(std::floor(x)), n - 1);
    };
    for (std::int64_t z = place(low.z, nz); z <= place(high.z, nz); ++z) {
      for (std::int64_t y = place(low.y, ny); y <= place(high.y, ny); ++y) {
        for (std::int64_t x = place(low.x, nx); x <= place(high.x, nx); ++x) {
          if (!visit(marked[static_cast<std::size_t>((z * ny + y) * nx + x)])) return;
        }
      }
    }
  };
  const auto split = [&](const Triangle& t) { return std::max({t[0], t[1], t[2]}) >= first_split; };
  for (const Triangle& t : mesh.triangles) {
    if (split(t)) each_cell(t, [](char& mark) { return mark = 1, true; });
  }
  std::vector<Triangle> near;
  for (const Triangle& t : mesh.triangles) {
    bool found = split(t);
    if (!found) each_cell(t, [&](const char& mark) { return found = mark != 0, !found; });
    if (found) near.push_back(t);
  }
  return {mesh.vertices, std::move(near)};
}

}  // namespace ballflow::geometry
