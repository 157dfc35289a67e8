// What can be seen of an artifact: layers of points, balls, segments and triangles with values to colour them
// by. The viewer, the pictures and the glTF export all draw this, and know no artifact type.
//
// A new artifact type gets its layers from one file in layers/ and one line in layer_table.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/artifact.hpp"
#include "base/array.hpp"
#include "base/vec3.hpp"
#include "show/chain.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::show {

enum class Shape : std::uint8_t { points, balls, segments, triangles };
std::string_view to_string(Shape shape);

/// One number per vertex or per element to colour by.
struct Attribute {
  std::string name;                     // "radius"; unique in its layer
  std::string unit;                     // "model units"; empty for none
  std::vector<std::string> categories;  // not empty: the values are indices into it
  bool per_vertex = true;               // else one value per segment or triangle
  std::vector<double> values;           // finite
};

/// The vertices of a layer are its elements when it has points or balls.
struct Layer {
  std::string name;  // "inner poles"; unique in its scene
  Shape shape = Shape::points;
  geometry::Array<geometry::Vec3> vertices;             // n x 3, model units
  geometry::Array<double> radii;                        // n, balls only
  std::vector<std::array<std::uint32_t, 2>> segments;   // m x 2 indices of vertices, segments only
  std::vector<std::array<std::uint32_t, 3>> triangles;  // m x 3 indices of vertices, triangles only
  std::vector<Attribute> attributes;
  std::string colour_by;  // name of the attribute that is shown at first; empty for one plain colour
  double opacity = 1;     // at first; in (0, 1]
  bool visible = true;    // at first
  bool smooth = false;  // triangles stand for a smooth surface, apart from sharp edges; else they are facets

  // What moves in pages, with the frame that each vertex goes with; null and empty where nothing does. The
  // vertices are where they are when the joints have the values of the chain.
  std::shared_ptr<const Chain> chain;
  std::vector<std::uint32_t> frames;  // n

  /// Points, balls, segments or triangles.
  std::size_t elements() const;
  const Attribute* find(std::string_view attribute) const;
};

/// True when the type has layers.
bool can_be_shown(std::string_view type);
std::vector<std::string> shown_types();

/// The layers of an artifact, those without elements left out. Throws Error: usage when its type has none,
/// store when its arrays break the type.
std::vector<Layer> layers_of(const Artifact& artifact);

/// The layer of a PointSet and of a TriangleMesh, also of those that are no artifacts.
Layer layer_of(const geometry::PointSet& points);
Layer layer_of(const geometry::TriangleMesh& mesh);

/// Bounding box of everything in the layers, balls with their radii.
geometry::Box bounding_box(const std::vector<Layer>& layers);

/// Empty when indices are in range and values have the lengths that they should have, else what is wrong.
std::string broken_invariant(const Layer& layer);

}  // namespace ballflow::show
