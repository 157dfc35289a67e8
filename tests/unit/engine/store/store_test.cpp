#include "ballflow/store.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "store_fixture.hpp"

namespace ballflow {

TEST_F(StoreTest, publishes_what_another_store_finds) {
  const auto writer = open();
  EXPECT_EQ(writer->why(), "");
  EXPECT_FALSE(writer->read_only());
  EXPECT_FALSE(writer->find_action(key));
  EXPECT_FALSE(writer->has_blob(action.outputs[0]));
  EXPECT_EQ(writer->load(action.outputs[0]), nullptr);
  EXPECT_TRUE(writer->put_blob(*probe, false));
  EXPECT_TRUE(writer->put_action(key, action));

  const auto reader = Store::open({root, true});
  const auto found = reader->find_action(key);
  ASSERT_TRUE(found);
  EXPECT_TRUE(test::equal(*found, action));
  EXPECT_TRUE(reader->has_blob(found->outputs[0]));
  const ArtifactPtr loaded = reader->load(found->outputs[0]);
  ASSERT_NE(loaded, nullptr);
  EXPECT_TRUE(test::same(*loaded, *probe));
  EXPECT_EQ(loaded->digest(), probe->digest());
  EXPECT_EQ(writer->trouble(), "");
}

TEST_F(StoreTest, files_lie_where_the_layout_says) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  EXPECT_EQ(names_in(root), (std::vector<std::string>{"CACHEDIR.TAG", "ac", "cas", "files", "leases", "locks",
                                                      "pins", "quarantine", "runs", "tmp"}));
  const std::string blob = test::read_file(place_of(root, "cas", probe->digest()));
  EXPECT_EQ(blob, test::file_bytes(*probe));
  EXPECT_EQ(sha256(blob), probe->digest());  // what sha256sum would say about the name of the file
  EXPECT_EQ(files_below(root + "/tmp"), 0u);
  struct stat status {};
  ASSERT_EQ(::stat(place_of(root, "cas", probe->digest()).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0222, 0u) << "nobody edits a blob by accident";
}

TEST_F(StoreTest, action_entry_follows_its_grammar_to_the_byte) {
  open()->put_action(key, action);
  const std::string bytes = test::read_file(place_of(root, "ac", key));
  const auto number = [](std::uint64_t value, int size) {
    std::string text;
    for (int i = 0; i < size; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  };
  const auto text = [&](const std::string& t) { return number(t.size(), 4) + t; };
  const auto raw = [](const Digest& d) { return std::string(d.bytes.begin(), d.bytes.end()); };
  const OutputEntry& output = action.outputs[0];
  const std::string expected =
      "bfaction" + number(1, 4) + raw(key) + number(0x3ff8000000000000, 8) + number(0x4002000000000000, 8) +
      text(action.manifest) + number(1, 4) + text("out") + text("Probe") + number(1, 4) + raw(output.digest) +
      number(output.bytes, 8) + number(output.checksum.low, 8) + number(output.checksum.high, 8) +
      text("{\"seed\":1}") + number(2, 4) + text("first \xc3\xa9") + text("");
  const Checksum checksum = checksum_of(expected.data(), expected.size());
  EXPECT_EQ(bytes, expected + number(checksum.low, 8) + number(checksum.high, 8));
}

TEST_F(StoreTest, entry_outlives_its_blobs) {
  const auto store = open();
  EXPECT_TRUE(store->put_action(key, action));
  const auto found = store->find_action(key);
  ASSERT_TRUE(found);
  EXPECT_FALSE(store->has_blob(found->outputs[0]));
  EXPECT_EQ(store->load(found->outputs[0]), nullptr);
}

TEST_F(StoreTest, loaded_artifact_outlives_its_file_and_store) {
  auto store = open();
  store->put_blob(*probe, false);
  const ArtifactPtr loaded = store->load(entry_for(*probe));
  store.reset();
  fs::remove_all(root);
  EXPECT_TRUE(test::same(*loaded, *probe));
}

TEST_F(StoreTest, same_result_again_writes_nothing) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  const int writes = files->count("write");
  ActionEntry slower = action;
  slower.seconds = 99;
  EXPECT_TRUE(store->put_blob(*probe, false));
  EXPECT_TRUE(store->put_action(key, slower));
  EXPECT_EQ(files->count("write"), writes);
  EXPECT_EQ(store->find_action(key)->seconds, 1.5);
}

TEST_F(StoreTest, another_result_for_the_same_key_replaces_the_entry) {
  const auto store = open();
  store->put_action(key, action);
  const ActionEntry other = action_for(*make_probe(2));
  const ActionPut put = store->put_action(key, other);
  EXPECT_TRUE(put.stored);
  ASSERT_TRUE(put.disagreed) << "the caller can tell which port differs";
  EXPECT_TRUE(test::equal(*put.disagreed, action));
  EXPECT_TRUE(test::equal(*store->find_action(key), other));
  EXPECT_EQ(names_in(fs::path(place_of(root, "ac", key)).parent_path()).size(), 1u);
}

TEST_F(StoreTest, an_entry_that_agrees_about_the_outputs_is_no_disagreement) {
  const auto store = open();
  EXPECT_FALSE(store->put_action(key, action).disagreed) << "there was none";
  EXPECT_FALSE(store->put_action(key, action).disagreed);
  ActionEntry warned = action;
  warned.warnings = {"another warning"};
  const ActionPut put = store->put_action(key, warned);
  EXPECT_TRUE(put.stored);
  EXPECT_FALSE(put.disagreed);
  EXPECT_TRUE(test::equal(*store->find_action(key), warned));
  files->fault = [](const std::string& call) { return call == "write" ? -ENOSPC : 0; };
  const ActionPut failed = store->put_action(key, action_for(*make_probe(2)));
  EXPECT_FALSE(failed.stored);
  EXPECT_FALSE(failed.disagreed) << "nothing was replaced";
}

TEST_F(StoreTest, an_entry_that_appears_while_another_is_written_does_not_go_unseen) {
  const ActionEntry quicker = action_for(*make_probe(2));
  for (const bool agrees : {true, false}) {
    const Digest raced = sha256(agrees ? "agrees" : "differs");
    const auto rival = Store::open({root});
    bool entered = false;
    files->fault = [&](const std::string& call) {
      if (call == "write" && !entered) {
        entered = true;
        rival->put_action(raced, agrees ? action : quicker);
      }
      return 0;
    };
    const ActionPut put = open()->put_action(raced, action);
    files->fault = {};
    ASSERT_TRUE(entered);
    EXPECT_TRUE(put.stored);
    ASSERT_EQ(put.disagreed.has_value(), !agrees);
    if (!agrees) {
      EXPECT_TRUE(test::equal(*put.disagreed, quicker));
    }
    EXPECT_TRUE(test::equal(*open()->find_action(raced), action));
  }
}

TEST_F(StoreTest, flushes_to_disk_only_when_asked) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  EXPECT_EQ(files->count("sync"), 0);
  store->put_blob(*make_probe(2), true);
  EXPECT_EQ(files->count("sync"), 1);
  store->put_action(sha256("other"), action, true);
  EXPECT_EQ(files->count("sync"), 2);
}

