// Text of others on a terminal: never raw, so that no input can break a line or drive a terminal.
#pragma once

#include <string>
#include <string_view>

namespace ballflow {

/// The text with control characters and invalid UTF-8 replaced by "?".
std::string printable(std::string_view text);

/// One word of a shell command. Control characters and invalid UTF-8 are written as $'...' (bash, zsh, ksh),
/// so that the result is printable and yet stands for exactly this text.
std::string shell_word(std::string_view text);

}  // namespace ballflow
