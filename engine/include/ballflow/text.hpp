// Text of others on a terminal: never raw, so that no input can break a line or drive a terminal.
#pragma once

#include <string>
#include <string_view>

namespace ballflow {

/// The text with control characters and invalid UTF-8 replaced by "?".
std::string printable(std::string_view text);

}  // namespace ballflow
