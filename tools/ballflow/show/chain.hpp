// What moves against what in a scene: frames that hang on each other by joints. Pages have a slider for each
// joint, animated pictures (show/motion.hpp) move one; other pictures and exports show the pose that layers
// are given in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballflow/json.hpp"
#include "types/robot.hpp"

namespace ballflow::show {

/// Lengths are model units, angles radians.
struct Chain {
  enum class Motion : std::uint8_t { none, turn, slide };

  struct Frame {
    std::string name;
    std::int32_t parent = -1;                     // a frame before this one, or -1: the model
    geometry::Pose origin = geometry::no_motion;  // in the frame of the parent, where the value is 0
    Motion motion = Motion::none;                 // about or along the axis, by the value
    geometry::Vec3 axis{1, 0, 0};                 // of length 1
    std::int32_t joint = -1;                      // whose value it takes, or -1: the offset alone
    double factor = 1, offset = 0;                // value = factor * that of the joint + offset
    double growth =
        0;  // radii of what hangs here or on frames behind it: times exp(growth * the joint's value)
  };

  struct Joint {
    std::string name, unit;
    double lower = 0, upper = 0;  // lower < upper
    double value = 0;             // in the pose that layers are given in
  };

  std::string name;
  std::vector<Frame> frames;
  std::vector<Joint> joints;
};

/// A frame for each link, in the order of `from_root`; joints are those that turn or slide between limits, or
/// all around, and follow no other. Values are the `default_values`.
Chain chain_of(const geometry::RobotTree& tree);

/// Frames in the model, for a value of each joint.
std::vector<geometry::Pose> frame_poses(const Chain& chain, const std::vector<double>& values);

/// By how much radii have grown at each frame: logarithms of factors.
std::vector<double> frame_growths(const Chain& chain, const std::vector<double>& values);

/// {"name", "frames": [{"name", "parent", "origin", "motion": "turn" | "slide" | "none", "axis", "joint",
/// "factor", "offset", and "growth" where there is one}], "joints": [{"name", "unit", "lower", "upper",
/// "value"}]}
Json chain_json(const Chain& chain);

/// Empty when the rules above hold, else what is wrong.
std::string broken_invariant(const Chain& chain);

}  // namespace ballflow::show
