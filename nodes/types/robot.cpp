#include "types/robot.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/circle.hpp"

namespace ballflow::geometry {

Pose composed(const Pose& a, const Pose& b) {
  Pose result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      result[3 * i + k] = a[3 * i] * b[k] + a[3 * i + 1] * b[3 + k] + a[3 * i + 2] * b[6 + k];
  }
  const Vec3 t = moved(a, {b[9], b[10], b[11]});
  result[9] = t.x, result[10] = t.y, result[11] = t.z;
  return result;
}

Pose rotation(Vec3 u, double turns) {
  const auto [c, s] = on_circle(turns);
  const double d = 1 - c;
  return {c + d * u.x * u.x,
          d * u.x * u.y - s * u.z,
          d * u.x * u.z + s * u.y,
          d * u.y * u.x + s * u.z,
          c + d * u.y * u.y,
          d * u.y * u.z - s * u.x,
          d * u.z * u.x - s * u.y,
          d * u.z * u.y + s * u.x,
          c + d * u.z * u.z,
          0,
          0,
          0};
}

Text text_of(std::string_view text) { return std::vector<std::uint8_t>(text.begin(), text.end()); }

Text names_text(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += name + '\n';
  return text_of(all);
}

std::vector<std::string> names_of(const Text& text) {
  std::vector<std::string> names;
  std::string_view rest = view(text);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    names.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return names;
}

TriangleMesh mesh_of(const Robot& robot, std::size_t link) {
  const auto part = [&](const auto& all, const Array<std::int64_t>& ends) {
    const auto begin = static_cast<std::size_t>(link == 0 ? 0 : ends[link - 1]);
    const auto end = static_cast<std::size_t>(ends[link]);
    using A = std::remove_cvref_t<decltype(all)>;
    return A(all.data() + begin, end - begin, all.owner());
  };
  return {part(robot.vertices, robot.vertex_ends), part(robot.triangles, robot.triangle_ends)};
}

std::vector<std::size_t> from_root(const RobotTree& tree) {
  const std::size_t joints = tree.joint_kinds.size();
  std::vector<std::vector<std::size_t>> children(joints + 1);
  std::vector<bool> is_child(joints + 1, false);
  for (std::size_t j = 0; j < joints; ++j) {
    children[static_cast<std::size_t>(tree.joint_parents[j])].push_back(
        static_cast<std::size_t>(tree.joint_children[j]));
    is_child[static_cast<std::size_t>(tree.joint_children[j])] = true;
  }
  std::vector<std::size_t> order;
  for (std::size_t link = 0; link <= joints; ++link) {
    if (!is_child[link]) order.push_back(link);
  }
  for (std::size_t i = 0; i < order.size() && order.size() <= joints + 1; ++i)
    order.insert(order.end(), children[order[i]].begin(), children[order[i]].end());
  return order;
}

std::vector<double> default_values(const RobotTree& tree) {
  std::vector<double> values(tree.joint_kinds.size(), 0);
  for (std::size_t j = 0; j < values.size(); ++j) {
    const auto [lower, upper] = tree.joint_limits[j];
    if (tree.joint_kinds[j] != static_cast<std::uint8_t>(JointKind::continuous) && lower <= upper)
      values[j] = std::clamp(0.0, lower, upper);
  }
  return values;
}

JointSource source_of(const RobotTree& tree, std::size_t joint) {
  JointSource source{joint, 1, 0};
  // As far as there are joints.
  for (std::size_t steps = 0; tree.joint_mimics[source.joint] >= 0 && steps < tree.joint_kinds.size();
       ++steps) {
    source.offset += source.factor * tree.joint_mimic_lines[source.joint][1];
    source.factor *= tree.joint_mimic_lines[source.joint][0];
    source.joint = static_cast<std::size_t>(tree.joint_mimics[source.joint]);
  }
  return source;
}

