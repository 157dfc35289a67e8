// Several processes and threads on one store: races, locks, and processes that are killed.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "ballflow/store.hpp"
#include "child_process.hpp"
#include "faulty_file_system.hpp"
#include "gc_fixture.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::action_for;
using test::entry_for;
using test::make_probe;

class ProcessTest : public ::testing::Test {
 protected:
  std::vector<std::string> workspaces() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(root + "/tmp")) names.push_back(entry.path().filename());
    return names;
  }
  std::size_t locks() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(root + "/locks"), fs::directory_iterator()));
  }

  const test::TempFolder folder;
  const std::string root = folder.file("cache");
  const Digest key = sha256("key");
};

/// The id of a process that has ended.
pid_t dead_process() {
  const pid_t child = start([] {});
  finish(child);
  return child;
}

}  // namespace

TEST_F(ProcessTest, racing_stores_publish_one_blob_each) {
  constexpr int count = 60, racers = 4;
  std::atomic<int> failures = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < racers; ++t) {
    threads.emplace_back([&] {
      const auto store = Store::open({root});
      for (int i = 0; i < count; ++i) {
        const ArtifactPtr artifact = make_probe(i);
        if (!store->put_blob(*artifact, false) || !store->put_action(key_of(i), action_for(*artifact)))
          ++failures;
        const auto found = store->find_action(key_of(i));
        if (!found || !test::equal(*found, action_for(*artifact)) ||
            store->load(found->outputs[0]) == nullptr)
          ++failures;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, 0);
  const auto store = Store::open({root});
  EXPECT_EQ(store->statistics().blobs, std::uint64_t{count});
  EXPECT_EQ(store->statistics().actions, std::uint64_t{count});
  EXPECT_EQ(store->statistics().quarantined, 0u);
  EXPECT_TRUE(workspaces().empty());
}

TEST_F(ProcessTest, one_store_serves_many_threads) {
  const auto store = Store::open({root});
  std::atomic<int> failures = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) {
        const ArtifactPtr artifact = make_probe(i % 10 + 100 * (t % 2));
        if (!store->put_blob(*artifact, false)) ++failures;
        const ArtifactPtr loaded = store->load(entry_for(*artifact));
        if (loaded == nullptr || !test::same(*loaded, *artifact)) ++failures;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(store->statistics().blobs, 20u);
}

TEST_F(ProcessTest, readers_of_an_entry_being_replaced_see_one_or_the_other) {
  const auto store = Store::open({root});
  const ActionEntry first = action_for(*make_probe(1)), second = action_for(*make_probe(2, 5000));
  store->put_action(key, first);
  const pid_t writer = start([&] {
    const auto other = Store::open({root});
    for (int i = 0; i < 150; ++i) other->put_action(key, i % 2 == 0 ? second : first);
  });
  for (int i = 0; i < 3000; ++i) {
    const auto found = store->find_action(key);
    ASSERT_TRUE(found) << i;
    ASSERT_TRUE(test::equal(*found, first) || test::equal(*found, second)) << i;
  }
  EXPECT_EQ(finish(writer), 0);
}

TEST_F(ProcessTest, killed_writers_leave_whole_entries_or_none) {
  constexpr int count = 2000;
  std::mt19937 random(7);
  const auto deadline = std::chrono::steady_clock::now() + 2s;
  int kills = 0, begin = 0;
  while (std::chrono::steady_clock::now() < deadline) {
    const pid_t writer = start([&] {
      const auto store = Store::open({root});
      for (int i = begin; i < begin + count; ++i) {
        const auto lock = store->lock(key_of(i), {});
        const ArtifactPtr artifact = make_probe(i, 2000);
        store->put_blob(*artifact, false);
        store->put_action(key_of(i), action_for(*artifact));
      }
      for (;;) ::pause();
    });
    std::this_thread::sleep_for(std::chrono::microseconds(2000 + random() % 30000));
    ASSERT_EQ(::kill(writer, SIGKILL), 0);
    finish(writer);
    ++kills;

    const auto store = Store::open({root});
    EXPECT_TRUE(workspaces().empty()) << "left behind by the dead process";
    int i = begin;
    for (; i < begin + count; ++i) {
      const auto found = store->find_action(key_of(i));
      if (!found) break;
      const ArtifactPtr artifact = make_probe(i, 2000);
      ASSERT_TRUE(test::equal(*found, action_for(*artifact))) << i;
      const ArtifactPtr loaded = store->load(found->outputs[0]);
      ASSERT_NE(loaded, nullptr) << "the entry is published after its blob, " << i;
      ASSERT_TRUE(test::same(*loaded, *artifact)) << i;
    }
    begin = i;  // the next writer starts with the one that was cut off
    ASSERT_NE(store->lock(key_of(begin), {}), nullptr) << "the kernel freed the lock";
  }
  EXPECT_GT(begin, 20) << "something was written between the kills";
  EXPECT_GT(kills, 10);
  EXPECT_EQ(Store::open({root})->statistics().quarantined, 0u);
}

TEST_F(ProcessTest, workspaces_of_the_dead_are_removed_and_of_the_living_kept) {
  const auto store = Store::open({root});
  store->put_blob(*make_probe(1), false);
  ASSERT_EQ(workspaces().size(), 1u);
  const std::string own = workspaces()[0];
  const std::string pid = std::to_string(::getpid());
  const std::size_t at = own.rfind("-" + pid + "-");
  ASSERT_NE(at, std::string::npos) << own;
  const std::string host_boot = own.substr(0, at);
  const std::size_t boot = host_boot.rfind('-');
  const std::string host = host_boot.substr(0, boot), dead = std::to_string(dead_process());

  const auto make = [&](const std::string& name) {
    test::write_file(root + "/tmp/" + name + "/0", "half a blob");
    return name;
  };
  const std::vector<std::string> removed{
      make(host_boot + "-" + dead + "-0123456789abcdef"),
      make(host + "-00000000000000000000000000000000-" + pid + "-0123456789abcdef")};
  const std::vector<std::string> kept{
      own, make(host_boot + "-" + pid + "-0123456789abcdef"),
      make("elsewhere-" + host_boot.substr(boot + 1) + "-" + dead + "-0123456789abcdef"),
      make("what-is-this"), make("notes")};
  const auto other = Store::open({root});
  for (const std::string& name : removed) EXPECT_FALSE(fs::exists(root + "/tmp/" + name)) << name;
  for (const std::string& name : kept) EXPECT_TRUE(fs::exists(root + "/tmp/" + name)) << name;
}

TEST_F(ProcessTest, a_locked_workspace_is_kept_although_its_process_looks_dead) {
  const auto store = Store::open({root});
  store->put_blob(*make_probe(1), false);
  const auto files = std::make_shared<test::FaultyFileSystem>();
  files->fault = [](const std::string& call) {
    return call == "process_alive" ? -1 : 0;
  };  // another container
  const auto other = Store::open({root}, files);
  EXPECT_EQ(files->count("process_alive"), 1);
  EXPECT_EQ(workspaces().size(), 1u);
  EXPECT_TRUE(store->put_blob(*make_probe(2), false));
}

TEST_F(ProcessTest, a_forked_child_uses_a_workspace_of_its_own) {
  const auto store = Store::open({root});
  store->put_blob(*make_probe(1), false);
  const pid_t child = start([&] {
    auto copy = Store::open({root});
    const bool good = store->put_blob(*make_probe(2), false);
    if (!good || workspaces().size() != 2) ::_exit(1);
  });
  EXPECT_EQ(finish(child), 0);
  EXPECT_TRUE(store->put_blob(*make_probe(3), false));
}

TEST_F(ProcessTest, a_lock_excludes_other_stores_and_disappears) {
  const auto store = Store::open({root}), other = Store::open({root});
  {
    const auto lock = store->lock(key, {});
    ASSERT_NE(lock, nullptr);
    EXPECT_EQ(locks(), 1u);
    int polls = 0;
    EXPECT_EQ(other->lock(key, [&] { return ++polls == 3; }), nullptr);
    EXPECT_EQ(polls, 3);
    EXPECT_NE(other->lock(sha256("another key"), {}), nullptr);
  }
  EXPECT_EQ(locks(), 0u);
  EXPECT_NE(other->lock(key, {}), nullptr);
}

TEST_F(ProcessTest, trying_a_lock_tells_a_busy_key_from_a_store_that_cannot_lock) {
  const auto files = std::make_shared<test::FaultyFileSystem>();
  const auto store = Store::open({root}, files), other = Store::open({root});
  LockAttempt held = store->try_lock(key);
  ASSERT_NE(held.lock, nullptr);
  EXPECT_FALSE(held.busy);
  const LockAttempt second = other->try_lock(key);
  EXPECT_EQ(second.lock, nullptr);
  EXPECT_TRUE(second.busy);
  EXPECT_TRUE(store->try_lock(key).busy) << "also for a thread of the same process";
  EXPECT_EQ(locks(), 1u);
  held.lock.reset();
  EXPECT_NE(other->try_lock(key).lock, nullptr);
  EXPECT_EQ(locks(), 0u);

  const LockAttempt unwritable = Store::open({root, true})->try_lock(key);
  EXPECT_EQ(unwritable.lock, nullptr);
  EXPECT_FALSE(unwritable.busy);
  files->fault = [](const std::string& call) { return call == "try_lock" ? -ENOLCK : 0; };
  const LockAttempt impossible = store->try_lock(key);
  EXPECT_EQ(impossible.lock, nullptr);
  EXPECT_FALSE(impossible.busy) << "waiting would never end";
}

TEST_F(ProcessTest, a_lock_outlives_its_store) {
  auto store = Store::open({root});
  auto lock = store->lock(key, {});
  store.reset();
  EXPECT_EQ(Store::open({root})->lock(key, [] { return true; }), nullptr);
  lock.reset();
  EXPECT_NE(Store::open({root})->lock(key, [] { return true; }), nullptr);
}

TEST_F(ProcessTest, processes_and_threads_hold_a_lock_one_at_a_time) {
  // Each turn reads a counter, waits, and writes it back plus one: any overlap loses counts.
  constexpr int processes = 2, threads = 2, turns = 25;
  const std::string counter = folder.file("counter");
  test::write_file(counter, "0");
  const auto work = [&] {
    const auto store = Store::open({root});
    for (int i = 0; i < turns; ++i) {
      const auto lock = store->lock(key, {});
      const int value = std::stoi(test::read_file(counter));
      std::this_thread::sleep_for(100us);
      test::write_file(counter, std::to_string(value + 1));
    }
  };
  std::vector<pid_t> children;
  for (int p = 0; p < processes; ++p) {
    children.push_back(start([&] {
      std::vector<std::thread> group;
      for (int t = 0; t < threads; ++t) group.emplace_back(work);
      for (std::thread& thread : group) thread.join();
    }));
  }
  for (const pid_t child : children) EXPECT_EQ(finish(child), 0);
  EXPECT_EQ(test::read_file(counter), std::to_string(processes * threads * turns));
  EXPECT_EQ(locks(), 0u);
}

TEST_F(ProcessTest, the_lock_of_a_killed_process_is_free) {
  Store::open({root});
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = start([&] {
    const auto store = Store::open({root});
    const auto lock = store->lock(key, {});
    if (::write(ready[1], "x", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  });
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::close(ready[0]);
  ::close(ready[1]);
  const auto store = Store::open({root});
  EXPECT_EQ(store->lock(key, [] { return true; }), nullptr);
  ::kill(holder, SIGKILL);
  finish(holder);
  EXPECT_NE(store->lock(key, [] { return true; }), nullptr);
  EXPECT_EQ(locks(), 0u);
}

TEST_F(ProcessTest, without_locks_the_caller_goes_on_alone) {
  const auto files = std::make_shared<test::FaultyFileSystem>();
  const auto store = Store::open({root}, files);
  files->fault = [](const std::string& call) { return call == "try_lock" ? -ENOLCK : 0; };
  EXPECT_EQ(store->lock(key, {}), nullptr);
  files->fault = [](const std::string& call) { return call == "open" ? -ENOSPC : 0; };
  EXPECT_EQ(store->lock(key, {}), nullptr);
}

}  // namespace ballflow
