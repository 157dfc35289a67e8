// The template of pages, which the build makes of tools/viewer where npm is.
#pragma once

#include <string>

#include "commands/commands.hpp"

namespace ballflow::cli {

/// Throws Error (code store) that says how to get it when it was not built.
std::string viewer_template(const Common& common);

}  // namespace ballflow::cli
