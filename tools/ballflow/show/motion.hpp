// Layers with a joint at another value: the pictures of an animation.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "show/scene.hpp"

namespace ballflow::show {

/// The joint of this name that some layer hangs on. Throws Error (code usage) that names those there are.
Chain::Joint joint_named(const std::vector<Layer>& layers, const std::string& name);

/// The layers with that joint at a value, all other joints as they were given. Layers that do not hang on
/// it stay.
std::vector<Layer> with_joint(const std::vector<Layer>& layers, std::string_view joint, double value);

}  // namespace ballflow::show
