#include "surface/surface_mesh.hpp"

#include <cstdio>
#include <string>
#include <utility>

#include "surface/cell_boundary.hpp"
#include "surface/cell_labels.hpp"

namespace ballflow::geometry {
namespace {

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

double filled_share(const TriangleMesh& mesh, const std::vector<std::uint8_t>& filled) {
  double all = 0, holes = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [u, v, w] = mesh.triangles[i];
    const auto at = [&](std::int32_t k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
    const double area = length(cross(at(v) - at(u), at(w) - at(u)));
    all += area;
    if (filled[i] == 1) holes += area;
  }
  return all > 0 ? holes / all : 0;
}

}  // namespace

SurfaceMesh surface_mesh(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                         const SurfaceMeshOptions& options, Monitor& monitor) {
  PartMonitor labelling(monitor, 0, 0.8), bounding(monitor, 0.8, 1);
  const CellLabels labels = cell_labels(diagram, poles, sample, labelling);
  const char* const causes =
      "an open scan, walls thinner than the spacing of samples, sharp edges or strong noise look like this: "
      "sample more "
      "densely, close the scan, or raise most_overruled and most_filled to see what comes out";
  if (labels.overruled > options.most_overruled) {
    throw InputError("the cloud does not look like the surface of a solid: any closed surface contradicts " +
                         percent(labels.overruled) + " of what its poles say about inside and outside",
                     causes);
  }
  CellBoundary boundary =
      cell_boundary(diagram, labels.inside, {.smallest_component = options.smallest_component}, bounding);
  if (boundary.mesh.triangles.empty()) {
    throw InputError("nothing is inside of the surface",
                     "sample more densely, or leave out points that are far away (Sample, strays: drop)");
  }
  SurfaceMesh result;
  result.report.filled_area = filled_share(boundary.mesh, boundary.filled);
  if (result.report.filled_area > options.most_filled) {
    throw InputError("the cloud does not look like the surface of a solid: " +
                         percent(result.report.filled_area) + " of the area would close holes",
                     causes);
  }
  const MeshTopology topology = mesh_topology(boundary.mesh);
  result.report.components = topology.components;
  result.report.genus = topology.genus;
  result.report.overruled = labels.overruled;
  result.report.mixed_voids = labels.mixed_voids;
  result.report.split_vertices = boundary.split_vertices;
  result.report.midpoints = boundary.midpoints;
  result.report.specks = boundary.specks;
  result.report.vertex_balls = std::move(boundary.ball);
  result.report.filled = std::move(boundary.filled);
  result.mesh = std::move(boundary.mesh);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
