// Which runs count as live, and what stays because of them.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "gc_fixture.hpp"

namespace ballflow {
namespace {

class LeaseTest : public GcTest {};

/// Locks as NFS makes them of flocks: by byte ranges, which need a file that is open for writing.
class NfsFileSystem final : public FaultyFileSystem {
 public:
  int try_lock(int file) override {
    if ((::fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY) return -EBADF;
    return FaultyFileSystem::try_lock(file);
  }
};

/// A store on a mount whose locks stay on their host, as one of its hosts sees it: locks of the others look
/// free.
class HostFileSystem final : public FaultyFileSystem {
 public:
  HostFileSystem(std::string name, bool sees_locks) : name_(std::move(name)), sees_locks_(sees_locks) {}
  Mount mount(int) override { return {"nfs4", "/scratch", options}; }
  std::string machine() override { return name_ + "-" + boot; }
  int try_lock(int file) override { return sees_locks_ ? FaultyFileSystem::try_lock(file) : 0; }

  std::string options = "rw,vers=4.2,local_lock=flock";
  std::string boot = "0123456789abcdef0123456789abcdef";

 private:
  std::string name_;
  bool sees_locks_;
};

}  // namespace

TEST_F(LeaseTest, a_fork_that_ends_leaves_leases_and_locks_to_its_parent) {
  auto store = open();
  auto lease = Lease::take(store);
  auto lock = store->lock(key_of(1), {});
  ASSERT_NE(lease, nullptr);
  ASSERT_NE(lock, nullptr);
  const pid_t child = start([&] {
    lease.reset();
    lock.reset();
    store.reset();
  });
  EXPECT_EQ(finish(child), 0);
  EXPECT_EQ(collect_to(0).live_runs, 1u);
  EXPECT_TRUE(open()->try_lock(key_of(1)).busy);
  lease.reset();
  lock.reset();
  EXPECT_EQ(collect_to(0).live_runs, 0u);
  EXPECT_NE(open()->try_lock(key_of(1)).lock, nullptr);
}

TEST_F(LeaseTest, what_a_live_run_may_use_stays) {
  const Digest stale = put(1, 2, 1, 30), recent = put(2, 2, 1, 0.5);
  const pid_t run = start([&] {
    const auto store = open();
    const auto lease = Lease::take(store);
    if (lease == nullptr) ::_exit(1);
    test::write_file(folder.file("started"), "");
    for (;;) ::pause();
  });
  while (!fs::exists(folder.file("started"))) std::this_thread::sleep_for(1ms);
  const Digest made = put(3, 2, 0, 0);
  const Collected done = collect_to(0);
  EXPECT_FALSE(done.complete);
  EXPECT_EQ(done.live_runs, 1u);
  EXPECT_FALSE(has(stale));
  EXPECT_TRUE(has(recent)) << "the run may have found it without touching it";
  EXPECT_TRUE(has(made)) << "however cheap it is";

  ::kill(run, SIGKILL);
  finish(run);
  EXPECT_TRUE(collect_to(0).complete) << "the kernel freed the lease";
  EXPECT_FALSE(has(recent));
  EXPECT_TRUE(fs::is_empty(root + "/leases"));
}

TEST_F(LeaseTest, a_lease_ends_with_its_object) {
  const Digest recent = put(1, 2, 1, 0.5);
  const auto store = open();
  auto lease = Lease::take(store);
  ASSERT_NE(lease, nullptr);
  EXPECT_EQ(collect_to(0).live_runs, 1u);
  EXPECT_TRUE(has(recent));
  lease.reset();
  collect_to(0);
  EXPECT_FALSE(has(recent));
}

TEST_F(LeaseTest, an_old_artifact_that_a_run_finds_again_stays) {
  const Digest found = put(1, 2, 1, 300);
  const auto store = open();
  const auto lease = Lease::take(store);
  ASSERT_TRUE(store->find_action(key_of(1)));
  collect_to(0);
  EXPECT_TRUE(has(found));
}

TEST_F(LeaseTest, what_is_used_while_a_collector_thinks_stays) {
  const Digest first = put(1, 1, 0, 30), second = put(2, 1, 1, 20);
  const auto user = Store::open({root});  // of another process
  bool used = false;
  // As the collector takes the lock of leases it has decided already.
  files->fault = [&](const std::string& call) {
    if (call == "remove" && !used) {
      used = true;
      user->find_action(key_of(2));
    }
    return 0;
  };
  collect(*open(), {3 * block, 0, false, true});
  ASSERT_TRUE(used);
  EXPECT_FALSE(has(first));
  EXPECT_TRUE(has(second));
}

TEST_F(LeaseTest, without_locks_there_are_no_leases_and_collection_goes_on) {
  put(1, 2, 1, 5);
  files->fault = [](const std::string& call) { return call == "try_lock" ? -ENOLCK : 0; };
  EXPECT_EQ(Lease::take(open()), nullptr);
  EXPECT_TRUE(collect_to(0).complete);
  EXPECT_EQ(on_disk(), 0u);
}

TEST_F(LeaseTest, lock_files_of_the_dead_go_and_of_the_living_stay) {
  const auto store = open();
  test::write_file(root + "/locks/" + key_of(1).hex(), "");
  const auto lock = store->lock(key_of(2), {});
  ASSERT_NE(lock, nullptr);
  collect_to(no_limit);
  EXPECT_FALSE(fs::exists(root + "/locks/" + key_of(1).hex()));
  EXPECT_TRUE(fs::exists(root + "/locks/" + key_of(2).hex()));
}

TEST_F(LeaseTest, leases_and_locks_are_asked_for_as_nfs_can_lock) {
  const Digest stale = put(1, 2, 1, 30), recent = put(2, 2, 1, 0.5);
  const auto nfs = std::make_shared<NfsFileSystem>();
  const auto store = Store::open({root}, nfs), other = Store::open({root}, nfs);
  auto lease = Lease::take(store);
  ASSERT_NE(lease, nullptr);
  EXPECT_EQ(collect(*other, {0, 0, false, true}).live_runs, 1u);
  EXPECT_FALSE(has(stale));
  EXPECT_TRUE(has(recent));
  lease.reset();
  test::write_file(root + "/leases/4711-0123456789abcdef", "");  // of a run that was killed
  test::write_file(root + "/locks/" + key_of(1).hex(), "");
  const Collected done = collect(*other, {0, 0, false, true});
  EXPECT_EQ(done.live_runs, 0u) << "a lease that cannot be locked would count as live for ever";
  EXPECT_TRUE(done.complete);
  EXPECT_FALSE(has(recent));
  EXPECT_TRUE(fs::is_empty(root + "/leases"));
  EXPECT_FALSE(fs::exists(root + "/locks/" + key_of(1).hex()));
}

TEST_F(LeaseTest, where_locks_stay_on_their_host_a_lease_of_another_one_counts_however_old_it_is) {
  const Digest stale = put(1, 2, 1, 3000), used = put(2, 2, 1, 500);
  const auto node7 = std::make_shared<HostFileSystem>("node-7", false);
  const auto node8 = std::make_shared<HostFileSystem>("node-8", true);
  const auto running = Store::open({root}, node7), collecting = Store::open({root}, node8);
  const auto lease = Lease::take(running);
  ASSERT_NE(lease, nullptr);
  const std::string file = fs::directory_iterator(root + "/leases")->path();
  age(file, 1000);
  const Collected done = collect(*collecting, {0, 0, false, true});
  EXPECT_FALSE(done.complete);
  EXPECT_FALSE(has(stale)) << "not used since";
  EXPECT_TRUE(has(used));
  EXPECT_TRUE(fs::exists(file));
  EXPECT_EQ(done.live_runs, 1u);
  ASSERT_EQ(done.unseen.size(), 1u);
  EXPECT_EQ(root + "/" + done.unseen[0].file, file);
  EXPECT_EQ(done.unseen[0].host, "node-7");
  EXPECT_EQ(done.unseen[0].since, modified(file));
  EXPECT_EQ(done.locks_stay_here, "/scratch is mounted as nfs4 with local_lock=flock");

  const Collected asked = collect(*collecting, {no_limit, no_limit, true, true});
  EXPECT_EQ(asked.unseen.size(), 1u) << "also when nothing has to go";

  fs::remove(file);  // as the user does when that run is dead
  EXPECT_TRUE(collect(*collecting, {0, 0, false, true}).complete);
  EXPECT_FALSE(has(used));
}

TEST_F(LeaseTest, where_locks_stay_on_their_host_dead_runs_of_the_own_host_are_seen) {
  const Digest used = put(1, 2, 1, 5);
  const auto host = std::make_shared<HostFileSystem>("node-8", true);
  const auto store = Store::open({root}, host);
  auto lease = Lease::take(store);
  ASSERT_NE(lease, nullptr);
  const auto name = [&](const std::string& boot) {
    return root + "/leases/node-8-" + boot + "-17-0123456789abcdef";
  };
  test::write_file(name(host->boot), "");
  test::write_file(name("fedcba9876543210fedcba9876543210"), "");  // before the machine was started anew
  Collected done = collect(*store, {0, 0, false, true});
  EXPECT_EQ(done.live_runs, 1u);
  EXPECT_TRUE(done.unseen.empty());
  EXPECT_FALSE(has(used)) << "not used since the lease";
  EXPECT_FALSE(fs::exists(name(host->boot)));
  EXPECT_FALSE(fs::exists(name("fedcba9876543210fedcba9876543210")));
  lease.reset();
  EXPECT_EQ(collect(*store, {0, 0, false, true}).live_runs, 0u);

  test::write_file(root + "/leases/4711-0123456789abcdef", "");
  done = collect(*store, {0, 0, false, true});
  ASSERT_EQ(done.unseen.size(), 1u) << "nobody knows whose it is";
  EXPECT_EQ(done.unseen[0].host, "");
}

TEST_F(LeaseTest, where_locks_stay_on_their_host_recent_files_and_lock_files_stay) {
  const Digest recent = put(1, 2, 1, 0.5), old = put(2, 2, 1, 2);
  const auto host = std::make_shared<HostFileSystem>("node-8", true);
  const auto store = Store::open({root}, host);
  const std::string lock = root + "/locks/" + key_of(3).hex();  // perhaps of another host
  test::write_file(lock, "");
  collect(*store, {0, 0, false, true});
  EXPECT_TRUE(has(recent)) << "a run of another host may have begun just now";
  EXPECT_FALSE(has(old));
  EXPECT_TRUE(fs::exists(lock));

  host->options = "rw,vers=4.2,local_lock=none";
  const Collected done = collect(*store, {0, 0, false, true});
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.locks_stay_here, "");
  EXPECT_FALSE(fs::exists(lock));
}

TEST_F(LeaseTest, a_lease_waits_for_who_only_looks_and_is_taken_anew_when_it_was_removed) {
  const auto store = open();
  int tries = 0;
  files->fault = [&](const std::string& call) {
    return call == "try_lock" && ++tries == 2 ? -EWOULDBLOCK : 0;
  };
  EXPECT_NE(Lease::take(store), nullptr) << "the first is the lock of all leases";
  EXPECT_EQ(tries, 3);

  bool removed = false;
  files->fault = [&](const std::string& call) {
    if (call == "status" && !removed) {
      removed = true;
      for (const auto& lease : fs::directory_iterator(root + "/leases")) fs::remove(lease);
    }
    return 0;
  };
  const auto lease = Lease::take(store);
  files->fault = {};
  ASSERT_NE(lease, nullptr);
  EXPECT_TRUE(removed);
  EXPECT_EQ(collect_to(0).live_runs, 1u);
}

}  // namespace ballflow
