#include "base/mounts.hpp"

#include <gtest/gtest.h>

#include "base/open_file.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

constexpr std::string_view mountinfo =
    "24 30 0:22 / /proc rw,nosuid,nodev,noexec,relatime shared:13 - proc proc rw\n"
    "30 1 259:2 / / rw,relatime shared:1 - ext4 /dev/nvme0n1p2 rw,errors=remount-ro\n"
    "95 30 0:51 /home /my\\040home\\134x rw,relatime shared:50 master:2 - nfs4 server:/export/home "
    "rw,vers=4.2,hard,local_lock=none,addr=10.0.0.1\n"
    "96 30 0:52 / /scratch rw,noatime - nfs server:/scratch rw,vers=3,nolock,local_lock=all\n"
    "9 30 0:53 broken line\n"
    "97 30 0:54 / /short rw - nfs\n";

}  // namespace

TEST(mounts, a_mount_is_found_by_its_number) {
  const auto home = find_mount(mountinfo, 95);
  ASSERT_TRUE(home);
  EXPECT_EQ(home->type, "nfs4");
  EXPECT_EQ(home->point, "/my home\\x");
  EXPECT_EQ(home->options, "rw,relatime,rw,vers=4.2,hard,local_lock=none,addr=10.0.0.1");
  const auto scratch = find_mount(mountinfo, 96);
  ASSERT_TRUE(scratch) << "without optional fields";
  EXPECT_EQ(scratch->type, "nfs");
  for (const long id : {9, 97, 4711, 0}) EXPECT_FALSE(find_mount(mountinfo, id)) << id;
  EXPECT_FALSE(find_mount("", 1));
}

TEST(mounts, options_say_how_far_locks_reach) {
  const auto local = [](const char* type, const char* options) {
    return host_local_locks({type, "/scratch", options});
  };
  EXPECT_EQ(local("nfs", "rw,nolock,local_lock=all"), "nolock");
  EXPECT_EQ(local("nfs", "rw,vers=3,local_lock=flock"), "local_lock=flock");
  EXPECT_EQ(local("nfs4", "rw,local_lock=all,vers=4.2"), "local_lock=all");
  EXPECT_EQ(local("lustre", "rw,localflock"), "localflock");
  EXPECT_EQ(local("fuse.sshfs", "rw"), "fuse.sshfs");
  EXPECT_EQ(local("nfs4", "rw,local_lock=none"), "");
  EXPECT_EQ(local("nfs", "rw,local_lock=posix"), "") << "flock is another lock";
  EXPECT_EQ(local("ext4", "rw,nolock"), "") << "an option of another file system";
  EXPECT_EQ(local("lustre", "rw,flock"), "");
  EXPECT_EQ(local("", ""), "");
}

TEST(mounts, this_machine_has_a_name_and_knows_the_mount_of_a_folder) {
  const test::TempFolder folder;
  FileSystem files;
  const OpenFile open(files, files.open(FileSystem::working_folder, folder.path(), folder_flags));
  ASSERT_TRUE(open.is_open());
  const Mount mount = files.mount(open.get());
  EXPECT_FALSE(mount.type.empty());
  EXPECT_EQ(folder.path().rfind(mount.point == "/" ? "" : mount.point, 0), 0u) << mount.point;
  EXPECT_TRUE(files.mount(-1).type.empty());
  const std::string machine = files.machine();
  EXPECT_GT(machine.rfind('-'), 0u);
  EXPECT_NE(machine.rfind('-'), std::string::npos);
  EXPECT_EQ(machine.find('/'), std::string::npos);
  EXPECT_EQ(machine, FileSystem().machine());
}

}  // namespace ballflow
