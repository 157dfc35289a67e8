#include "surface/restore_samples.hpp"

#include <string>
#include <utility>
#include <vector>

namespace ballflow::geometry {

TriangleMesh restore_samples(const TriangleMesh& mesh, const SurfaceReport& report, const Balls& balls,
                             const PointSet& original) {
  if (report.vertex_balls.size() != mesh.vertices.size()) {
    throw InputError("the report is about " + std::to_string(report.vertex_balls.size()) +
                         " vertices, but the mesh has " + std::to_string(mesh.vertices.size()),
                     "connect mesh and report of one SurfaceMesh");
  }
  std::vector<Vec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (report.vertex_balls[v] < 0) continue;
    const auto ball = static_cast<std::size_t>(report.vertex_balls[v]);
    const auto none = [&](const std::string& what) {
      throw InputError(
          "vertex " + std::to_string(v) + " is the centre of ball " + std::to_string(ball) + what,
          "connect the kept balls and the samples that the surface is about");
    };
    if (ball >= balls.size()) none(", but there are " + std::to_string(balls.size()) + " balls");
    if (balls.defining_offsets[ball + 1] - balls.defining_offsets[ball] != 1)
      none(", which is not defined by one sample");
    const auto sample = balls.defining_samples[static_cast<std::size_t>(balls.defining_offsets[ball])];
    if (static_cast<std::size_t>(sample) >= original.points.size())
      none(" at sample " + std::to_string(sample) + ", but there are " +
           std::to_string(original.points.size()) + " samples");
    vertices[v] = original.points[static_cast<std::size_t>(sample)];
  }
  return {std::move(vertices), mesh.triangles};
}

}  // namespace ballflow::geometry
