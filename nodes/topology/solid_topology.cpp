#include "topology/solid_topology.hpp"

#include <algorithm>

#include "search/self_intersection.hpp"
#include "search/shells.hpp"

namespace ballflow::geometry {

SolidTopology solid_topology(const TriangleMesh& surface, Monitor& monitor) {
  if (surface.triangles.empty()) return {Betti{0, 0, 0}, ""};
  const MeshTopology mesh = mesh_topology(surface);
  monitor.step(0.2);
  if (mesh.boundary_edges > 0) {
    return {std::nullopt,
            "the surface is open (" + std::to_string(mesh.boundary_edges) + " edges with one triangle)"};
  }
  if (!mesh.closed || !mesh.manifold) {
    return {std::nullopt, "the surface is not manifold (" + std::to_string(mesh.nonmanifold_edges) +
                              " edges with more than two triangles, or corners where parts touch)"};
  }
  if (!mesh.oriented) return {std::nullopt, "the triangles of the surface do not face one way"};
  if (const auto pair = self_intersection(surface, monitor)) {
    const auto [a, b] = *pair;
    return {std::nullopt, a == b
                              ? "triangle " + std::to_string(a) + " of the surface has no area"
                              : "the surface intersects itself (triangles " + std::to_string(std::min(a, b)) +
                                    " and " + std::to_string(std::max(a, b)) + ")"};
  }
  monitor.step(0.8);
  return {shells_of(surface, monitor).betti(), ""};
}

TopologyTable solid_row(const TriangleMesh& surface, Monitor& monitor) {
  if (surface.triangles.empty()) return {};
  const SolidTopology solid = solid_topology(surface, monitor);
  if (!solid.betti) monitor.warn("the topology of the solid is unknown: " + solid.unknown_because);
  monitor.step(1);
  return one_row(TopologyStage::surface, solid.betti);
}

}  // namespace ballflow::geometry
