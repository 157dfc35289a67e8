#include "mesh/boundary_gap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/circle.hpp"
#include "base/for_each_block.hpp"
#include "mesh/arc_net.hpp"
#include "mesh/sphere_geometry.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Places on the circle in which two spheres meet.
void add_circle(Vec3 a, double ra, Vec3 b, double rb, double spacing, std::vector<Vec3>& places) {
  const Vec3 ab = b - a;
  const double d = length(ab);
  if (!(d > 0)) return;
  const Vec3 axis = 1 / d * ab;
  const double along = (d * d + ra * ra - rb * rb) / (2 * d), squared = ra * ra - along * along;
  if (!(squared > 0)) return;
  const double radius = std::sqrt(squared);
  const Projection frame(a, 1, axis);  // for its axes
  const auto count = static_cast<std::int64_t>(
      std::clamp(std::ceil(2 * 3.14159265358979323846 * radius / spacing), 6.0, 4096.0));
  for (std::int64_t k = 0; k < count; ++k) {
    const auto [c, s] = on_circle(static_cast<double>(k) / static_cast<double>(count));
    places.push_back(a + along * axis + radius * (c * frame.right + s * frame.ahead));
  }
}

void add_sphere(Vec3 c, double r, std::vector<Vec3>& places) {
  for (int k = 0; k < 27; ++k) {
    const Vec3 d{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
    if (d != Vec3{}) places.push_back(c + r / length(d) * d);
  }
}

/// Places on the boundary, and some inside the union.
std::vector<Vec3> places_of(const Balls& balls, const PowerDiagram& diagram, const SimplicialComplex& complex,
                            double spacing, Monitor& monitor) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  constexpr auto interior = static_cast<std::uint8_t>(SimplexClass::interior);
  std::vector<Vec3> places;
  Lookout look(monitor);
  // Where rounding hides the arcs, all of every circle.
  const double extent = bounding_box(balls).longest_edge();
  if (const auto net = ArcNet::of(diagram, complex, 0.25 * spacing, extent, monitor)) {
    places = net->points();
  } else {
    for (std::size_t e = 0; e < complex.edges.size(); ++e) {
      if (complex.edge_classes[e] == interior) continue;
      look(4096);
      const auto [i, j] = complex.edges[e];
      add_circle(balls.centers[at(i)], balls.radii[at(i)], balls.centers[at(j)], balls.radii[at(j)], spacing,
                 places);
    }
  }
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    if (complex.vertex_classes[v] == interior) continue;
    look(32);
    const double radius = balls.radii[at(complex.vertices[v])];
    if (radius <= 8 * spacing) add_sphere(balls.centers[at(complex.vertices[v])], radius, places);
  }
  return places;
}

}  // namespace

double boundary_gap(const Balls& balls, const PowerDiagram& diagram, const SimplicialComplex& complex,
                    const TriangleMesh& mesh, double spacing, double at_least, Monitor& monitor) {
  const std::vector<Vec3> places = places_of(balls, diagram, complex, spacing, monitor);
  BoxTree inside(balls.centers.span(), BoxTree::default_leaf_size, monitor);
  inside.set_slacks(balls.radii);
  const BoxTree faces(boxes_of(mesh.vertices.span(), mesh.triangles.span()), BoxTree::default_leaf_size,
                      monitor);
  const double rounding = 1e-9 * bounding_box(balls).longest_edge();
  const auto to_face = [&](Vec3 p, std::size_t t) {
    const auto corner = [&](std::size_t k) {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
    };
    return distance_to_triangle(p, corner(0), corner(1), corner(2));
  };
  constexpr std::size_t block = 256;
  std::vector<double> most(blocks_of(places.size(), block), at_least);
  for_each_block(
      places.size(), block, monitor, 0, 1, [&](std::size_t b, std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
          const Vec3 p = places[k];
          const auto depth = [&](std::size_t i) { return distance(p, balls.centers[i]) - balls.radii[i]; };
          if (inside.smallest(p, infinity, -rounding, depth) < -rounding) continue;
          most[b] = std::max(
              most[b], faces.smallest(p, infinity, most[b], [&](std::size_t t) { return to_face(p, t); }));
        }
      });
  return most.empty() ? at_least : *std::max_element(most.begin(), most.end());
}

double mesh_gap(const Balls& balls, const TriangleMesh& mesh, Monitor& monitor) {
  BoxTree inside(balls.centers.span(), BoxTree::default_leaf_size, monitor);
  inside.set_slacks(balls.radii);
  constexpr std::size_t block = 1024;
  std::vector<double> most(blocks_of(mesh.triangles.size(), block), 0);
  for_each_block(
      mesh.triangles.size(), block, monitor, 0, 1, [&](std::size_t b, std::size_t first, std::size_t last) {
        const auto look_at = [&](Vec3 p) {
          const auto depth = [&](std::size_t i) { return distance(p, balls.centers[i]) - balls.radii[i]; };
          const double off = std::abs(inside.smallest(p, infinity, -infinity, depth));
          most[b] = std::max(most[b], off);
          return off;
        };
        for (std::size_t t = first; t < last; ++t) {
          const auto corner = [&](std::size_t k) {
            return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k % 3])];
          };
          const Vec3 sum = corner(0) + corner(1) + corner(2);
          look_at((1.0 / 3) * sum);
          for (std::size_t k = 0; k < 3; ++k) {
            look_at(corner(k));
            look_at(0.5 * corner(k) + (1.0 / 6) * sum);
            if (mesh.triangles[t][k] > mesh.triangles[t][(k + 1) % 3]) continue;
            // An edge from one sphere to another is farthest off where it leaves the first, anywhere.
            const Vec3 p = corner(k), way = corner(k + 1) - p;
            if (look_at(p + 0.5 * way) < 0.5 * most[b]) continue;
            for (const double part : {0.125, 0.25, 0.375, 0.625, 0.75, 0.875}) look_at(p + part * way);
          }
        }
      });
  return most.empty() ? 0 : *std::max_element(most.begin(), most.end());
}

}  // namespace ballflow::geometry