TEST_F(StoreTest, opening_and_finding_cost_a_handful_of_calls) {
  {
    const auto store = open();
    for (int i = 0; i < 50; ++i) {
      store->put_blob(*make_probe(i), false);
      store->put_action(sha256(std::to_string(i)), action);
    }
  }
  files->reset_counts();
  const auto store = open();
  EXPECT_LE(files->total(), 30) << "independent of what is stored";
  EXPECT_EQ(files->count("list"), 1) << "tmp/ and nothing else";
  files->reset_counts();
  EXPECT_TRUE(store->find_action(sha256("7")));
  EXPECT_LE(files->total(), 8);
  files->reset_counts();
  EXPECT_TRUE(store->has_blob(entry_for(*make_probe(7))));
  EXPECT_LE(files->total(), 4);
}

TEST_F(StoreTest, statistics_count_what_is_there) {
  const auto store = open();
  std::uint64_t bytes = 0;
  for (int i = 0; i < 20; ++i) {
    const ArtifactPtr artifact = make_probe(i);
    bytes += artifact->file_size();
    store->put_blob(*artifact, false);
  }
  store->put_action(key, action);
  store->put_run("run", {});
  const Store::Statistics total = store->statistics();
  EXPECT_EQ(total.blobs, 20u);
  EXPECT_EQ(total.blob_bytes, bytes);
  EXPECT_EQ(total.actions, 1u);
  EXPECT_EQ(total.action_bytes, fs::file_size(place_of(root, "ac", key)));
  EXPECT_EQ(total.runs, 1u);
  EXPECT_EQ(total.quarantined, 0u);
}

