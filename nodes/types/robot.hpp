// A robot: links with their surfaces, and the joints between them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/array.hpp"
#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A rotation, row by row, and a translation behind it: x -> R x + t.
using Pose = std::array<double, 12>;
constexpr Pose no_motion = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

inline Vec3 turned(const Pose& p, Vec3 v) {
  return {p[0] * v.x + p[1] * v.y + p[2] * v.z, p[3] * v.x + p[4] * v.y + p[5] * v.z,
          p[6] * v.x + p[7] * v.y + p[8] * v.z};
}
inline Vec3 moved(const Pose& p, Vec3 v) { return turned(p, v) + Vec3{p[9], p[10], p[11]}; }
/// b, then a.
Pose composed(const Pose& a, const Pose& b);
/// A rotation by `turns` full turns around a unit axis through the origin.
Pose rotation(Vec3 axis, double turns);

enum class JointKind : std::uint8_t {
  fixed = 0,
  revolute = 1,    // between limits
  continuous = 2,  // around without end
  prismatic = 3,   // along the axis, between limits
  floating = 4,    // anywhere
  planar = 5,      // in the plane across the axis
};

/// Text as an array, and names, one a line.
using Text = Array<std::uint8_t>;
Text text_of(std::string_view text);
Text names_text(const std::vector<std::string>& names);
inline std::string_view view(const Text& text) {
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}
std::vector<std::string> names_of(const Text& text);

/// What moves against what. Links are in the order of the description; one of them is the child of no joint.
struct RobotTree {
  Text description;  // the URDF that it was read from, as it was
  Text name;
  Text link_names;                            // l names, different
  Text joint_names;                           // j = l - 1 names, different
  Array<std::uint8_t> joint_kinds;            // j: JointKind
  Array<std::int32_t> joint_parents;          // j: links
  Array<std::int32_t> joint_children;         // j: links, each once
  Array<Pose> joint_origins;                  // j x 12: frame of the child in that of the parent at 0; metres
  Array<Vec3> joint_axes;                     // j x 3: unit vectors in the frame of the child
  Array<std::array<double, 2>> joint_limits;  // j x 2: radians or metres; of those that have no limits 0, 0
  Array<std::int32_t> joint_mimics;           // j: the joint that it follows, or -1
  Array<std::array<double, 2>> joint_mimic_lines;  // j x 2: value = first * value of that joint + second
};

struct Robot : RobotTree {
  Array<std::int64_t> vertex_ends;    // l: where the vertices of each link end
  Array<std::int64_t> triangle_ends;  // l
  Array<Vec3> vertices;               // in the frame of their link, metres
  Array<Triangle> triangles;          // their vertices by place in their link

  std::size_t links() const { return vertex_ends.size(); }
};

/// The surface of a link.
TriangleMesh mesh_of(const Robot& robot, std::size_t link);

/// Frames of all links in that of the root, for values of all joints (those that follow others: any).
std::vector<Pose> link_poses(const RobotTree& tree, const std::vector<double>& values);

/// Values of all joints where each is at 0, or at the limit nearest to it.
std::vector<double> default_values(const RobotTree& tree);

/// How the value of a joint comes from that of another one: factor * value of `joint` + offset. The joint is
/// itself, with 1 and 0, where it follows none; one that follows another that follows a third comes from
/// that.
struct JointSource {
  std::size_t joint = 0;
  double factor = 1, offset = 0;
};
JointSource source_of(const RobotTree& tree, std::size_t joint);

/// Links from the root on, parents before children.
std::vector<std::size_t> from_root(const RobotTree& tree);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const RobotTree& tree);
std::string broken_invariant(const Robot& robot);

}  // namespace ballflow::geometry
