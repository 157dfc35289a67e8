// Man pages of the program and its commands, from what its help says.
#pragma once

#include <map>
#include <string>

#include "commands/command_line.hpp"

namespace ballflow::cli {

/// File names ("ballflow.1", "ballflow-run.1") and their texts, for man(7). Commands of a group (cache gc)
/// are on the page of the group. `notes`: what every page ends with.
std::map<std::string, std::string> man_pages(const CommandFacts& program, const std::string& notes);

}  // namespace ballflow::cli
