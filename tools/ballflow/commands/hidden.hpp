// What shells and builds call: "__complete WORD..." and "__share FOLDER", which writes man pages and scripts
// of completion as they lie in the "share" of an installation. They begin with two underscores and
// are in no help.
#pragma once

#include <string>
#include <vector>

#include "commands/commands.hpp"

namespace ballflow::cli {

bool is_hidden(const std::string& command);

/// `words`: the command and what follows it. Throws Error (code usage) for one that is not there.
int run_hidden(const Program& program, const Common& common, const std::vector<std::string>& words);

}  // namespace ballflow::cli
