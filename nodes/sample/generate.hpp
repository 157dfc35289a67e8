// Models from formulae: smooth and sharp, of known genus, made of + - * / and square roots alone (of these is
// the exponential, too), so that every machine makes the same bytes. torusBalls, 3cross, doubleTorus, knot
// and sTube stand for the models of the same names in Kornberger 2010, which were never published.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class Shape {
  sphere,
  torus,
  double_torus,
  torus_balls,
  cross,
  knot,
  s_tube,
  box,
  bracket,
  frame,
  bump_box
};

struct ShapeOptions {
  Shape shape = Shape::torus;
  /// About this many vertices (within a few percent where n is large); 0 = the shape's own number.
  std::int64_t n = 0;
  /// The large and the small size of the shape, model units; 0 = the shape's own (r: in proportion to R).
  double R = 0;
  double r = 0;
};

/// What there is to know about a shape: its name, genus and own sizes.
struct ShapeInfo {
  Shape shape;
  const char* name;
  const char* doc;  // what R and r are
  std::int64_t genus;
  std::int64_t n;      // its own number of vertices
  double R;            // its own large size
  double r_per_R;      // its own small size, in units of R
  double max_r_per_R;  // r stays below this many R
};

std::span<const ShapeInfo> shapes();
const ShapeInfo& shape_info(Shape shape);

/// "torus", "torus?R=1&r=0.3&n=20000": the name of a shape, then any of n, R, r. Throws InputError for an
/// unknown name or parameter (listing those there are) and for a value that is no number.
ShapeOptions parse_shape(std::string_view text);

/// The surface of the shape: closed, manifold, outward oriented, in one component, of the shape's genus.
///
/// - At the shape's own sizes no two vertices are nearer than a third of the mean edge length.
/// - Vertices of the smooth shapes lie on the surface up to rounding, evenly spaced; those of box, bracket
///   and bumpBox lie on a grid that has every sharp edge as a grid line.
///
/// Throws InputError for sizes out of range and when n is too small for the features of the shape.
TriangleMesh generate(const ShapeOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
