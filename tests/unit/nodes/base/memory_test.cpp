#include "base/memory.hpp"

#include <gtest/gtest.h>

namespace ballflow::geometry {
namespace {

struct Grant final : Monitor {
  explicit Grant(std::uint64_t bytes) : granted(bytes) {}
  std::uint64_t memory_bytes() override { return granted; }
  std::uint64_t granted;
};

TEST(memory_limit, is_what_the_monitor_grants_also_to_a_part_of_the_work) {
  Grant grant(1'500'000'000);
  PartMonitor part(grant, 0, 0.5);
  for (Monitor* const monitor : {static_cast<Monitor*>(&grant), static_cast<Monitor*>(&part)}) {
    const MemoryLimit limit(*monitor);
    EXPECT_TRUE(limit.allows(1.5e9));
    EXPECT_FALSE(limit.allows(1.5e9 + 1));
    EXPECT_EQ(limit.text(), "the run may use 1.5 GB");
  }
  Grant little(12'400'000);
  EXPECT_EQ(MemoryLimit(little).text(), "the run may use 12.4 MB");
}

TEST(memory_limit, is_the_memory_of_the_machine_where_nobody_says) {
  const MemoryLimit limit(no_monitor());
  EXPECT_TRUE(limit.allows(16e6));
  EXPECT_FALSE(limit.allows(1e18));
  EXPECT_EQ(limit.text().rfind("the machine has ", 0), 0u) << limit.text();
}

}  // namespace
}  // namespace ballflow::geometry
