#include "show/chain.hpp"

#include <cmath>
#include <string_view>
#include <utility>

namespace ballflow::show {
namespace {

using geometry::JointKind;

constexpr double half_turn = 3.14159265358979323846;

Chain::Motion motion_of(JointKind kind) {
  if (kind == JointKind::revolute || kind == JointKind::continuous) return Chain::Motion::turn;
  return kind == JointKind::prismatic ? Chain::Motion::slide : Chain::Motion::none;
}

std::string_view to_string(Chain::Motion motion) {
  switch (motion) {
    case Chain::Motion::turn:
      return "turn";
    case Chain::Motion::slide:
      return "slide";
    case Chain::Motion::none:
      break;
  }
  return "none";
}

/// For each joint of the robot its number among those of the chain, or -1.
std::vector<std::int32_t> add_joints(const geometry::RobotTree& tree, Chain& chain) {
  const std::vector<std::string> names = names_of(tree.joint_names);
  const std::vector<double> values = default_values(tree);
  std::vector<std::int32_t> numbers(names.size(), -1);
  for (std::size_t j = 0; j < names.size(); ++j) {
    const auto kind = static_cast<JointKind>(tree.joint_kinds[j]);
    const Chain::Motion motion = motion_of(kind);
    auto [lower, upper] = tree.joint_limits[j];
    if (kind == JointKind::continuous) lower = -half_turn, upper = half_turn;
    if (motion == Chain::Motion::none || tree.joint_mimics[j] >= 0 || !(lower < upper)) continue;
    numbers[j] = static_cast<std::int32_t>(chain.joints.size());
    chain.joints.push_back({names[j], motion == Chain::Motion::turn ? "rad" : "m", lower, upper, values[j]});
  }
  return numbers;
}

}  // namespace

Chain chain_of(const geometry::RobotTree& tree) {
  Chain chain;
  chain.name = std::string(view(tree.name));
  const std::vector<std::string> links = names_of(tree.link_names);
  const std::vector<double> values = default_values(tree);
  const std::vector<std::int32_t> numbers = add_joints(tree, chain);
  std::vector<std::size_t> joint_of(links.size(), links.size());
  for (std::size_t j = 0; j < values.size(); ++j)
    joint_of[static_cast<std::size_t>(tree.joint_children[j])] = j;
  std::vector<std::int32_t> place(links.size(), -1);
  for (const std::size_t link : from_root(tree)) {
    place[link] = static_cast<std::int32_t>(chain.frames.size());
    Chain::Frame frame;
    frame.name = links[link];
    if (const std::size_t joint = joint_of[link]; joint < values.size()) {
      frame.parent = place[static_cast<std::size_t>(tree.joint_parents[joint])];
      frame.origin = tree.joint_origins[joint];
      frame.motion = motion_of(static_cast<JointKind>(tree.joint_kinds[joint]));
      frame.axis = tree.joint_axes[joint];
      const geometry::JointSource source = source_of(tree, joint);
      frame.joint = numbers[source.joint];
      frame.factor = source.factor;
      frame.offset = source.offset;
      if (frame.joint < 0) frame.offset += source.factor * values[source.joint];  // it does not move
    }
    chain.frames.push_back(std::move(frame));
  }
  return chain;
}

std::vector<geometry::Pose> frame_poses(const Chain& chain, const std::vector<double>& values) {
  std::vector<geometry::Pose> poses;
  poses.reserve(chain.frames.size());
  for (const Chain::Frame& frame : chain.frames) {
    const double value =
        frame.offset + (frame.joint < 0 ? 0 : frame.factor * values[static_cast<std::size_t>(frame.joint)]);
    geometry::Pose motion = geometry::no_motion;
    if (frame.motion == Chain::Motion::turn) motion = geometry::rotation(frame.axis, value / (2 * half_turn));
    if (frame.motion == Chain::Motion::slide) {
      const geometry::Vec3 way = value * frame.axis;
      motion[9] = way.x, motion[10] = way.y, motion[11] = way.z;
    }
    const geometry::Pose own = geometry::composed(frame.origin, motion);
    poses.push_back(
        frame.parent < 0 ? own : geometry::composed(poses[static_cast<std::size_t>(frame.parent)], own));
  }
  return poses;
}

std::vector<double> frame_growths(const Chain& chain, const std::vector<double>& values) {
  std::vector<double> growths;
  growths.reserve(chain.frames.size());
  for (const Chain::Frame& frame : chain.frames) {
    const double own = frame.joint < 0 ? 0 : frame.growth * values[static_cast<std::size_t>(frame.joint)];
    growths.push_back(own + (frame.parent < 0 ? 0 : growths[static_cast<std::size_t>(frame.parent)]));
  }
  return growths;
}

Json chain_json(const Chain& chain) {
  Json json = {{"name", chain.name}, {"frames", Json::array()}, {"joints", Json::array()}};
  for (const Chain::Frame& frame : chain.frames) {
    json["frames"].push_back({{"name", frame.name},
                              {"parent", frame.parent},
                              {"origin", frame.origin},
                              {"motion", to_string(frame.motion)},
                              {"axis", {frame.axis.x, frame.axis.y, frame.axis.z}},
                              {"joint", frame.joint},
                              {"factor", frame.factor},
                              {"offset", frame.offset}});
    if (frame.growth != 0) json["frames"].back()["growth"] = frame.growth;
  }
  for (const Chain::Joint& joint : chain.joints) {
    json["joints"].push_back({{"name", joint.name},
                              {"unit", joint.unit},
                              {"lower", joint.lower},
                              {"upper", joint.upper},
                              {"value", joint.value}});
  }
  return json;
}

std::string broken_invariant(const Chain& chain) {
  for (std::size_t i = 0; i < chain.frames.size(); ++i) {
    const Chain::Frame& frame = chain.frames[i];
    if (frame.parent < -1 || frame.parent >= static_cast<std::int32_t>(i))
      return "the frame " + frame.name + " hangs on one that is not before it";
    if (frame.joint < -1 || frame.joint >= static_cast<std::int32_t>(chain.joints.size()))
      return "the frame " + frame.name + " takes the value of no joint";
    if (!(std::abs(squared_length(frame.axis) - 1) < 1e-9))
      return "the axis of the frame " + frame.name + " is no unit vector";
  }
  for (const Chain::Joint& joint : chain.joints) {
    if (!(joint.lower < joint.upper)) return "the joint " + joint.name + " has no room to move";
  }
  return "";
}

}  // namespace ballflow::show
