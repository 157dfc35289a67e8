// What is collected and in which order, what stays, and what happens to collectors that meet or die.
#include "ballflow/gc.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <thread>

#include "ballflow/error.hpp"
#include "child_process.hpp"
#include "faulty_file_system.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::action_for;
using test::entry_for;
using test::FaultyFileSystem;
using test::make_probe;
using test::place_of;

constexpr std::uint64_t block = 4096;
constexpr std::int64_t hour = std::int64_t{3600} * 1'000'000'000;

Digest key_of(int i) { return sha256("key " + std::to_string(i)); }

std::int64_t modified(const std::string& file) {
  struct stat status {};
  EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
  return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

class GcTest : public ::testing::Test {
 protected:
  std::shared_ptr<Store> open() const { return Store::open({root}, files); }

  /// An artifact of `blocks` blocks on the disk, made by an action that took `seconds` and was last used
  /// `hours` ago.
  Digest put(int i, std::uint64_t blocks, double seconds, double hours) {
    const auto store = open();
    const ArtifactPtr artifact = make_probe(i, (blocks * block - 1000) / 9);
    EXPECT_EQ((artifact->file_size() + block - 1) / block, blocks);
    ActionEntry entry = action_for(*artifact);
    entry.seconds = seconds;
    EXPECT_TRUE(store->put_blob(*artifact, false));
    EXPECT_TRUE(store->put_action(key_of(i), entry));
    age(place_of(root, "cas", artifact->digest()), hours);
    age(place_of(root, "ac", key_of(i)), hours);
    return artifact->digest();
  }
  static void age(const std::string& file, double hours) {
    const auto nanoseconds = static_cast<std::int64_t>(hours * static_cast<double>(hour));
    const std::int64_t time = FileSystem().now() - nanoseconds;
    const timespec times[2] = {{0, UTIME_OMIT}, {time / 1'000'000'000, time % 1'000'000'000}};
    ASSERT_EQ(::utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
  }
  bool has(const Digest& digest) const { return fs::exists(place_of(root, "cas", digest)); }
  bool has_action(int i) const { return fs::exists(place_of(root, "ac", key_of(i))); }
  /// The sizes of all files that count, found without the store.
  std::uint64_t on_disk() const {
    std::uint64_t sum = 0;
    for (const char* top : {"cas", "ac", "files", "quarantine"}) {
      for (const auto& file : fs::recursive_directory_iterator(root + "/" + top)) {
        if (file.is_regular_file()) sum += (file.file_size() + block - 1) / block * block;
      }
    }
    return sum;
  }
  std::set<std::string> everything() const {
    std::set<std::string> paths;
    for (const char* top : {"cas", "ac", "files", "quarantine", "pins"}) {
      for (const auto& file : fs::recursive_directory_iterator(root + "/" + top)) paths.insert(file.path());
    }
    return paths;
  }
  std::vector<Digest> order() const {
    std::vector<Digest> digests;
    for (const CachedArtifact& artifact : read_contents(*open()).artifacts)
      digests.push_back(artifact.digest);
    return digests;
  }
  Collected collect_to(std::uint64_t limit, bool dry_run = false) const {
    return collect(*open(), {limit, limit, dry_run, true});
  }

  const test::TempFolder folder;
  const std::string root = folder.file("cache");
  const std::shared_ptr<FaultyFileSystem> files = std::make_shared<FaultyFileSystem>();
};

}  // namespace

TEST_F(GcTest, keeps_everything_below_the_limit) {
  for (int i = 0; i < 5; ++i) put(i, 2, 1, i);
  const auto before = everything();
  const Collected done = collect_to(on_disk());
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.bytes_before, 5 * 3 * block);  // two blocks of artifact and one of entry each
  EXPECT_EQ(done.bytes_before, on_disk());
  EXPECT_EQ(everything(), before);
}

