#include "types/polygon2.hpp"

namespace ballflow::geometry {
namespace {

/// Offsets begin with 0, grow by at least `least` and end with `total`.
std::string broken_offsets(const Array<std::int64_t>& offsets, const char* name, std::int64_t least,
                           std::size_t total) {
  if (offsets.empty()) return std::string(name) + " is empty: it begins with 0";
  if (offsets[0] != 0) return std::string(name) + " begins with " + std::to_string(offsets[0]);
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    if (offsets[i + 1] - offsets[i] < least) {
      return std::string(name) + " grows by " + std::to_string(offsets[i + 1] - offsets[i]) +
             " after entry " + std::to_string(i) + ", at least " + std::to_string(least) + " is needed";
    }
  }
  if (offsets.back() != static_cast<std::int64_t>(total)) {
    return std::string(name) + " ends with " + std::to_string(offsets.back()) + ", not with " +
           std::to_string(total);
  }
  return {};
}

}  // namespace

double signed_area(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i) twice += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  return twice / 2;
}

double perimeter(std::span<const Vec2> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

double area(const Polygon2& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.rings(); ++i) sum += signed_area(polygon.ring(i));
  return sum;
}

double perimeter(const Polygon2& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.rings(); ++i) sum += perimeter(polygon.ring(i));
  return sum;
}

Box bounding_box(const Polygon2& polygon) {
  Box box;
  for (const Vec2 p : polygon.vertices) box.add(in_space(p));
  return box;
}

std::string broken_invariant(const Polygon2& polygon) {
  if (std::string broken = broken_offsets(polygon.ring_offsets, "ring_offsets", 3, polygon.vertices.size());
      !broken.empty()) {
    return broken;
  }
  if (std::string broken = broken_offsets(polygon.component_offsets, "component_offsets", 1, polygon.rings());
      !broken.empty()) {
    return broken;
  }
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    if (!is_finite(polygon.vertices[i])) return "vertex " + std::to_string(i) + " is not finite";
  }
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    for (std::int64_t i = polygon.component_offsets[k]; i < polygon.component_offsets[k + 1]; ++i) {
      const auto ring = polygon.ring(static_cast<std::size_t>(i));
      const bool outer = i == polygon.component_offsets[k];
      const double size = outer ? signed_area(ring) : -signed_area(ring), round = perimeter(ring);
      if (size < -0x1p-40 * round * round) {  // not by rounding
        return std::string(outer ? "outer ring " : "hole ") + std::to_string(i) + " runs " +
               (outer ? "clockwise" : "counter-clockwise");
      }
      for (std::size_t j = 0; j < ring.size(); ++j) {
        if (ring[j] == ring[(j + 1) % ring.size()]) {
          return "vertex " + std::to_string(j) + " of ring " + std::to_string(i) + " is repeated";
        }
      }
    }
  }
  return {};
}

}  // namespace ballflow::geometry
