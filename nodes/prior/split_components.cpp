#include "prior/split_components.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {

MeshComponent split_components(const TriangleMesh& mesh, const SplitComponentsOptions& options,
                               Monitor& monitor) {
  if (mesh.triangles.empty())
    throw InputError("the mesh has no triangles, so it has no components",
                     "give a mesh, not a cloud of points");
  Lookout look(monitor);
  DisjointSets sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
    look(8);
  }
  // Components by their names, which are vertices; in the order of their first triangles.
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<double> areas;
  for (const Triangle& t : mesh.triangles) {
    const auto root = static_cast<std::size_t>(sets.root(t[0]));
    if (number[root] < 0) {
      number[root] = static_cast<std::int32_t>(areas.size());
      areas.push_back(0);
    }
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    areas[static_cast<std::size_t>(number[root])] +=
        0.5 * length(cross(corner(1) - corner(0), corner(2) - corner(0)));
    look(8);
  }
  const auto count = static_cast<std::int64_t>(areas.size());
  if (options.component < 0 || options.component >= count)
    throw InputError("component " + std::to_string(options.component) + " is asked for, the mesh has " +
                         std::to_string(count),
                     "components are numbered from 0, the largest, to " + std::to_string(count - 1));
  std::vector<std::int32_t> order(areas.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return areas[static_cast<std::size_t>(a)] > areas[static_cast<std::size_t>(b)];
  });
  const std::int32_t wanted = order[static_cast<std::size_t>(options.component)];

  MeshComponent result;
  result.components = count;
  std::vector<std::int32_t> place(mesh.vertices.size(), -1);
  std::vector<Vec3> vertices;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (number[static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(v)))] != wanted) continue;
    place[v] = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return place[static_cast<std::size_t>(t[k])]; };
    if (at(0) >= 0) triangles.push_back({at(0), at(1), at(2)});
  }
  result.mesh = {std::move(vertices), std::move(triangles)};
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
