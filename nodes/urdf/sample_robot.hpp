// A small robot for examples and tests, without a file.
#pragma once

#include <string>
#include <string_view>

namespace ballflow::geometry {

constexpr std::string_view sample_robot_scheme = "robot:";

constexpr std::string_view sample_spheres_scheme = "spheres:";

/// Some spheres for it, as CSV: "spheres:arm". They contain its fingers and leave out most of the rest.
/// Throws InputError for other names.
std::string sample_spheres(const std::string& name);

/// The URDF of "robot:arm": an arm of four links made of boxes, cylinders and spheres, with a hand of two
/// fingers. Throws InputError for other names.
std::string sample_robot(const std::string& name);

}  // namespace ballflow::geometry