TEST_F(StoreTest, a_run_is_recorded_once_and_as_a_whole) {
  const auto store = open();
  EXPECT_TRUE(store->put_run("2010-01-02_3", {{"a", "1"}, {"b", "2"}}));
  EXPECT_FALSE(store->put_run("2010-01-02_3", {{"a", "3"}}));
  EXPECT_EQ(test::read_file(root + "/runs/2010-01-02_3/a"), "1");
  EXPECT_EQ(test::read_file(root + "/runs/2010-01-02_3/b"), "2");
  for (const std::string bad : {"", ".", "..", "../x", "a/b", ".hidden", "a b"}) {
    EXPECT_THROW(store->put_run(bad, {}), Error) << bad;
  }
}

TEST_F(StoreTest, without_a_folder_everything_is_a_miss) {
  const auto store = Store::open({});
  EXPECT_NE(store->why(), "");
  EXPECT_FALSE(store->put_blob(*probe, false));
  EXPECT_FALSE(store->put_action(key, action));
  EXPECT_FALSE(store->find_action(key));
  EXPECT_FALSE(store->has_blob(action.outputs[0]));
  EXPECT_EQ(store->load(action.outputs[0]), nullptr);
  EXPECT_EQ(store->lock(key, {}), nullptr);
  EXPECT_FALSE(store->put_run("run", {}));
  EXPECT_EQ(store->statistics().blobs, 0u);
  test::write_file(folder.file("input"), "abc");
  EXPECT_EQ(store->file_digest(folder.file("input")), sha256("abc"));
}

TEST_F(StoreTest, a_missing_folder_is_not_created_for_reading) {
  const auto store = Store::open({root, true});
  EXPECT_NE(store->why().find("No such file"), std::string::npos) << store->why();
  EXPECT_FALSE(fs::exists(root));
  EXPECT_FALSE(store->find_action(key));
}

TEST_F(StoreTest, a_file_in_the_place_of_the_folder_is_not_a_store) {
  test::write_file(root, "x");
  const auto store = open();
  EXPECT_TRUE(store->read_only());
  EXPECT_NE(store->why().find("Not a directory"), std::string::npos) << store->why();
  EXPECT_FALSE(store->put_blob(*probe, false));
}

TEST_F(StoreTest, reading_only_changes_nothing) {
  open()->put_blob(*probe, false);
  open()->put_action(key, action);
  fs::permissions(place_of(root, "cas", probe->digest()), fs::perms::owner_write, fs::perm_options::add);
  test::write_file(place_of(root, "cas", probe->digest()), "damaged");
  const auto store = Store::open({root, true}, files);
  files->reset_counts();
  EXPECT_TRUE(store->read_only());
  EXPECT_TRUE(store->find_action(key));
  EXPECT_EQ(store->load(action.outputs[0]), nullptr);
  EXPECT_FALSE(store->put_blob(*make_probe(2), false));
  EXPECT_FALSE(store->put_action(sha256("other"), action));
  EXPECT_EQ(store->lock(key, {}), nullptr);
  for (const char* call : {"write", "rename", "rename_replace", "make_folder", "remove", "link"}) {
    EXPECT_EQ(files->count(call), 0) << call;
  }
}

