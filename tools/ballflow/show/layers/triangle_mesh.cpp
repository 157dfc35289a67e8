// TriangleMesh: its triangles, translucent at first so that what is inside can be seen.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {

Layer layer_of(const geometry::TriangleMesh& mesh) {
  Layer surface;
  surface.name = "mesh";
  surface.shape = Shape::triangles;
  surface.vertices = mesh.vertices;
  surface.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    surface.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  }
  surface.opacity = 0.3;
  surface.smooth = true;
  return surface;
}

TypeLayers triangle_mesh_layers() {
  return {"TriangleMesh", [](const Artifact& artifact) {
            return std::vector{layer_of(typed<geometry::TriangleMesh>(artifact))};
          }};
}

}  // namespace ballflow::show
