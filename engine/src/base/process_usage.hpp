// What this process has used so far, and what the machine has.
#pragma once

#include <cstdint>

namespace ballflow {

double process_cpu_seconds();
std::uint64_t peak_rss_bytes();
std::uint64_t physical_memory_bytes();
/// Gives freed memory back to the system that malloc keeps for later: after a node it may be more than all
/// results together.
void return_free_memory();

}  // namespace ballflow
