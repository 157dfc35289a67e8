// What this process has used so far, and what the machine has.
#pragma once

#include <cstdint>

namespace ballflow {

double process_cpu_seconds();
std::uint64_t peak_rss_bytes();
std::uint64_t physical_memory_bytes();

}  // namespace ballflow
