#include "surface/surface_mesh.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "search/neighbor_distances.hpp"
#include "surface/cell_boundary.hpp"
#include "surface/cell_labels.hpp"
#include "surface/surface_evidence.hpp"

namespace ballflow::geometry {
namespace {

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

/// At each ball's centre, which is a sample, the distance to the third nearest other one.
std::vector<double> spacing_at(const Array<Vec3>& centers, const PointSet& sample, Monitor& monitor) {
  const std::vector<double> third = neighbor_distances(sample.points.span(), 3, monitor);
  std::vector<std::int32_t> order(third.size());
  std::iota(order.begin(), order.end(), 0);
  const auto point = [&](std::int32_t i) { return sample.points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return point(a) < point(b); });
  std::vector<double> spacing;
  for (const Vec3& p : centers) {
    const auto found =
        std::lower_bound(order.begin(), order.end(), p, [&](auto i, Vec3 q) { return point(i) < q; });
    if (found == order.end() || point(*found) != p)
      throw InputError("a ball of the power diagram has its centre at no sample",
                       "connect the points around which the surface balls are");
    spacing.push_back(third[static_cast<std::size_t>(*found)]);
  }
  return spacing;
}

constexpr const char* causes =
    "an open scan (open=true leaves its holes), walls thinner than the spacing of samples, sharp edges or "
    "strong noise look like this: sample more densely, close the scan, or raise most_overruled, most_filled, "
    "most_holes and most_left_out to see what comes out";

void refuse_beyond(double share, double most, const std::string& what) {
  if (share <= most) return;
  throw InputError("the cloud does not look like the surface of a solid: " + what, causes);
}

void check_closed(const SurfaceEvidence& evidence, const SurfaceMeshOptions& options) {
  refuse_beyond(
      evidence.wide_area, options.most_holes,
      percent(evidence.wide_area) + " of the area would close holes, wider than the balls around them");
  refuse_beyond(evidence.filled_area, options.most_filled,
                percent(evidence.filled_area) + " of the area would close gaps");
}

// Fewer balls that the surface passes by are strays, and no part of the shape.
constexpr std::int64_t few = 10;

std::string text_of(Vec3 p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
  return text;
}

void warn(const SurfaceEvidence& evidence, const PowerDiagram& diagram, bool open, Monitor& monitor) {
  constexpr double many = 0.005, wide = 0.01, gaps = 0.5;
  const double balls = static_cast<double>(diagram.centers.size());
  if (static_cast<double>(evidence.left_out) > many * balls) {
    const double box = bounding_box(diagram.centers.span()).longest_edge();
    monitor.warn("the surface passes by " + std::to_string(evidence.left_out) + " of " +
                 std::to_string(diagram.centers.size()) + " kept samples, by up to " +
                 percent(evidence.farthest / box) +
                 " of the box: sheets as thin as the spacing may be missing, and parts as near to each other "
                 "may have grown together");
  }
  if (evidence.left_out_patch >= few) {
    monitor.warn(
        "the surface passes by " + std::to_string(evidence.left_out_patch) +
        " kept samples side by side, around " + text_of(evidence.patch_at) +
        ": a part of the shape is missing there, or has grown together with another one, and the genus "
        "may be wrong");
  }
  if (evidence.filled_area > gaps) {
    monitor.warn(percent(evidence.filled_area) +
                 " of the area closes gaps between balls: the samples are noisy, or too far apart for the "
                 "features");
  }
  if (!open && evidence.wide_area > wide) {
    monitor.warn("the surface closes holes: " + percent(evidence.wide_area) +
                 " of its area is gaps wider than the balls around them (open=true leaves them)");
  }
}

}  // namespace

SurfaceMesh surface_mesh(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                         const SurfaceMeshOptions& options, Monitor& monitor) {
  PartMonitor labelling(monitor, 0, 0.7), bounding(monitor, 0.7, 0.8), judging(monitor, 0.8, 1);
  const CellLabels labels = cell_labels(diagram, poles, sample, labelling);
  // Where a hole is, poles do not know; a sheet without any inside contradicts far more.
  refuse_beyond(
      labels.overruled, (options.open ? 3 : 1) * options.most_overruled,
      (options.open ? "" : "any closed surface contradicts ") + percent(labels.overruled) +
          (options.open ? " of what poles say about inside and outside is contradicted, so there is "
                          "no side of it that could be called outer"
                        : " of what its poles say about inside and outside"));
  CellBoundary boundary =
      cell_boundary(diagram, labels.inside, {.smallest_component = options.smallest_component}, bounding);
  if (boundary.mesh.triangles.empty()) {
    throw InputError("nothing is inside of the surface",
                     "sample more densely, or leave out points that are far away (Sample, strays: drop)");
  }
  const std::vector<double> spacing = spacing_at(diagram.centers, sample, judging);
  SurfaceEvidence evidence = surface_evidence(diagram, labels, boundary, spacing, options.hole, judging);
  SurfaceMesh result;
  if (options.open) {
    const double closed_holes = evidence.wide_area;
    boundary = without_holes(boundary, evidence.filled, options.smallest_hole, options.smallest_component);
    if (boundary.mesh.triangles.empty()) {
      throw InputError("nothing is left of the surface without its holes",
                       "sample more densely, or leave out points that are far away (Sample, strays: drop)");
    }
    evidence = surface_evidence(diagram, labels, boundary, spacing, options.hole, judging);
    evidence.wide_area = closed_holes;
  } else {
    check_closed(evidence, options);
  }
  refuse_beyond(evidence.left_out >= few ? evidence.left_out_area : 0, options.most_left_out,
                percent(evidence.left_out_area) + " of the surface that the samples show would be missing");
  warn(evidence, diagram, options.open, monitor);
  const MeshTopology topology = mesh_topology(boundary.mesh);
  result.report.components = topology.components;
  result.report.genus = topology.genus;
  result.report.boundary_loops = topology.boundary_loops;
  result.report.overruled = labels.overruled;
  result.report.filled_area = evidence.filled_area;
  result.report.wide_area = evidence.wide_area;
  result.report.left_out = evidence.left_out;
  result.report.left_out_area = evidence.left_out_area;
  result.report.farthest = evidence.farthest;
  result.report.left_out_patch = evidence.left_out_patch;
  result.report.patch_at = evidence.patch_at;
  result.report.mixed_voids = labels.mixed_voids;
  result.report.split_vertices = boundary.split_vertices;
  result.report.midpoints = boundary.midpoints;
  result.report.specks = boundary.specks;
  result.report.vertex_balls = std::move(boundary.ball);
  result.report.filled = std::move(evidence.filled);
  result.report.contradicted = std::move(evidence.overruled);
  result.mesh = std::move(boundary.mesh);
  result.report.vertices = result.mesh.vertices;
  result.report.triangles = result.mesh.triangles;
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