std::vector<Pose> link_poses(const RobotTree& tree, const std::vector<double>& values) {
  constexpr double full_turn = 6.283185307179586476925;
  std::vector<Pose> poses(tree.joint_kinds.size() + 1, no_motion);
  std::vector<std::size_t> joint_of(poses.size());
  for (std::size_t j = 0; j < tree.joint_kinds.size(); ++j)
    joint_of[static_cast<std::size_t>(tree.joint_children[j])] = j;
  const std::vector<std::size_t> order = from_root(tree);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t joint = joint_of[order[i]];
    const JointSource source = source_of(tree, joint);
    const double value =
        source.joint == joint ? values[joint] : source.factor * values[source.joint] + source.offset;
    Pose motion = no_motion;
    const Vec3 axis = tree.joint_axes[joint];
    switch (static_cast<JointKind>(tree.joint_kinds[joint])) {
      case JointKind::revolute:
      case JointKind::continuous:
        motion = rotation(axis, value / full_turn);
        break;
      case JointKind::prismatic:
        motion[9] = value * axis.x, motion[10] = value * axis.y, motion[11] = value * axis.z;
        break;
      default:
        break;
    }
    const Pose local = composed(tree.joint_origins[joint], motion);
    poses[order[i]] = composed(poses[static_cast<std::size_t>(tree.joint_parents[joint])], local);
  }
  return poses;
}

std::string broken_invariant(const RobotTree& tree) {
  const std::vector<std::string> links = names_of(tree.link_names), joints = names_of(tree.joint_names);
  if (links.empty()) return "there is no link";
  if (std::set<std::string>(links.begin(), links.end()).size() != links.size())
    return "two links have one name";
  if (std::set<std::string>(joints.begin(), joints.end()).size() != joints.size())
    return "two joints have one name";
  if (joints.size() != tree.joint_kinds.size() || joints.size() + 1 != links.size())
    return std::to_string(links.size()) + " links do not go with " + std::to_string(tree.joint_kinds.size()) +
           " joints named " + std::to_string(joints.size());
  std::vector<bool> is_child(links.size(), false);
  const auto count = static_cast<std::int32_t>(links.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::string where = "joint " + std::to_string(j) + " ";
    const std::int32_t parent = tree.joint_parents[j], child = tree.joint_children[j];
    if (parent < 0 || parent >= count || child < 0 || child >= count) return where + "joins no links";
    if (is_child[static_cast<std::size_t>(child)]) return where + "has the child of another one";
    is_child[static_cast<std::size_t>(child)] = true;
    if (tree.joint_kinds[j] > static_cast<std::uint8_t>(JointKind::planar)) return where + "is of no kind";
    if (tree.joint_mimics[j] < -1 || tree.joint_mimics[j] >= count - 1) return where + "follows none";
    const Vec3 axis = tree.joint_axes[j];
    if (!(std::abs(squared_length(axis) - 1) < 1e-9)) return where + "has an axis that is no unit vector";
    for (const double x : tree.joint_origins[j]) {
      if (!std::isfinite(x)) return where + "is nowhere";
    }
    if (!std::isfinite(tree.joint_limits[j][0]) || !std::isfinite(tree.joint_limits[j][1]) ||
        !std::isfinite(tree.joint_mimic_lines[j][0]) || !std::isfinite(tree.joint_mimic_lines[j][1]))
      return where + "has limits that are no numbers";
  }
  if (from_root(tree).size() != links.size()) return "the joints run in a circle";
  return {};
}

std::string broken_invariant(const Robot& robot) {
  if (std::string why = broken_invariant(static_cast<const RobotTree&>(robot)); !why.empty()) return why;
  if (robot.vertex_ends.size() != robot.joint_kinds.size() + 1) return "not every link has a surface";
  for (std::size_t link = 0; link < robot.links(); ++link) {
    const auto rises = [&](const Array<std::int64_t>& ends, std::size_t total) {
      return ends[link] >= (link == 0 ? 0 : ends[link - 1]) &&
             ends[link] <= static_cast<std::int64_t>(total) &&
             (link + 1 < robot.links() || ends[link] == static_cast<std::int64_t>(total));
    };
    if (!rises(robot.vertex_ends, robot.vertices.size()) ||
        !rises(robot.triangle_ends, robot.triangles.size()))
      return "the surface of link " + std::to_string(link) + " has no end";
    if (std::string why = broken_invariant(mesh_of(robot, link)); !why.empty())
      return "link " + std::to_string(link) + ": " + why;
  }
  return {};
}

}  // namespace ballflow::geometry
