#include "base/memory.hpp"

#include <unistd.h>

#include <cstdio>

namespace ballflow::geometry {

MemoryLimit::MemoryLimit(Monitor& monitor)
    : bytes(static_cast<double>(monitor.memory_bytes())), granted(monitor.memory_bytes() != 0) {
  if (granted) return;
  bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::string size_text(double bytes) {
  char size[32];
  std::snprintf(size, sizeof size, "%.3g %s", bytes / (bytes < 1e9 ? 1e6 : 1e9), bytes < 1e9 ? "MB" : "GB");
  return size;
}

std::string MemoryLimit::text() const {
  return (granted ? "the run may use " : "the machine has ") + size_text(bytes);
}

}  // namespace ballflow::geometry