TEST_F(StoreTest, a_read_only_file_system_gives_hits) {
  open()->put_blob(*probe, false);
  files->fault = [](const std::string& call) { return call == "writable" ? -EROFS : 0; };
  const auto store = open();
  EXPECT_TRUE(store->read_only());
  EXPECT_NE(store->why().find("Read-only file system"), std::string::npos) << store->why();
  EXPECT_NE(store->load(entry_for(*probe)), nullptr);
  EXPECT_FALSE(store->put_blob(*make_probe(2), false));
}

TEST_F(StoreTest, a_large_blob_that_is_given_up_leaves_nothing) {
  const auto store = open();
  const ArtifactPtr large = make_probe(1, 3'000'000);  // 27 MB
  int looks = 0;
  EXPECT_FALSE(store->put_blob(*large, true, [&looks] { return ++looks == 3; }));
  EXPECT_EQ(looks, 3);
  EXPECT_EQ(store->load(entry_for(*large)), nullptr);
  EXPECT_EQ(files_below(root + "/tmp"), 0u);
  EXPECT_EQ(files_below(root + "/cas"), 0u);
  EXPECT_EQ(store->trouble(), "");
  EXPECT_TRUE(store->put_blob(*large, true, [] { return false; }));
  EXPECT_NE(store->load(entry_for(*large)), nullptr);
}

TEST_F(StoreTest, a_full_disk_means_not_cached) {
  const auto store = open();
  files->fault = [](const std::string& call) { return call == "write" ? -ENOSPC : 0; };
  EXPECT_FALSE(store->put_blob(*probe, true));
  EXPECT_FALSE(store->put_action(key, action));
  EXPECT_NE(store->trouble().find("cannot write cas/"), std::string::npos) << store->trouble();
  EXPECT_NE(store->trouble().find("No space left"), std::string::npos) << store->trouble();
  EXPECT_EQ(files_below(root + "/tmp"), 0u);
  EXPECT_EQ(files_below(root + "/cas"), 0u);
  files->fault = nullptr;
  EXPECT_TRUE(store->put_blob(*probe, true));
  EXPECT_NE(store->load(entry_for(*probe)), nullptr);
}

TEST_F(StoreTest, any_failing_call_is_a_miss_and_leaves_nothing_behind) {
  // The n-th call of a whole session fails, for every n and for several errors. That makes and removes
  // hundreds of stores: in memory where there is such a file system, because some disks take their time for
  // every folder.
  const std::string here = ::access("/dev/shm", W_OK) == 0
                               ? "/dev/shm/ballflow-test-" + std::to_string(::getpid())
                               : folder.file("session");
  for (const int error : {-ENOSPC, -EIO, -EROFS, -EACCES, -ENOENT, -EEXIST, -EINVAL, -EPERM}) {
    bool reached = true;
    int misses = 0;
    for (int n = 1; reached; ++n) {
      int calls = 0;
      const auto faulty = std::make_shared<FaultyFileSystem>();
      faulty->fault = [&](const std::string&) { return ++calls == n ? error : 0; };
      bool stored = false, entered = false;
      try {
        const auto store = Store::open({here}, faulty);
        const auto lock = store->lock(key, {});
        stored = store->put_blob(*probe, true);
        entered = store->put_action(key, action).stored;
        if (const ArtifactPtr loaded = store->load(action.outputs[0])) {
          EXPECT_TRUE(test::same(*loaded, *probe));
        }
        if (const auto found = store->find_action(key)) {
          EXPECT_TRUE(test::equal(*found, action));
        }
      } catch (const Error&) {  // a folder that cannot be examined is refused
      }
      reached = calls >= n;

      const auto after = Store::open({here});
      const auto found = after->find_action(key);
      const ArtifactPtr loaded = after->load(action.outputs[0]);
      // close() and remove() may fail after the fact, and -EEXIST claims that another has published.
      if (error != -EEXIST) {
        EXPECT_TRUE(!stored || loaded != nullptr) << error << ' ' << n;
        EXPECT_TRUE(!entered || found) << error << ' ' << n;
      }
      if (loaded != nullptr) {
        EXPECT_TRUE(test::same(*loaded, *probe));
      }
      if (found) {
        EXPECT_TRUE(test::equal(*found, action));
      }
      misses += loaded == nullptr ? 1 : 0;
      EXPECT_TRUE(after->put_blob(*probe, false));
      EXPECT_TRUE(after->put_action(key, action));
      EXPECT_NE(after->load(action.outputs[0]), nullptr) << error << ' ' << n;
      EXPECT_TRUE(after->find_action(key)) << error << ' ' << n;
      fs::remove_all(here);
    }
    EXPECT_GT(misses, 5) << "the faults have an effect";
  }
}

