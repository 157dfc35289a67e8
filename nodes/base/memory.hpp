// How much memory a computation may take, so that one that would need more says so before it begins.
#pragma once

#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// "12.4 MB", "1.5 GB".
std::string size_text(double bytes);

/// Bytes that whoever runs the computation grants it, or the memory of the machine where nobody says.
struct MemoryLimit {
  explicit MemoryLimit(Monitor& monitor);

  bool allows(double wanted) const { return wanted <= bytes; }
  /// "the run may use 1.5 GB" or "the machine has 16 GB".
  std::string text() const;

  double bytes;
  bool granted;  // by the monitor
};

}  // namespace ballflow::geometry
