// Texts put together.
#pragma once

#include <string>

namespace ballflow {

/// Both with `between` in the middle; one alone when the other is empty.
inline std::string join(const std::string& a, const std::string& b, const char* between) {
  return a.empty() || b.empty() ? a + b : a + between + b;
}

}  // namespace ballflow
