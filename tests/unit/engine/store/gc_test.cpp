// What is collected and in which order, what stays, and what happens to collectors that meet or die.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "ballflow/error.hpp"
#include "gc_fixture.hpp"

namespace ballflow {

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

TEST_F(GcTest, whole_digests_are_looked_up_without_listing_a_folder) {
  std::vector<Digest> all;
  for (int i = 0; i < 40; ++i) all.push_back(put(i, 1, 1, 1));
  const auto store = open();
  pin(*store, all[3]);
  files->reset_counts();
  EXPECT_EQ(find_artifacts(*store, all[7].hex()), std::vector<Digest>{all[7]});
  EXPECT_TRUE(find_artifacts(*store, key_of(1).hex()).empty());
  EXPECT_EQ(find_pins(*store, all[3].hex()), std::vector<Digest>{all[3]});
  EXPECT_TRUE(find_pins(*store, all[7].hex()).empty());
  EXPECT_EQ(files->count("list"), 0);

  EXPECT_EQ(find_artifacts(*store, all[7].hex().substr(0, 6)), std::vector<Digest>{all[7]});
  EXPECT_EQ(files->count("list"), 1) << "one subfolder";
  std::sort(all.begin(), all.end());
  EXPECT_EQ(find_artifacts(*store, ""), all);
  for (const int digits : {1, 2, 3}) {
    std::vector<Digest> expected;
    const std::string prefix = all[0].hex().substr(0, static_cast<std::size_t>(digits));
    for (const Digest& digest : all) {
      if (digest.hex().starts_with(prefix)) expected.push_back(digest);
    }
    EXPECT_EQ(find_artifacts(*store, prefix), expected) << digits;
  }
  for (const std::string& odd :
       {all[0].hex() + "0", std::string("../../../x"), std::string("zz"), std::string(64, 'g')}) {
    EXPECT_TRUE(find_artifacts(*store, odd).empty()) << odd;
    EXPECT_TRUE(find_pins(*store, odd).empty()) << odd;
  }
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

}  // namespace ballflow
