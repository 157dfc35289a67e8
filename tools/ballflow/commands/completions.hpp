// What may stand for the last word of a command line.
#pragma once

#include <string>
#include <vector>

#include "commands/commands.hpp"

namespace ballflow::cli {

/// `words`: what follows the name of the program, up to the cursor; the last one is completed and may be
/// empty. A line for every candidate: the whole word, a tab, and what it means. The shell adds a blank to a
/// candidate that does not end with "=". Last comes ":files", ":folders", or ":" where paths are no
/// candidates; behind "name=" they are for what follows. Commands, options, their choices, shipped graphs,
/// parameters, nodes and outputs of the graph of the command line, node types. Never throws: what cannot be
/// read has no candidates.
std::string completions(const CommandFacts& program, const Common& common,
                        const std::vector<std::string>& words);

/// What "bash", "zsh" or "fish" reads to ask for them.
std::string completion_script(const std::string& shell);

}  // namespace ballflow::cli
