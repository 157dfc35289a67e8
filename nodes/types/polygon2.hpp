// Polygons in the plane: several components, each with holes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/array.hpp"
#include "base/vec2.hpp"

namespace ballflow::geometry {

/// Ring i is the closed chain of vertices[ring_offsets[i] .. ring_offsets[i + 1]), component k the rings
/// component_offsets[k] .. component_offsets[k + 1]: first the outer one, counter-clockwise, then its holes,
/// clockwise, so that the inside is on the left everywhere. What lies in a hole is a component of its own.
///
/// Rings that were read (planar/ring_nesting.hpp) have no point in common, neither with themselves nor with
/// each other; the outlines of discs may touch.
struct Polygon2 {
  Array<Vec2> vertices;                   // n x 2, model units, y upwards; finite
  Array<std::int64_t> ring_offsets;       // rings + 1
  Array<std::int64_t> component_offsets;  // components + 1

  std::size_t rings() const { return ring_offsets.empty() ? 0 : ring_offsets.size() - 1; }
  std::size_t components() const { return component_offsets.empty() ? 0 : component_offsets.size() - 1; }
  std::span<const Vec2> ring(std::size_t i) const {
    const auto first = static_cast<std::size_t>(ring_offsets[i]);
    return vertices.span().subspan(first, static_cast<std::size_t>(ring_offsets[i + 1]) - first);
  }
};

/// The signed area of a ring, positive for counter-clockwise ones, up to rounding.
double signed_area(std::span<const Vec2> ring);
double perimeter(std::span<const Vec2> ring);

/// Of all rings: the area of what is inside.
double area(const Polygon2& polygon);
double perimeter(const Polygon2& polygon);

/// In the plane z = 0.
Box bounding_box(const Polygon2& polygon);

/// Empty when the invariants above hold but for crossings, which are dear to look for, else what is wrong and
/// where.
std::string broken_invariant(const Polygon2& polygon);

}  // namespace ballflow::geometry