TEST_F(GcTest, respects_any_limit) {
  for (int i = 0; i < 12; ++i) put(i, 1 + static_cast<std::uint64_t>(i) % 4, 0.5 * i, 20 - i);
  for (std::uint64_t limit = on_disk(); limit > 0; limit -= block) {
    const Collected done = collect_to(limit);
    EXPECT_TRUE(done.complete) << limit;
    EXPECT_LE(on_disk(), limit);
    EXPECT_EQ(done.bytes_after, on_disk());
  }
  collect_to(0);
  EXPECT_EQ(on_disk(), 0u);
}

TEST_F(GcTest, goes_by_seconds_over_bytes_times_age) {
  // score = seconds / (blocks * hours), in units that do not matter
  const Digest slow = put(1, 4, 100, 10);          // 2.5
  const Digest quick = put(2, 4, 1, 10);           // 0.025
  const Digest small = put(3, 1, 1, 10);           // 0.1
  const Digest old = put(4, 1, 100, 990);          // 0.101
  const Digest fresh_and_quick = put(5, 4, 1, 2);  // 0.125
  const Digest free = put(6, 1, 0, 1);             // 0
  const std::vector<Digest> expected{free, quick, small, old, fresh_and_quick, slow};
  EXPECT_EQ(order(), expected);

  pin(*open(), put(7, 200, 0, 0));  // so that the entries have less than a tenth of the limit
  for (std::size_t gone = 0; gone < expected.size(); ++gone) {
    EXPECT_TRUE(has(expected[gone]));
    EXPECT_EQ(collect_to(on_disk() - 1).removed, std::vector<Digest>{expected[gone]});
    EXPECT_FALSE(has(expected[gone]));
  }
}

TEST_F(GcTest, outputs_of_one_action_weigh_together) {
  const auto store = open();
  const ArtifactPtr large = make_probe(1, 10000), small = make_probe(2, 100);
  ActionEntry both = action_for(*large);
  both.outputs.push_back(entry_for(*small, "other"));
  both.seconds = 10;
  store->put_blob(*large, false);
  store->put_blob(*small, false);
  store->put_action(key_of(1), both);
  const std::string lone = put(3, 2, 10, 0).hex();
  const CacheContents contents = read_contents(*store, files->now() + hour);
  ASSERT_EQ(contents.artifacts.size(), 3u);
  EXPECT_NEAR(contents.artifacts[0].score / contents.artifacts[1].score, 1, 1e-3);
  EXPECT_EQ(contents.artifacts[2].digest.hex(), lone) << "the same seconds for fewer bytes";
}

TEST_F(GcTest, what_no_action_names_goes_first_and_the_oldest_of_it) {
  const Digest named = put(1, 1, 0.001, 500);
  const auto store = open();
  const ArtifactPtr young = make_probe(2), old = make_probe(3);
  store->put_blob(*young, false);
  store->put_blob(*old, false);
  age(place_of(root, "cas", young->digest()), 2);
  age(place_of(root, "cas", old->digest()), 3);
  EXPECT_EQ(order(), (std::vector<Digest>{old->digest(), young->digest(), named}));
}

TEST_F(GcTest, a_use_of_an_entry_is_a_use_of_its_artifacts) {
  const Digest used = put(1, 2, 1, 100), idle = put(2, 2, 1, 50);
  EXPECT_EQ(order(), (std::vector<Digest>{used, idle}));
  ASSERT_TRUE(open()->find_action(key_of(1)));
  EXPECT_EQ(order(), (std::vector<Digest>{idle, used}));
}

TEST_F(GcTest, a_use_is_written_down_once_an_hour) {
  put(1, 1, 1, 0);
  const std::string entry = place_of(root, "ac", key_of(1));
  const auto store = open();
  files->reset_counts();
  for (int i = 0; i < 10; ++i) store->find_action(key_of(1));
  EXPECT_EQ(files->count("touch"), 0);
  age(entry, 1.5);
  const std::int64_t before = modified(entry);
  store->peek_action(key_of(1));
  EXPECT_EQ(modified(entry), before);
  for (int i = 0; i < 10; ++i) store->find_action(key_of(1));
  EXPECT_EQ(files->count("touch"), 1);
  EXPECT_GT(modified(entry), before + hour);

  const ArtifactPtr probe = make_probe(2);
  const std::string blob = place_of(root, "cas", probe->digest());
  store->put_blob(*probe, false);
  age(blob, 2);
  EXPECT_NE(store->load(entry_for(*probe)), nullptr);
  EXPECT_EQ(files->count("touch"), 2);
  age(blob, 2);
  EXPECT_NE(Store::open({root, true}, files)->load(entry_for(*probe)), nullptr);
  EXPECT_EQ(files->count("touch"), 2) << "a read-only store is not touched";
}

