#include "look/look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Spacing spacing_of(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      lengths.push_back(distance(mesh.vertices[at(t[k])], mesh.vertices[at(t[(k + 1) % 3])]));
  }
  if (lengths.empty()) return {};
  const double largest = *std::max_element(lengths.begin(), lengths.end());
  return {middle_of(lengths), largest};
}

Spacing spacing_of(std::span<const Vec3> points, Monitor& monitor) {
  Lookout look(monitor);
  const BoxTree tree(points, BoxTree::default_leaf_size, monitor);
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size() && points.size() > 1; ++i) {
    look(64);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    distances.push_back(tree.smallest(points[i], infinity, -1, [&](std::size_t k) {
      return k == i ? infinity : distance(points[i], points[k]);
    }));
  }
  if (distances.empty()) return {};
  const double largest = *std::max_element(distances.begin(), distances.end());
  return {middle_of(distances), largest};
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[at(a)];
    sum += length(cross(mesh.vertices[at(b)] - p, mesh.vertices[at(c)] - p)) / 2;
  }
  return sum;
}

/// Why the solid inside the surface has no known topology; empty when it has.
std::string why_unknown(const Look& look) {
  const MeshTopology& mesh = look.topology;
  if (mesh.boundary_edges > 0) return "the surface is open";
  if (!mesh.closed || !mesh.manifold) return "the surface is not a manifold";
  if (!look.orientable) return "the surface is not orientable";
  if (!look.intersections.flat.empty()) return "the surface has triangles without area";
  if (!look.intersections.pairs.empty()) return "the surface intersects itself";
  return "";
}

void look_inside(const SurfaceChain& chain, const LookOptions& options, Look& look, Monitor& monitor) {
  TriangleMesh& mesh = look.outwards;
  look.shells = shells_of(mesh, monitor);
  const Shells& shells = *look.shells;
  std::vector<Triangle> triangles = chain.triangles;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (shells.inside_out != shells.shells[at(shells.shell[f])].turned)
      std::swap(triangles[f][1], triangles[f][2]);
  }
  mesh.triangles = std::move(triangles);
  look.widths = widths_of(mesh, options.widths, monitor);
  if (look.unknown_because.empty()) look.betti = shells.betti();
}

}  // namespace

Vec3 place_of(const TriangleMesh& mesh, const std::array<std::int32_t, 2>& pair) {
  std::array<Box, 2> boxes;
  for (std::size_t i = 0; i < 2; ++i) {
    for (const std::int32_t v : mesh.triangles[at(pair[i])]) boxes[i].add(mesh.vertices[at(v)]);
  }
  const auto& [a, b] = boxes;
  const auto between = [](double low_a, double low_b, double high_a, double high_b) {
    return (std::max(low_a, low_b) + std::min(high_a, high_b)) / 2;
  };
  return {between(a.lower.x, b.lower.x, a.upper.x, b.upper.x),
          between(a.lower.y, b.lower.y, a.upper.y, b.upper.y),
          between(a.lower.z, b.lower.z, a.upper.z, b.upper.z)};
}

Look look_at(const MeshFile& model, const LookOptions& options, Monitor& monitor) {
  Look look;
  const auto points = model.points.points.span();
  look.box = bounding_box(points);
  const TriangleMesh& mesh = model.mesh;
  look.strays = find_strays(points, mesh.triangles.span(), monitor);
  if (mesh.triangles.empty()) {
    look.spacing = spacing_of(points, monitor);
    return look;
  }
  look.spacing = spacing_of(mesh);
  look.area = area_of(mesh);
  look.topology = mesh_topology(mesh);
  monitor.step(0.1);
  const SurfaceChain chain = surface_chain(mesh);
  look.turned = chain.turned;
  look.orientable = chain.contradictions == 0;
  look.closed = chain.closed();
  monitor.step(0.2);
  look.intersections = self_intersections(mesh, options.most_intersections, monitor);
  monitor.step(0.5);
  look.unknown_because = why_unknown(look);
  look.gaps = gaps_of(mesh, monitor);
  monitor.step(0.6);
  if (look.closed) {
    look.outwards = {mesh.vertices, chain.triangles};
    look_inside(chain, options, look, monitor);
  }
  monitor.step(1);
  return look;
}

}  // namespace ballflow::geometry
