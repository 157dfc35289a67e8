// What this process may use of the machine it runs on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ballflow {

/// Bytes: the memory of the machine, or the limit of the control groups of this process where that is less.
std::uint64_t usable_memory_bytes();

/// Processors: those that the affinity of the calling thread allows, or what the quota of the control groups
/// amounts to, rounded up, where that is less. At least 1.
unsigned usable_processors();

/// The smallest limits on the way from the control groups of this process up to where they are mounted, of
/// version 1 (memory.limit_in_bytes, cpu.cfs_quota_us) and 2 (memory.max and memory.high, cpu.max) together;
/// nothing where none is set. `root` stands before every path that is read.
struct ControlGroupLimits {
  std::optional<std::uint64_t> memory_bytes;
  std::optional<double> processors;
};
ControlGroupLimits control_group_limits(const std::string& root = "");

}  // namespace ballflow