TEST_F(GcTest, entries_stay_as_hits_until_they_have_a_tenth_of_the_limit) {
  constexpr int count = 40;
  for (int i = 0; i < count; ++i) put(i, 1, 1, i);
  const Collected done = collect_to(100 * block);
  EXPECT_EQ(done.actions + done.artifacts, 0u) << "it all fits";
  EXPECT_EQ(collect_to(50 * block).actions, 35u) << "those that were not used for longest";
  for (int i = 0; i < count; ++i) EXPECT_EQ(has_action(i), i < 5) << i;
  EXPECT_LE(on_disk(), 50 * block);

  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(open()->find_action(key_of(i))) << i;
  }
}

TEST_F(GcTest, entries_without_artifacts_are_bounded_too) {
  const auto store = open();
  for (int i = 0; i < 100; ++i) {
    store->put_action(key_of(i), action_for(*make_probe(i)));
    age(place_of(root, "ac", key_of(i)), 200 - i);
  }
  const Collected done = collect_to(50 * block);
  EXPECT_EQ(done.actions, 95u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(has_action(i), i >= 95) << i;
}

TEST_F(GcTest, pins_stay_with_their_entries_until_they_are_let_go) {
  const Digest pinned = put(1, 2, 0, 5000), other = put(2, 2, 9, 1);
  pin(*open(), pinned);
  pin(*open(), pinned);  // twice is once
  EXPECT_EQ(find_pins(*open(), pinned.hex().substr(0, 6)), std::vector<Digest>{pinned});
  const Collected done = collect_to(0);
  EXPECT_FALSE(done.complete);
  EXPECT_EQ(done.pinned_bytes, 2 * block);
  EXPECT_TRUE(has(pinned));
  EXPECT_TRUE(has_action(1)) << "else nobody would find it";
  EXPECT_FALSE(has(other));
  EXPECT_FALSE(has_action(2));
  unpin(*open(), pinned);
  EXPECT_TRUE(collect_to(0).complete);
  EXPECT_FALSE(has(pinned));
}

TEST_F(GcTest, dry_run_removes_nothing_and_tells_what_would_go) {
  for (int i = 0; i < 8; ++i) put(i, 2, i, 8 - i);
  test::write_file(root + "/quarantine/bad", "bad");
  const auto before = everything();
  const std::uint64_t limit = 12 * block;
  const Collected told = collect_to(limit, true);
  EXPECT_EQ(everything(), before);
  EXPECT_GT(told.removed.size(), 0u);
  EXPECT_EQ(told.quarantined, 1u);
  const Collected done = collect_to(limit);
  EXPECT_EQ(done.removed, told.removed);
  EXPECT_EQ(done.bytes_after, told.bytes_after);
  EXPECT_EQ(done.actions, told.actions);
}

TEST_F(GcTest, what_a_live_run_may_use_stays) {
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

TEST_F(GcTest, a_lease_ends_with_its_object) {
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

TEST_F(GcTest, an_old_artifact_that_a_run_finds_again_stays) {
  const Digest found = put(1, 2, 1, 300);
  const auto store = open();
  const auto lease = Lease::take(store);
  ASSERT_TRUE(store->find_action(key_of(1)));
  collect_to(0);
  EXPECT_TRUE(has(found));
}

TEST_F(GcTest, what_is_used_while_a_collector_thinks_stays) {
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

TEST_F(GcTest, without_locks_there_are_no_leases_and_collection_goes_on) {
  put(1, 2, 1, 5);
  files->fault = [](const std::string& call) { return call == "try_lock" ? -ENOLCK : 0; };
  EXPECT_EQ(Lease::take(open()), nullptr);
  EXPECT_TRUE(collect_to(0).complete);
  EXPECT_EQ(on_disk(), 0u);
}

TEST_F(GcTest, a_store_that_cannot_be_written_is_left_alone) {
  put(1, 2, 1, 5);
  const auto before = everything();
  const auto store = Store::open({root, true}, files);
  EXPECT_EQ(Lease::take(store), nullptr);
  keep_within(*store, 0);
  EXPECT_EQ(collect(*store, {0, 0, false, true}).artifacts, 0u);
  EXPECT_EQ(collect(*store, {0, 0, true, true}).artifacts, 1u) << "it may be asked";
  EXPECT_EQ(everything(), before);
  EXPECT_THROW(pin(*store, key_of(1)), Error);
  const auto none = Store::open({});
  keep_within(*none, 0);
  EXPECT_EQ(collect(*none, {0, 0, false, true}).bytes_before, 0u);
  EXPECT_TRUE(read_contents(*none).artifacts.empty());
  EXPECT_EQ(Lease::take(none), nullptr);
}

TEST_F(GcTest, faults_never_harm_what_stays) {
  for (const int error : {-EIO, -EACCES, -ENOSPC}) {
    for (const char* failing : {"open", "status", "list", "remove", "write", "read", "rename", "touch"}) {
      for (int i = 0; i < 4; ++i) put(i, 2, i, 4 - i);
      const auto store = open();
      files->fault = [&](const std::string& call) { return call == failing ? error : 0; };
      EXPECT_NO_THROW(collect(*store, {8 * block, 8 * block, false, true})) << failing;
      keep_within(*store, 8 * block);
      files->fault = {};
      EXPECT_TRUE(verify(*open(), true).bad.empty()) << failing;
      collect_to(8 * block);
      EXPECT_LE(on_disk(), 8 * block) << failing;
    }
  }
}

TEST_F(GcTest, a_run_that_wrote_nothing_reads_one_file_and_lists_nothing) {
  for (int i = 0; i < 50; ++i) put(i, 1, 1, 1);
  keep_within(*open(), std::uint64_t{1} << 30);  // the first one counts
  const auto store = open();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(store->find_action(key_of(i)));
  files->reset_counts();
  keep_within(*store, std::uint64_t{1} << 30);
  EXPECT_EQ(files->count("list"), 0);
  EXPECT_LE(files->total(), 6);
}

TEST_F(GcTest, a_run_collects_when_it_has_written_too_much) {
  const std::uint64_t limit = 30 * block;
  put(0, 1, 1, 1);
  keep_within(*open(), limit);
  for (int i = 1; i < 40; ++i) {
    put(i, 2, 1, 0);
    keep_within(*open(), limit);
    EXPECT_LE(on_disk(), limit) << i;
  }
  EXPECT_GT(on_disk(), limit / 2) << "no more than needed";
}

TEST_F(GcTest, a_smaller_limit_is_reached_by_a_run_that_hits_everything) {
  for (int i = 0; i < 10; ++i) put(i, 2, 1, 1);
  keep_within(*open(), no_limit - 1);
  files->clock_offset = 2 * hour;
  keep_within(*open(), 10 * block);
  EXPECT_LE(on_disk(), 10 * block);
}

TEST_F(GcTest, what_cannot_be_reached_is_not_tried_by_every_run) {
  pin(*open(), put(1, 5, 1, 1));
  keep_within(*open(), block);
  const auto store = open();
  files->reset_counts();
  keep_within(*store, block);
  EXPECT_EQ(files->count("list"), 0) << "nothing was written and it was tried just now";
  files->clock_offset = 2 * hour;
  keep_within(*store, block);
  EXPECT_GT(files->count("list"), 0);
}

TEST_F(GcTest, a_count_that_is_damaged_old_or_absent_is_made_again) {
  for (int i = 0; i < 10; ++i) put(i, 2, 1, 1);
  const std::string usage = root + "/usage";
  for (const std::string text : {"", "nonsense\n", "=12", "+1\n+2\n", "= \n", "=-1 -1\n", "=1 99\n"}) {
    test::write_file(usage, text);
    keep_within(*open(), std::uint64_t{1} << 30);
    const std::string counted = test::read_file(usage);
    EXPECT_EQ(counted.rfind("=" + std::to_string(on_disk()) + " ", 0), 0u) << '"' << text << "\" " << counted;
  }
  fs::remove(usage);
  keep_within(*open(), 10 * block);
  EXPECT_LE(on_disk(), 10 * block);
}

TEST_F(GcTest, writers_add_up) {
  put(1, 3, 1, 1);
  put(2, 2, 1, 1);
  EXPECT_EQ(test::read_file(root + "/usage"),
            "+" + std::to_string(4 * block) + "\n+" + std::to_string(3 * block) + "\n");
}

TEST_F(GcTest, two_collectors_at_once_leave_what_the_limit_allows) {
  constexpr int count = 120;
  for (int i = 0; i < count; ++i) put(i, 1 + static_cast<std::uint64_t>(i) % 3, i % 7, i % 11);
  const std::uint64_t limit = 60 * block;
  std::vector<pid_t> children;
  for (int c = 0; c < 3; ++c) {
    children.push_back(start([&] {
      const auto store = Store::open({root});
      if (!collect(*store, {limit, limit, false, true}).complete) ::_exit(1);
    }));
  }
  for (const pid_t child : children) EXPECT_EQ(finish(child), 0);
  EXPECT_LE(on_disk(), limit);
  EXPECT_GT(on_disk(), limit - 4 * block) << "the second did not collect once more";
  EXPECT_TRUE(verify(*open(), true).bad.empty());
}

TEST_F(GcTest, a_collector_does_not_wait_at_the_end_of_a_run) {
  put(1, 1, 1, 1);
  const auto store = open();
  const int held = ::open((root + "/locks/gc").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(FileSystem().try_lock(held), 0);
  EXPECT_TRUE(collect(*store, {0, 0, false, false}).busy);
  ::close(held);
  EXPECT_FALSE(collect(*store, {0, 0, false, false}).busy);
}

TEST_F(GcTest, runs_beside_collectors_get_right_artifacts) {
  constexpr int count = 30;
  std::vector<pid_t> collectors;
  const auto deadline = std::chrono::steady_clock::now() + 1500ms;
  for (int c = 0; c < 2; ++c) {
    collectors.push_back(start([&] {
      const auto store = Store::open({root});
      while (std::chrono::steady_clock::now() < deadline)
        collect(*store, {20 * block, 10 * block, false, true});
    }));
  }
  int rounds = 0;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto store = Store::open({root});
    const auto lease = Lease::take(store);
    ASSERT_NE(lease, nullptr);
    for (int i = 0; i < count; ++i) {
      const ArtifactPtr artifact = make_probe(i, 300);
      ASSERT_TRUE(store->put_blob(*artifact, false));
      ASSERT_TRUE(store->put_action(key_of(i), action_for(*artifact)));
    }
    for (int i = 0; i < count; ++i) {
      const auto found = store->find_action(key_of(i));
      ASSERT_TRUE(found) << "a live run keeps what it has made, round " << rounds;
      const ArtifactPtr loaded = store->load(found->outputs[0]);
      ASSERT_NE(loaded, nullptr) << "round " << rounds;
      ASSERT_TRUE(test::same(*loaded, *make_probe(i, 300)));
    }
    ++rounds;
  }
  for (const pid_t child : collectors) EXPECT_EQ(finish(child), 0);
  EXPECT_GT(rounds, 2);
}

TEST_F(GcTest, a_killed_collector_leaves_a_right_cache) {
  constexpr int count = 20;
  const std::uint64_t limit = 25 * block;
  bool finished = false;
  int kills = 0;
  for (int last = 1; !finished; last += 8, ++kills) {  // killed before one call after the other that writes
    for (int i = 0; i < count; ++i) put(i, 2, i % 5, 1 + i % 13);
    test::write_file(root + "/quarantine/bad", "bad");
    const std::uint64_t before = on_disk();
    const pid_t collector = start([&] {
      const auto faulty = std::make_shared<FaultyFileSystem>();
      const auto store = Store::open({root}, faulty);
      int calls = 0;
      faulty->fault = [&](const std::string& call) {
        if ((call == "remove" || call == "write" || call == "open") && ++calls == last) ::raise(SIGKILL);
        return 0;
      };
      collect(*store, {limit, limit, false, true});
    });
    finished = finish(collector) == 0;
    EXPECT_LE(on_disk(), before);
    const Verified found = verify(*open(), true);
    EXPECT_TRUE(found.bad.empty()) << last;
    keep_within(*open(), limit);
    EXPECT_LE(on_disk(), limit) << "the next run goes on, after call " << last;
    EXPECT_TRUE(collect(*open(), {limit, limit, false, false}).complete) << "no lock is left behind";
  }
  EXPECT_GT(kills, 8);
}

TEST_F(GcTest, lock_files_of_the_dead_go_and_of_the_living_stay) {
  const auto store = open();
  test::write_file(root + "/locks/" + key_of(1).hex(), "");
  const auto lock = store->lock(key_of(2), {});
  ASSERT_NE(lock, nullptr);
  collect_to(no_limit);
  EXPECT_FALSE(fs::exists(root + "/locks/" + key_of(1).hex()));
  EXPECT_TRUE(fs::exists(root + "/locks/" + key_of(2).hex()));
}

TEST_F(GcTest, default_limit_is_a_tenth_of_the_disk_and_not_more_than_20_gib) {
  const auto store = open();
  files->disk = std::uint64_t{50} << 30;
  EXPECT_EQ(default_limit(*store), std::uint64_t{5} << 30);
  files->disk = std::uint64_t{5} << 40;
  EXPECT_EQ(default_limit(*store), std::uint64_t{20} << 30);
  files->fault = [](const std::string& call) { return call == "capacity" ? -ENOSYS : 0; };
  EXPECT_EQ(default_limit(*store), std::uint64_t{20} << 30);
}

TEST(cache_size, reads_what_people_write) {
  EXPECT_EQ(parse_size("5G"), std::uint64_t{5} << 30);
  EXPECT_EQ(parse_size("1.5t"), std::uint64_t{3} << 39);
  EXPECT_EQ(parse_size("800MB"), std::uint64_t{800} << 20);
  EXPECT_EQ(parse_size("64KiB"), 65536u);
  EXPECT_EQ(parse_size("4096"), 4096u);
  EXPECT_EQ(parse_size("0"), 0u);
  EXPECT_EQ(parse_size("none"), no_limit);
  for (const char* bad :
       {"", "G", "-1", "5X", "5GBB", "5 G", "inf", "nan", "1e300", "99999999999T", "5G ", "-0"}) {
    EXPECT_FALSE(parse_size(bad)) << bad;
  }
}

TEST_F(GcTest, verify_finds_nothing_in_a_good_cache) {
  for (int i = 0; i < 6; ++i) put(i, 2, 1, 1);
  open()->put_action(key_of(99), action_for(*make_probe(99)));  // without its artifact, which is no fault
  const auto before = everything();
  for (const bool full : {false, true}) {
    const Verified found = verify(*open(), full);
    EXPECT_TRUE(found.bad.empty());
    EXPECT_EQ(found.artifacts, 6u);
    EXPECT_EQ(found.actions, 7u);
    EXPECT_EQ(found.without_artifacts, 1u);
  }
  EXPECT_EQ(everything(), before);
}

TEST_F(GcTest, verify_moves_what_is_damaged_to_quarantine_and_a_run_heals_it) {
  const auto damage = [](const std::string& file, auto change) {
    std::string bytes = test::read_file(file);
    change(bytes);
    fs::remove(file);
    test::write_file(file, bytes);
    fs::permissions(file, fs::perms(0444));
  };
  const auto flip_last = [](std::string& bytes) { bytes.back() = static_cast<char>(bytes.back() ^ 1); };
  const auto cut = [](std::string& bytes) { bytes.resize(bytes.size() / 2); };
  std::vector<Digest> digests;
  for (int i = 0; i < 6; ++i) digests.push_back(put(i, 2, 1, 1));
  damage(place_of(root, "cas", digests[0]), flip_last);
  damage(place_of(root, "cas", digests[1]), cut);
  damage(place_of(root, "ac", key_of(2)), flip_last);
  damage(place_of(root, "ac", key_of(3)), [](std::string& bytes) { bytes.clear(); });
  fs::remove(place_of(root, "cas", digests[4]));
  fs::create_symlink("/etc/hostname", place_of(root, "cas", digests[4]));

  const Verified asked = verify(*Store::open({root, true}), false);
  EXPECT_EQ(asked.bad.size(), 5u);
  for (const Finding& bad : asked.bad) EXPECT_FALSE(bad.moved) << bad.file;

  const Verified found = verify(*open(), false);
  std::set<std::string> named;
  for (const Finding& bad : found.bad) {
    EXPECT_TRUE(bad.moved) << bad.file;
    EXPECT_FALSE(bad.what.empty());
    named.insert(root + '/' + bad.file);
  }
  EXPECT_EQ(named,
            (std::set<std::string>{place_of(root, "cas", digests[0]), place_of(root, "cas", digests[1]),
                                   place_of(root, "cas", digests[4]), place_of(root, "ac", key_of(2)),
                                   place_of(root, "ac", key_of(3))}));
  EXPECT_EQ(open()->statistics().quarantined, 5u);
  EXPECT_TRUE(verify(*open(), true).bad.empty());

  for (int i = 0; i < 6; ++i) put(i, 2, 1, 1);  // as a run does on a miss
  for (const Digest& digest : digests) EXPECT_TRUE(has(digest));
  EXPECT_TRUE(verify(*open(), true).bad.empty());
}

TEST_F(GcTest, only_full_verification_finds_content_that_fits_its_entry_but_not_its_name) {
  // The entry and the blob agree with each other; the name of the blob is another's.
  const auto store = open();
  const ArtifactPtr right = make_probe(1), wrong = make_probe(2);
  ActionEntry entry = action_for(*wrong);
  entry.outputs[0].digest = right->digest();
  store->put_action(key_of(1), entry);
  test::write_file(place_of(root, "cas", right->digest()), test::file_bytes(*wrong));
  fs::permissions(place_of(root, "cas", right->digest()), fs::perms(0444));
  EXPECT_TRUE(verify(*store, false).bad.empty());
  EXPECT_EQ(verify(*store, true).bad.size(), 1u);
  EXPECT_FALSE(has(right->digest()));
}

TEST_F(GcTest, an_entry_that_describes_a_good_artifact_wrongly_is_the_bad_one) {
  const auto store = open();
  const ArtifactPtr probe = make_probe(1);
  ActionEntry entry = action_for(*probe);
  entry.outputs[0].checksum.low ^= 1;
  store->put_blob(*probe, false);
  store->put_action(key_of(1), entry);
  const Verified found = verify(*store, false);
  ASSERT_EQ(found.bad.size(), 1u);
  EXPECT_EQ(found.bad[0].file.rfind("ac/", 0), 0u);
  EXPECT_TRUE(has(probe->digest()));
  EXPECT_FALSE(has_action(1));
}

TEST_F(GcTest, memoised_digests_are_verified_and_bounded) {
  const auto store = open();
  for (int i = 0; i < 8; ++i) {
    const std::string input = folder.file("input" + std::to_string(i));
    test::write_file(input, "content " + std::to_string(i));
    files->clock_offset = 10'000'000'000;  // old enough to be believed
    store->file_digest(input);
  }
  files->clock_offset = 0;
  EXPECT_EQ(verify(*store, false).memos, 8u);
  const auto memo = *std::next(fs::recursive_directory_iterator(root + "/files"));
  std::string bytes = test::read_file(memo.path());
  bytes[20] = static_cast<char>(bytes[20] ^ 1);
  fs::remove(memo.path());
  test::write_file(memo.path(), bytes);
  EXPECT_EQ(verify(*store, false).bad.size(), 1u);
  const Collected done = collect_to(5 * block);
  EXPECT_EQ(done.quarantined, 1u);
  EXPECT_EQ(done.memos, 7u) << "a tenth of the limit is less than one";
}

}  // namespace ballflow
