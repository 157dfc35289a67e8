// Texts that cross the plugin boundary.
#pragma once

#include <string_view>

#include "ballflow/plugin.h"

namespace ballflow {

inline std::string_view view(bf_bytes text) {
  return {text.data, text.data == nullptr ? 0 : static_cast<std::size_t>(text.size)};
}
inline bf_bytes as_bytes(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace ballflow
