#include "enclose/verify_enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "enclose/covered_triangles.hpp"
#include "enclose/union_voids.hpp"
#include "power/power_diagram.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

/// Triangles of a block: one may take as long as ten thousand others.
std::size_t block_of(std::size_t triangles) { return std::clamp<std::size_t>(triangles / 64, 1, 16); }

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Corners corners_of(const TriangleMesh& mesh, std::size_t t) {
  const auto [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[at(a)], mesh.vertices[at(b)], mesh.vertices[at(c)]};
}

/// Of the triangles `open`, of which a point is `gap` away.
double gap_at_most(const TriangleMesh& mesh, const BallsForTriangles& tree,
                   const std::vector<std::int32_t>& open, const Balls& balls, double gap, Monitor& monitor) {
  if (open.empty()) return 0;
  const Box box = bounding_box(mesh.vertices.span()), of_balls = bounding_box(balls);
  const double tolerance = std::max(0.01 * gap, 2e-4 * box.longest_edge());
  std::vector<double> most(open.size());
  for_each_block(open.size(), block_of(open.size()), monitor, 0.6, 0.7,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i)
                     most[i] = tree.gap_at_most(corners_of(mesh, at(open[i])), gap, tolerance);
                 });
  double largest = 0;
  for (const Vec3 p : {box.lower, box.upper, of_balls.lower, of_balls.upper})
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return *std::max_element(most.begin(), most.end()) + 0x1p-44 * largest;
}

void look_at_triangles(const TriangleMesh& mesh, const Balls& balls, Monitor& monitor, Enclosure& result) {
  const BallsForTriangles tree(balls);
  const double size = 0.005 * bounding_box(mesh.vertices.span()).longest_edge();
  std::vector<TriangleCover> covers(mesh.triangles.size());
  std::vector<double> gaps(covers.size());
  std::vector<UncoveredPart> parts(covers.size());
  const auto for_all = [&](double from, double to, const auto& look) {
    for_each_block(covers.size(), block_of(covers.size()), monitor, from, to,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t t = first; t < last; ++t) look(t, corners_of(mesh, t));
                   });
  };
  for_all(0, 0.3, [&](std::size_t t, const Corners& corners) {
    covers[t] = tree.cover(corners);
    if (covers[t].open && balls.size() > 0) gaps[t] = tree.gap_of_corners(corners);
  });
  // Most surfaces are farthest at a corner; then no part of a triangle has to be looked at for the gap.
  const double of_corners = *std::max_element(gaps.begin(), gaps.end());
  for_all(0.3, 0.6, [&](std::size_t t, const Corners& corners) {
    if (covers[t].open && balls.size() > 0) parts[t] = tree.uncovered(corners, size, of_corners);
  });
  std::vector<std::int32_t> open;
  std::vector<Vec3> points;
  std::vector<std::uint8_t> why;
  for (std::size_t t = 0; t < covers.size(); ++t) {
    const Corners p = corners_of(mesh, t);
    result.area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
    result.pieces += covers[t].pieces;
    result.open_area += parts[t].area;
    result.gap = std::max(result.gap, parts[t].gap);
    if (!covers[t].open) continue;
    open.push_back(static_cast<std::int32_t>(t));
    points.push_back(covers[t].point);
    why.push_back(static_cast<std::uint8_t>(*covers[t].open));
  }
  if (balls.size() == 0) result.open_area = result.area;
  if (balls.size() > 0) result.gap_at_most = gap_at_most(mesh, tree, open, balls, result.gap, monitor);
  result.open_triangles = std::move(open);
  result.open_points = std::move(points);
  result.open_why = std::move(why);
}

void look_at_voids(const PowerDiagram& diagram, const WindingNumber& winding, Monitor& monitor,
                   Enclosure& result) {
  std::vector<Vec3> points;
  std::vector<std::uint8_t> places;
  for (const UnionVoid& found : union_voids(diagram, winding, monitor)) {
    points.push_back(found.deepest);
    places.push_back(static_cast<std::uint8_t>(found.place));
  }
  result.void_points = std::move(points);
  result.void_places = std::move(places);
}

double protrusion(const TriangleMesh& mesh, const Balls& balls, const WindingNumber& winding,
                  Monitor& monitor) {
  const SurfaceTree surface(mesh, monitor);
  std::vector<double> reach(balls.size(), 0);
  for_each_block(balls.size(), 64, monitor, 0.85, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto near = surface.nearest(balls.centers[i], std::numeric_limits<double>::infinity());
      const double d = near ? near->distance : 0;
      const bool inside = winding.chain().closed() && winding.around(balls.centers[i]).number != 0;
      reach[i] = inside ? balls.radii[i] - d : balls.radii[i] + d;
    }
  });
  double most = 0;
  for (const double r : reach) most = std::max(most, r);
  return most;
}

std::string at_point(Vec3 p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
  return text;
}

[[noreturn]] void refuse(const Enclosure& found) {
  const std::string all = describe(found);
  if (!found.covers()) {
    const bool outside = found.open_why[0] == static_cast<std::uint8_t>(OpenTriangle::point_outside);
    throw InputError(all + "; the first is triangle " + std::to_string(found.open_triangles[0]) +
                         ": its point " + at_point(found.open_points[0]) +
                         (outside ? " is in no ball" : " is where balls meet without overlapping"),
                     outside ? "grow the balls, or use more of them; on_open: report lists all places"
                             : "grow the radii by a millionth");
  }
  const auto first = std::find_if(found.void_places.begin(), found.void_places.end(), [](std::uint8_t place) {
    return place != static_cast<std::uint8_t>(VoidPlace::outside);
  });
  const auto v = static_cast<std::size_t>(first - found.void_places.begin());
  throw InputError(all + "; " + at_point(found.void_points[v]) + " lies in the first",
                   "add a ball there; on_open: report lists all places");
}

}  // namespace

Enclosure verify_enclosure(const TriangleMesh& mesh, const Balls& balls,
                           const VerifyEnclosureOptions& options, Monitor& monitor,
                           const PowerDiagram* diagram, const TriangleMesh* solid) {
  for (const TriangleMesh* each : {&mesh, solid}) {
    if (each == nullptr) continue;
    if (const std::string broken = broken_invariant(*each); !broken.empty())
      throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  }
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball");
  }
  if (mesh.triangles.empty() && options.on_open != OnOpen::expect) {
    throw InputError("there are no triangles, so there is nothing to enclose",
                     "give a mesh; whether points are covered is what VerifyCover tells");
  }
  if (diagram != nullptr) check_diagram_of(*diagram, balls);
  Enclosure result;
  result.meant = options.on_open == OnOpen::expect ? 0 : 1;
  result.balls = static_cast<std::int64_t>(balls.size());
  result.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  if (mesh.triangles.empty()) return result;
  look_at_triangles(mesh, balls, monitor, result);
  PartMonitor seeking(monitor, 0.7, 0.85);
  const TriangleMesh& around = solid != nullptr ? *solid : mesh;
  const WindingNumber winding(around, seeking);
  if (solid != nullptr && !winding.chain().closed())
    throw InputError("nothing is inside of the solid: " + why_not_closed(winding.chain(), around),
                     "close it, or leave it away");
  result.closed = winding.chain().closed() ? 1 : 0;
  if (balls.size() > 0) {
    if (diagram != nullptr) {
      look_at_voids(*diagram, winding, seeking, result);
    } else {
      look_at_voids(power_diagram(balls, {}, seeking), winding, seeking, result);
    }
    result.protrusion = protrusion(around, balls, winding, monitor);
  }
  if (options.on_open == OnOpen::error && !result.encloses()) refuse(result);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