TEST_F(StoreTest, short_writes_are_continued) {
  const auto store = open();
  files->write_at_most = 7;
  EXPECT_TRUE(store->put_blob(*probe, false));
  EXPECT_TRUE(store->put_action(key, action));
  files->write_at_most = SIZE_MAX;
  EXPECT_NE(store->load(action.outputs[0]), nullptr);
  EXPECT_TRUE(store->find_action(key));
}

TEST_F(StoreTest, publishes_where_exclusive_renames_are_unknown) {
  for (const int error : {-EINVAL, -ENOSYS, -EOPNOTSUPP}) {
    for (const bool links : {true, false}) {
      const auto faulty = std::make_shared<FaultyFileSystem>();
      faulty->fault = [&](const std::string& call) {
        return call == "rename" ? error : call == "link" && !links ? -EPERM : 0;
      };
      const std::string here = folder.file("odd");
      const auto store = Store::open({here}, faulty);
      EXPECT_TRUE(store->put_blob(*probe, false));
      EXPECT_NE(store->load(entry_for(*probe)), nullptr);
      EXPECT_EQ(faulty->count("link"), 1);
      EXPECT_EQ(faulty->count("rename_replace"), links ? 0 : 1);
      EXPECT_EQ(files_below(here + "/tmp"), 0u);
      struct stat status {};
      ASSERT_EQ(::stat(place_of(here, "cas", probe->digest()).c_str(), &status), 0);
      EXPECT_EQ(status.st_nlink, 1u);
      fs::remove_all(here);
    }
  }
}

TEST_F(StoreTest, works_on_when_its_temporary_folder_vanishes) {
  const auto store = open();
  store->put_blob(*probe, false);
  for (const std::string& name : names_in(root + "/tmp")) fs::remove_all(root + "/tmp/" + name);
  EXPECT_TRUE(store->put_blob(*make_probe(2), false));
  EXPECT_NE(store->load(entry_for(*make_probe(2))), nullptr);
}

TEST_F(StoreTest, fails_softly_when_the_whole_store_vanishes) {
  const auto store = open();
  store->put_blob(*probe, false);
  fs::remove_all(root);
  EXPECT_FALSE(store->put_blob(*make_probe(2), false));
  EXPECT_FALSE(store->put_action(key, action));
  EXPECT_EQ(store->load(entry_for(*probe)), nullptr);
  EXPECT_FALSE(store->put_run("run", {}));
}

TEST(store_root, follows_the_environment) {
  const auto with = [](const char* cache, const char* xdg, const char* home) {
    const auto set = [](const char* name, const char* value) {
      value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
    };
    const char* const names[] = {"BALLFLOW_CACHE", "XDG_CACHE_HOME", "HOME"};
    std::vector<std::optional<std::string>> before;
    for (const char* name : names) {
      const char* const value = std::getenv(name);
      before.push_back(value != nullptr ? std::optional<std::string>(value) : std::nullopt);
    }
    set(names[0], cache);
    set(names[1], xdg);
    set(names[2], home);
    const std::string root = Store::default_root();
    for (std::size_t i = 0; i < 3; ++i) set(names[i], before[i] ? before[i]->c_str() : nullptr);
    return root;
  };
  EXPECT_EQ(with("/c", "/x", "/h"), "/c");
  EXPECT_EQ(with("", "/x", "/h"), "/x/ballflow");
  EXPECT_EQ(with(nullptr, "relative", "/h"), "/h/.cache/ballflow");
  EXPECT_EQ(with(nullptr, nullptr, "/h"), "/h/.cache/ballflow");
}

}  // namespace ballflow
