// SimplicialComplex, its vertices numbered anew in their order. Most formats show what can be seen: interior
// triangles are left out, and so are sides of triangles. ma is for computing and has all triangles and edges.
#include <cmath>

#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::SimplexClass;
using geometry::SimplicialComplex;

constexpr auto interior = static_cast<std::uint8_t>(SimplexClass::interior);
constexpr auto singular = static_cast<std::uint8_t>(SimplexClass::singular);

/// The simplices for which the last two arguments say yes to their class.
template <class EdgeFilter, class TriangleFilter>
PolyData part(const SimplicialComplex& complex, EdgeFilter keeps_edge, TriangleFilter keeps_triangle) {
  PolyData data;
  std::vector<std::int32_t> number(complex.centers.size());
  std::vector<geometry::Vec3> points;
  std::vector<double> radii;
  for (std::size_t i = 0; i < complex.vertices.size(); ++i) {
    const auto ball = static_cast<std::size_t>(complex.vertices[i]);
    number[ball] = static_cast<std::int32_t>(i);
    points.push_back(complex.centers[ball]);
    radii.push_back(std::sqrt(complex.weights[ball]));
    if (complex.vertex_classes[i] == singular) data.dots.push_back(static_cast<std::int32_t>(i));
  }
  const auto renumbered = [&number](auto simplex) {
    for (std::int32_t& v : simplex) v = number[static_cast<std::size_t>(v)];
    return simplex;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    if (keeps_edge(complex.edge_classes[i])) edges.push_back(renumbered(complex.edges[i]));
  }
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> classes;
  for (std::size_t i = 0; i < complex.triangles.size(); ++i) {
    if (!keeps_triangle(complex.triangle_classes[i])) continue;
    triangles.push_back(renumbered(complex.triangles[i]));
    classes.push_back(complex.triangle_classes[i]);
  }
  data.points = std::move(points);
  data.radii = std::move(radii);
  data.edges = std::move(edges);
  data.set_triangles(triangles);
  data.polygon_codes = {"class", std::move(classes)};
  data.dot_and_edge_code = singular;
  return data;
}

PolyData visible(const SimplicialComplex& complex) {
  return part(
      complex, [](std::uint8_t c) { return c == singular; }, [](std::uint8_t c) { return c != interior; });
}

PolyData everything(const SimplicialComplex& complex) {
  const auto all = [](std::uint8_t) { return true; };
  return part(complex, all, all);
}

}  // namespace

TypeFormats simplicial_complex_formats() {
  using Complex = SimplicialComplex;
  return {"SimplicialComplex",
          {format<Complex, visible, write_ply>("ply"),
           format<Complex, visible, write_obj>("obj"),
           format<Complex, visible, write_off>("off"),
           format<Complex, visible, write_stl>("stl"),
           format<Complex, visible, write_vtp>("vtp"),
           {"glb", write_glb},
           format<Complex, everything, write_ma>("ma"),
           format<Complex, visible, write_csv>("csv"),
           format<Complex, visible, write_npy>("npy")}};
}

}  // namespace ballflow
