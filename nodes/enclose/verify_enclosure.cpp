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
#include "power/power_diagram.hpp"
#include "power/voids.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Corners corners_of(const TriangleMesh& mesh, std::size_t t) {
  const auto [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[at(a)], mesh.vertices[at(b)], mesh.vertices[at(c)]};
}

void look_at_triangles(const TriangleMesh& mesh, const Balls& balls, Monitor& monitor, Enclosure& result) {
  const BallsForTriangles tree(balls);
  const double size = 0.005 * bounding_box(mesh.vertices.span()).longest_edge();
  std::vector<TriangleCover> covers(mesh.triangles.size());
  std::vector<UncoveredPart> parts(mesh.triangles.size());
  constexpr std::size_t block = 16;
  for_each_block(covers.size(), block, monitor, 0, 0.7,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t t = first; t < last; ++t) {
                     covers[t] = tree.cover(corners_of(mesh, t));
                     if (covers[t].open && balls.size() > 0)
                       parts[t] = tree.uncovered(corners_of(mesh, t), size);
                   }
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
  result.open_triangles = std::move(open);
  result.open_points = std::move(points);
  result.open_why = std::move(why);
}

/// Of every void the place where the balls are farthest away, by their powers.
void look_at_voids(const PowerDiagram& diagram, const WindingNumber& winding, Monitor& monitor,
                   Enclosure& result) {
  const Voids voids(diagram, monitor);
  SimplicialComplex balls;  // what power_vertex looks at
  balls.centers = diagram.centers;
  balls.weights = diagram.weights;
  std::vector<Vec3> points;
  std::vector<std::uint8_t> places;
  for (std::int32_t v = Voids::outer + 1; v < voids.count(); ++v) {
    PowerVertex deepest{{}, -std::numeric_limits<double>::infinity()};
    for (const Voids::Cell& cell : voids.cells_of(v)) {
      const PowerVertex vertex = power_vertex(balls, cell);
      if (vertex.power > deepest.power) deepest = vertex;  // false for what is not finite
    }
    VoidPlace place = VoidPlace::unknown;
    if (winding.chain().closed()) {
      place = winding.around(deepest.point).number == 0 ? VoidPlace::outside : VoidPlace::inside;
    }
    points.push_back(deepest.point);
    places.push_back(static_cast<std::uint8_t>(place));
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
                           const PowerDiagram* diagram) {
  if (const std::string broken = broken_invariant(mesh); !broken.empty()) {
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  }
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball");
  }
  if (mesh.triangles.empty()) {
    throw InputError("there are no triangles, so there is nothing to enclose",
                     "give a mesh; whether points are covered is what VerifyCover tells");
  }
  if (diagram != nullptr) check_diagram_of(*diagram, balls);
  Enclosure result;
  result.meant = options.on_open == OnOpen::expect ? 0 : 1;
  result.balls = static_cast<std::int64_t>(balls.size());
  result.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  look_at_triangles(mesh, balls, monitor, result);
  PartMonitor seeking(monitor, 0.7, 0.85);
  const WindingNumber winding(mesh, seeking);
  result.closed = winding.chain().closed() ? 1 : 0;
  if (balls.size() > 0) {
    if (diagram != nullptr) {
      look_at_voids(*diagram, winding, seeking, result);
    } else {
      look_at_voids(power_diagram(balls, {}, seeking), winding, seeking, result);
    }
    result.protrusion = protrusion(mesh, balls, winding, monitor);
  }
  if (options.on_open == OnOpen::error && !result.encloses()) refuse(result);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
