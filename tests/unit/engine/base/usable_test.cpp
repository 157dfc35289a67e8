// Limits of control groups, from trees as Linux shows them, and the affinity of the thread.
#include "base/usable.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include "base/process_usage.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

struct ControlGroupTest : testing::Test {
  void put(const std::string& path, const std::string& text) { test::write_file(folder.path() + path, text); }
  void member(const std::string& lines) { put("/proc/self/cgroup", lines); }
  void mounted(const std::string& lines) { put("/proc/self/mountinfo", lines); }
  ControlGroupLimits limits() const { return control_group_limits(folder.path()); }

  static constexpr const char* version_2 =
      "22 1 0:20 / /proc rw - proc proc rw\n"
      "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
  static constexpr const char* version_1 =
      "33 31 0:30 / /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"
      "35 31 0:32 / /sys/fs/cgroup/memory rw shared:12 - cgroup cgroup rw,memory\n";
  const test::TempFolder folder;
};

TEST_F(ControlGroupTest, nothing_limits_where_there_are_no_groups) {
  EXPECT_FALSE(limits().memory_bytes);
  EXPECT_FALSE(limits().processors);
}

TEST_F(ControlGroupTest, version_2_takes_the_smallest_on_the_way_up) {
  member("0::/user.slice/job\n");
  mounted(version_2);
  put("/sys/fs/cgroup/user.slice/memory.max", "3000000\n");
  put("/sys/fs/cgroup/user.slice/job/memory.max", "max\n");
  put("/sys/fs/cgroup/user.slice/cpu.max", "max 100000\n");
  put("/sys/fs/cgroup/user.slice/job/cpu.max", "150000 100000\n");
  put("/sys/fs/cgroup/other/memory.max", "5\n");
  EXPECT_EQ(limits().memory_bytes, 3000000u);
  EXPECT_EQ(limits().processors, 1.5);
  put("/sys/fs/cgroup/user.slice/job/memory.max", "2000000\n");
  EXPECT_EQ(limits().memory_bytes, 2000000u) << "the inner one is less";
  put("/sys/fs/cgroup/user.slice/memory.max", "1000000\n");
  EXPECT_EQ(limits().memory_bytes, 1000000u) << "the outer one is less";
  put("/sys/fs/cgroup/user.slice/job/memory.high", "900000\n");
  EXPECT_EQ(limits().memory_bytes, 900000u) << "what is throttled is as good as forbidden";
}

TEST_F(ControlGroupTest, version_1_has_a_tree_for_each_controller) {
  member("5:memory:/docker/a/b\n4:cpu,cpuacct:/docker/a\n1:name=systemd:/docker\n");
  mounted(version_1);
  put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  put("/sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "4096000\n");
  put("/sys/fs/cgroup/memory/docker/a/b/memory.limit_in_bytes", "9223372036854771712\n");
  put("/sys/fs/cgroup/cpu,cpuacct/docker/cpu.cfs_quota_us", "-1\n");
  put("/sys/fs/cgroup/cpu,cpuacct/docker/cpu.cfs_period_us", "100000\n");
  put("/sys/fs/cgroup/cpu,cpuacct/docker/a/cpu.cfs_quota_us", "25000\n");
  put("/sys/fs/cgroup/cpu,cpuacct/docker/a/cpu.cfs_period_us", "50000\n");
  EXPECT_EQ(limits().memory_bytes, 4096000u);
  EXPECT_EQ(limits().processors, 0.5);
}

TEST_F(ControlGroupTest, no_limit_of_version_1_is_none) {
  member("5:memory:/\n");
  mounted(version_1);
  put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_FALSE(limits().memory_bytes);
}

TEST_F(ControlGroupTest, both_versions_count_at_once) {
  member("5:memory:/a\n0::/a\n");
  mounted(std::string(version_1) + "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  put("/sys/fs/cgroup/memory/a/memory.limit_in_bytes", "700\n");
  put("/sys/fs/cgroup/unified/a/cpu.max", "300000 100000\n");
  EXPECT_EQ(limits().memory_bytes, 700u);
  EXPECT_EQ(limits().processors, 3.0);
}

TEST_F(ControlGroupTest, a_container_sees_its_part_of_the_tree) {
  // The mount shows the group of the container as its root.
  member("5:memory:/docker/c1/inner\n");
  mounted("35 31 0:32 /docker/c1 /sys/fs/cgroup/memory\\040of\\040c1 rw - cgroup cgroup rw,memory\n");
  put("/sys/fs/cgroup/memory of c1/memory.limit_in_bytes", "800\n");
  put("/sys/fs/cgroup/memory of c1/inner/memory.limit_in_bytes", "900\n");
  EXPECT_EQ(limits().memory_bytes, 800u);
  // The group is named from outside, and nothing of that is seen but the mount itself.
  member("5:memory:/elsewhere/c1\n");
  EXPECT_EQ(limits().memory_bytes, 800u);
  member("0::/../other\n");
  mounted(version_2);
  put("/sys/fs/cgroup/memory.max", "600\n");
  put("/sys/other/memory.max", "5\n");
  EXPECT_EQ(limits().memory_bytes, 600u);
}

TEST_F(ControlGroupTest, nonsense_limits_nothing) {
  member("nonsense\n::\n0::\n5:memory:x\n0::/a\n");
  mounted(std::string("- -\n35\n36 35 0:1 / /x rw - cgroup2\n") + version_2 + version_1);
  put("/sys/fs/cgroup/a/memory.max", "-7\n");
  put("/sys/fs/cgroup/a/memory.high", "lots\n");
  put("/sys/fs/cgroup/a/cpu.max", "100000\n");
  put("/sys/fs/cgroup/cpu.max", "100000 0\n");
  EXPECT_FALSE(limits().memory_bytes);
  EXPECT_FALSE(limits().processors);
}

TEST(usable, memory_is_at_most_that_of_the_machine) {
  EXPECT_GT(usable_memory_bytes(), 0u);
  EXPECT_LE(usable_memory_bytes(), physical_memory_bytes());
}

TEST(usable, processors_follow_the_affinity_of_the_thread) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(usable_processors(), 1u);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  EXPECT_LE(usable_processors(), static_cast<unsigned>(CPU_COUNT(&before)));
}

}  // namespace
}  // namespace ballflow
