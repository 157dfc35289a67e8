// Where upward rays meet a set of triangles, decided exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A bounding volume hierarchy over triangles that answers: which of them does the ray from a point in the
/// direction of +z cross, and from which side?
///
/// The ray is moved sideways by (e, e^2) for an infinitely small e, so it meets no edge and no vertex, and a
/// closed chain of triangles is crossed outwards once more than inwards exactly as often as it winds around
/// the point. All signs are exact.
class SignedCrossings {
 public:
  /// Any triangles with finite corners, degenerate ones too.
  SignedCrossings(std::span<const Vec3> vertices, std::span<const Triangle> triangles, Monitor& monitor);

  /// Calls visit(triangle, sign, on) for every triangle above `point`, ordered deterministically: sign is +1
  /// where the triangle is counter-clockwise seen from above, else -1; `on` says that the point lies exactly
  /// in the plane of the triangle.
  template <class Visit>
  void for_each_above(Vec3 point, Visit visit) const {
    if (nodes_.empty()) return;
    std::int32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::int32_t index = stack[--depth];
      const Node& node = nodes_[static_cast<std::size_t>(index)];
      if (point.x < node.lower_x || point.x > node.upper_x || point.y < node.lower_y ||
          point.y > node.upper_y || point.z > node.upper_z) {
        continue;
      }
      if (node.count == 0) {
        stack[depth++] = node.link;
        stack[depth++] = index + 1;
        continue;
      }
      for (std::int32_t k = node.link; k < node.link + node.count; ++k) {
        bool on = false;
        const int sign = crossing(corners_[static_cast<std::size_t>(k)], point, on);
        if (sign != 0) visit(ids_[static_cast<std::size_t>(k)], sign, on);
      }
    }
  }

 private:
  struct Corners {
    Vec3 a, b, c;
  };
  struct Node {  // floats rounded outwards; nothing bounds a node from below, rays go up
    float lower_x, upper_x, lower_y, upper_y, upper_z;
    std::int32_t link;   // leaf: first triangle; else the second child, the first one follows its parent
    std::int32_t count;  // of triangles in a leaf, else 0
  };

  static int crossing(const Corners& triangle, Vec3 point, bool& on);

  std::vector<Node> nodes_;       // in preorder
  std::vector<Corners> corners_;  // in the order of the leaves
  std::vector<std::int32_t> ids_;
};

}  // namespace ballflow::geometry
