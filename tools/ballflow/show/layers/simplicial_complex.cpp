// SimplicialComplex: triangles that bound tetrahedra, and the parts without: triangles, edges, isolated
// vertices. Interior triangles cannot be seen and are left out, and so are sides of what is there.
#include <cmath>
#include <cstdint>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

using geometry::SimplexClass;
using geometry::SimplicialComplex;
using geometry::Vec3;

/// A layer whose vertices are the balls that its simplices use.
class Part {
 public:
  Part(const SimplicialComplex& complex, const std::string& name, Shape shape)
      : complex_(complex), number_(complex.centers.size(), -1) {
    layer_.name = name;
    layer_.shape = shape;
  }

  void add_point(std::int32_t ball) { vertex(ball); }
  void add(const std::array<std::int32_t, 2>& edge) {
    layer_.segments.push_back({vertex(edge[0]), vertex(edge[1])});
  }
  void add(const std::array<std::int32_t, 3>& triangle) {
    layer_.triangles.push_back({vertex(triangle[0]), vertex(triangle[1]), vertex(triangle[2])});
  }

  Layer take() {
    layer_.vertices = std::move(centers_);
    layer_.attributes = {radius_attribute(radii_)};
    return std::move(layer_);
  }

 private:
  std::uint32_t vertex(std::int32_t ball) {
    const auto i = static_cast<std::size_t>(ball);
    if (number_[i] < 0) {
      number_[i] = static_cast<std::int64_t>(centers_.size());
      centers_.push_back(complex_.centers[i]);
      radii_.push_back(std::sqrt(complex_.weights[i]));
    }
    return static_cast<std::uint32_t>(number_[i]);
  }

  const SimplicialComplex& complex_;
  std::vector<std::int64_t> number_;
  std::vector<Vec3> centers_;
  std::vector<double> radii_;
  Layer layer_;
};

std::vector<Layer> layers_of_simplicial_complex(const Artifact& artifact) {
  const auto complex = typed<SimplicialComplex>(artifact);
  const auto is = [](std::uint8_t value, SimplexClass expected) {
    return value == static_cast<std::uint8_t>(expected);
  };
  Part regular(complex, "regular triangles", Shape::triangles);
  Part singular(complex, "singular triangles", Shape::triangles);
  Part edges(complex, "singular edges", Shape::segments);
  Part vertices(complex, "isolated vertices", Shape::points);
  for (std::size_t i = 0; i < complex.triangles.size(); ++i) {
    if (is(complex.triangle_classes[i], SimplexClass::regular)) regular.add(complex.triangles[i]);
    if (is(complex.triangle_classes[i], SimplexClass::singular)) singular.add(complex.triangles[i]);
  }
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    if (is(complex.edge_classes[i], SimplexClass::singular)) edges.add(complex.edges[i]);
  }
  for (std::size_t i = 0; i < complex.vertices.size(); ++i) {
    if (is(complex.vertex_classes[i], SimplexClass::singular)) vertices.add_point(complex.vertices[i]);
  }
  return {regular.take(), singular.take(), edges.take(), vertices.take()};
}

}  // namespace

TypeLayers simplicial_complex_layers() { return {"SimplicialComplex", layers_of_simplicial_complex}; }

}  // namespace ballflow::show
