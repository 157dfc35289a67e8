// A store behind the store: two machines that share nothing but a folder, and what can go wrong on it.
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "child_process.hpp"
#include "store_fixture.hpp"

namespace ballflow {
namespace {

constexpr auto cas = Upstream::Room::blobs;
constexpr auto ac = Upstream::Room::actions;

class UpstreamTest : public StoreTest {
 protected:
  UpstreamTest() { fs::create_directory(shared); }

  /// The store of one machine.
  std::shared_ptr<Store> machine(const std::string& name, UpstreamUse use = {}) {
    use.upstream = Upstream::open(shared, files);
    StoreOptions options;
    options.root = folder.file(name);
    options.upstream = use;
    return Store::open(options);
  }
  static bool publish(Store& store, const Digest& key, const Artifact& artifact) {
    return store.put_blob(artifact, false) && store.put_action(key, action_for(artifact));
  }
  std::string blob_file() const { return place_of(shared, "cas", probe->digest()); }
  std::string entry_file() const { return place_of(shared, "ac", key); }
  static void overwrite(const std::string& path, const std::string& bytes) {
    fs::permissions(path, fs::perms::owner_write, fs::perm_options::add);
    test::write_file(path, bytes);
  }
  static bool says(const Store& store, const std::string& words) {
    for (const std::string& note : store.upstream_notes()) {
      if (note.find(words) != std::string::npos) return true;
    }
    return false;
  }
  Upstream::Written put(Upstream& upstream, const std::string& text) {
    const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(text))};
    return upstream.put(cas, sha256("name"), pieces, {});
  }
  static std::string get(Upstream& upstream, Upstream::Room room, const Digest& name) {
    std::string bytes;
    const auto read = upstream.get(
        room, name,
        [&bytes](std::span<const std::byte> piece) {
          bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
          return true;
        },
        false);
    return read.got == Upstream::Got::found ? bytes : "nothing";
  }

  const std::string shared = folder.file("group share");
};

TEST_F(UpstreamTest, another_machine_finds_what_one_has_made_and_keeps_it) {
  ASSERT_TRUE(publish(*machine("a"), key, *probe));
  EXPECT_EQ(sha256(test::read_file(blob_file())), probe->digest());
  {
    const auto b = machine("b");
    const auto found = b->find_action(key);
    ASSERT_TRUE(found);
    EXPECT_TRUE(test::equal(*found, action));
    EXPECT_TRUE(b->has_blob(found->outputs[0]));
    const ArtifactPtr loaded = b->load(found->outputs[0]);
    ASSERT_NE(loaded, nullptr);
    EXPECT_TRUE(test::same(*loaded, *probe));
    EXPECT_TRUE(b->upstream_notes().empty());
  }
  fs::remove_all(shared);
  const auto alone = Store::open({folder.file("b")});
  EXPECT_TRUE(alone->find_action(key)) << "it lies here now";
  EXPECT_NE(alone->load(action.outputs[0]), nullptr);
}

TEST_F(UpstreamTest, files_are_those_of_the_local_store_and_no_draft_stays) {
  publish(*machine("a"), key, *probe);
  EXPECT_EQ(test::read_file(entry_file()), test::read_file(place_of(folder.file("a"), "ac", key)));
  EXPECT_EQ(files_below(shared), 2u);
  EXPECT_EQ(files->count("try_lock") + files->count("touch"), 0) << "no locks, no times of use";
}

TEST_F(UpstreamTest, a_folder_of_a_group_is_accepted_and_everything_in_it_belongs_to_the_group) {
  ASSERT_EQ(::chmod(shared.c_str(), 02770), 0);
  const mode_t mask = ::umask(077);
  publish(*machine("a"), key, *probe);
  ::umask(mask);
  struct stat status {};
  for (const fs::path& path :
       {fs::path(blob_file()).parent_path(), fs::path(blob_file()).parent_path().parent_path()}) {
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 02770u) << path;
  }
  for (const std::string& path : {blob_file(), entry_file()}) {
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0440u) << path;
  }
}

TEST_F(UpstreamTest, a_folder_that_is_absent_or_open_to_everybody_is_refused_with_the_next_step) {
  const auto refused = [this] {
    try {
      machine("a");
    } catch (const Error& error) {
      return std::string(error.what()) + " | " + error.hint();
    }
    return std::string("opened");
  };
  ASSERT_EQ(::chmod(shared.c_str(), 0777), 0);
  EXPECT_NE(refused().find("everybody may write to it | its entries are believed; close it"),
            std::string::npos);
  fs::remove(shared);
  EXPECT_NE(refused().find("there is no upstream folder " + shared + " | make it"), std::string::npos);
}

TEST_F(UpstreamTest, a_damaged_blob_is_a_miss_in_words_and_is_made_good_by_who_makes_it_again) {
  publish(*machine("a"), key, *probe);
  std::string bytes = test::read_file(blob_file());
  for (const bool flipped : {true, false}) {
    SCOPED_TRACE(flipped);
    std::string bad = flipped ? bytes : bytes.substr(0, bytes.size() / 2);
    if (flipped) bad[bad.size() - 3] = static_cast<char>(bad[bad.size() - 3] ^ 4);
    overwrite(blob_file(), bad);
    const auto b = machine(flipped ? "b" : "c");
    ASSERT_TRUE(b->find_action(key));
    EXPECT_EQ(b->load(action.outputs[0]), nullptr);
    EXPECT_TRUE(says(*b, "is damaged"));
    EXPECT_FALSE(b->has_blob(action.outputs[0])) << "a plan sees that it has to be made again";
    EXPECT_FALSE(fs::exists(place_of(b->root(), "cas", probe->digest())));
    EXPECT_TRUE(publish(*b, key, *probe));
    EXPECT_EQ(test::read_file(blob_file()), bytes);
  }
}

TEST_F(UpstreamTest, a_damaged_or_foreign_entry_is_a_miss_in_words_and_gives_way) {
  publish(*machine("a"), key, *probe);
  const std::string good = test::read_file(entry_file());
  std::string flipped = good;
  flipped[60] = static_cast<char>(flipped[60] ^ 1);
  const Digest other = sha256("another key");
  publish(*machine("a"), other, *probe);
  int i = 0;
  for (const std::string& bad :
       {flipped, good.substr(0, 40), std::string(), test::read_file(place_of(shared, "ac", other))}) {
    SCOPED_TRACE(i);
    overwrite(entry_file(), bad);
    const auto b = machine("b" + std::to_string(i++));
    EXPECT_FALSE(b->find_action(key));
    EXPECT_TRUE(says(*b, "is damaged"));
    EXPECT_TRUE(publish(*b, key, *probe));
    EXPECT_EQ(test::read_file(entry_file()), good);
  }
}

TEST_F(UpstreamTest, the_first_publisher_wins_and_a_disagreement_is_told) {
  publish(*machine("a"), key, *probe);
  const std::string first = test::read_file(entry_file());
  const auto b = machine("b");
  const ArtifactPtr other = make_probe(2);
  b->put_blob(*other, false);
  const ActionPut put = b->put_action(key, action_for(*other));
  EXPECT_TRUE(put.stored);
  EXPECT_FALSE(put.disagreed);
  ASSERT_TRUE(put.upstream_disagreed);
  EXPECT_TRUE(test::equal(*put.upstream_disagreed, action));
  EXPECT_TRUE(says(*b, "names another result"));
  EXPECT_EQ(test::read_file(entry_file()), first);
  EXPECT_TRUE(test::equal(*b->find_action(key), action_for(*other))) << "here one's own counts";
}

TEST_F(UpstreamTest, a_read_only_upstream_is_read) {
  publish(*machine("a"), key, *probe);
  UpstreamUse use;
  use.read_only = true;
  const auto b = machine("b", use);
  EXPECT_TRUE(b->find_action(key));
  const ArtifactPtr other = make_probe(2);
  EXPECT_TRUE(publish(*b, sha256("other"), *other));
  EXPECT_EQ(files_below(shared), 2u);
}

TEST_F(UpstreamTest, a_full_upstream_costs_nothing_but_sharing) {
  files->fault = [](const std::string& call) { return call == "write" ? -ENOSPC : 0; };
  const auto a = machine("a");
  EXPECT_TRUE(publish(*a, key, *probe));
  EXPECT_TRUE(says(*a, "No space left on device"));
  EXPECT_EQ(a->upstream_notes().size(), 1u);
  EXPECT_EQ(files_below(shared), 0u) << "no entry without its blobs, and no draft";
  EXPECT_TRUE(a->find_action(key));
  EXPECT_NE(a->load(action.outputs[0]), nullptr);
}

TEST_F(UpstreamTest, between_jobs_a_failed_write_is_an_error) {
  UpstreamUse use;
  use.transport = true;
  const auto a = machine("a", use);
  for (const std::string call : {"write", "close", "link"}) {
    files->fault = [&call](const std::string& name) { return name == call ? -EIO : 0; };
    try {
      a->put_blob(*probe, false);
      ADD_FAILURE() << call;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::store);
      EXPECT_NE(std::string(error.what()).find("cannot be published"), std::string::npos) << error.what();
    }
  }
  files->fault = {};
  EXPECT_EQ(files_below(shared), 0u);
  EXPECT_TRUE(publish(*a, key, *probe));
}

TEST_F(UpstreamTest, between_jobs_a_hit_is_one_that_others_find_too) {
  UpstreamUse use;
  use.transport = true;
  // What a full disk left here alone is handed on when there is room.
  const auto a = machine("a", use);
  files->fault = [](const std::string& call) { return call == "write" ? -ENOSPC : 0; };
  EXPECT_THROW(publish(*a, key, *probe), Error);
  const auto local = Store::open({folder.file("a")});
  publish(*local, key, *probe);
  EXPECT_THROW(a->find_action(key), Error);
  files->fault = {};
  EXPECT_TRUE(a->find_action(key));
  EXPECT_TRUE(fs::exists(blob_file()) && fs::exists(entry_file()));
  // A blob that was lost is no hit for who has not got it, and is put back by who has.
  fs::remove(blob_file());
  EXPECT_FALSE(machine("b", use)->find_action(key));
  EXPECT_TRUE(a->find_action(key));
  EXPECT_TRUE(machine("b", use)->find_action(key));
}

TEST_F(UpstreamTest, a_local_disk_that_cannot_take_a_blob_does_not_matter) {
  publish(*machine("a"), key, *probe);
  fs::create_directory(folder.file("b"));
  const auto local = std::make_shared<FaultyFileSystem>();
  StoreOptions options;
  options.root = folder.file("b");
  options.upstream.upstream = Upstream::open(shared, files);
  const auto b = Store::open(options, local);
  local->fault = [](const std::string& call) { return call == "write" ? -ENOSPC : 0; };
  const auto found = b->find_action(key);
  ASSERT_TRUE(found);
  const ArtifactPtr loaded = b->load(found->outputs[0]);
  ASSERT_NE(loaded, nullptr);
  EXPECT_TRUE(test::same(*loaded, *probe));
}

TEST_F(UpstreamTest, jobs_look_again_for_a_blob_that_an_entry_promises) {
  publish(*machine("a"), key, *probe);
  const std::string hidden = shared + "/hidden";
  fs::rename(blob_file(), hidden);
  EXPECT_EQ(machine("b")->load(action.outputs[0]), nullptr) << "a run does not wait";
  UpstreamUse use;
  use.patience = 600;
  const auto c = machine("c", use);
  // The folder is listed before every look but the first: it comes to light with the third list.
  int lists = 0;
  files->fault = [&](const std::string& call) {
    if (call == "list" && ++lists == 2) fs::rename(hidden, blob_file());
    return 0;
  };
  EXPECT_NE(c->load(action.outputs[0]), nullptr);
  EXPECT_EQ(lists, 2);
}

TEST_F(UpstreamTest, without_hard_links_files_are_moved_into_place) {
  for (const bool no_exclusive_rename : {false, true}) {
    SCOPED_TRACE(no_exclusive_rename);
    files->fault = [&](const std::string& call) {
      if (call == "link") return -EPERM;
      return call == "rename" && no_exclusive_rename ? -EINVAL : 0;
    };
    const auto upstream = Upstream::open(shared, files);
    EXPECT_EQ(put(*upstream, "first").put, Upstream::Put::written);
    EXPECT_EQ(put(*upstream, "second").put, Upstream::Put::there);
    EXPECT_EQ(get(*upstream, cas, sha256("name")), "first");
    EXPECT_EQ(files_below(shared), 1u);
    fs::remove(place_of(shared, "cas", sha256("name")));
  }
}

TEST_F(UpstreamTest, a_link_whose_answer_was_lost_counts_as_made) {
  files->lose_reply = true;
  const auto upstream = Upstream::open(shared, files);
  EXPECT_EQ(put(*upstream, "first").put, Upstream::Put::written);
  EXPECT_EQ(get(*upstream, cas, sha256("name")), "first");
  EXPECT_EQ(files_below(shared), 1u);
}

TEST_F(UpstreamTest, a_race_that_another_won_leaves_his) {
  const auto upstream = Upstream::open(shared, files);
  const auto other = Upstream::open(shared);
  files->fault = [&](const std::string& call) {
    if (call == "link") put(*other, "his");
    return 0;
  };
  EXPECT_EQ(put(*upstream, "mine").put, Upstream::Put::there);
  EXPECT_EQ(get(*other, cas, sha256("name")), "his");
  EXPECT_EQ(files_below(shared), 1u);
}

TEST_F(UpstreamTest, a_file_or_folder_that_went_stale_is_asked_for_again) {
  const auto a = machine("a");
  int left = 1;
  files->fault = [&](const std::string& call) { return call == "link" && left-- > 0 ? -ESTALE : 0; };
  EXPECT_TRUE(publish(*a, key, *probe));
  EXPECT_TRUE(a->upstream_notes().empty());
  for (const std::string call : {"open", "read", "status"}) {
    SCOPED_TRACE(call);
    const auto b = machine("b" + call);
    left = 1;
    files->fault = [&](const std::string& name) { return name == call && left-- > 0 ? -ESTALE : 0; };
    EXPECT_TRUE(b->find_action(key));
    left = 1;
    EXPECT_NE(b->load(action.outputs[0]), nullptr);
    EXPECT_TRUE(b->upstream_notes().empty());
  }
}

TEST_F(UpstreamTest, a_blob_that_goes_stale_half_read_is_read_from_its_beginning) {
  const ArtifactPtr large = make_probe(3, 400'000);  // several reads
  const OutputEntry entry = entry_for(*large);
  machine("a")->put_blob(*large, false);
  const auto b = machine("b");
  int reads = 0;
  files->fault = [&](const std::string& call) { return call == "read" && ++reads == 2 ? -ESTALE : 0; };
  const ArtifactPtr loaded = b->load(entry);
  ASSERT_NE(loaded, nullptr);
  EXPECT_TRUE(test::same(*loaded, *large));
  EXPECT_TRUE(fs::exists(place_of(b->root(), "cas", large->digest())));
  EXPECT_TRUE(b->upstream_notes().empty());
}

TEST_F(UpstreamTest, eight_writers_of_a_thousand_keys_never_show_a_torn_file_and_the_first_wins) {
  constexpr int writers = 8, keys = 1000;
  const auto name_of = [](int i) { return sha256("key " + std::to_string(i)); };
  // Each its own text for every name, of a size that takes several writes.
  const auto text_of = [](int writer, int i) {
    return std::string(static_cast<std::size_t>(64 + 7 * i), static_cast<char>('a' + writer)) + '.' +
           std::to_string(i);
  };
  const auto whole = [&](const std::string& text, int i) {
    const int writer = text.empty() ? -1 : text[0] - 'a';
    return writer >= 0 && writer < writers && text == text_of(writer, i);
  };
  // Exit status 1: a torn file, or one that changed after it was there.
  const auto work = [&](int writer) {
    const auto mine = std::make_shared<FaultyFileSystem>();
    mine->write_at_most = 1000;
    const auto upstream = Upstream::open(shared, mine);
    for (int n = 0; n < keys; ++n) {
      const int i = (n + writer) % keys;
      const std::string text = text_of(writer, i);
      const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(text))};
      const auto put = upstream->put(ac, name_of(i), pieces, {}).put;
      const std::string there = get(*upstream, ac, name_of(i));
      if (!whole(there, i) || (put == Upstream::Put::written && there != text)) ::_exit(1);
      const int ahead = (i + 3) % keys;  // somebody may just be writing it
      const std::string seen = get(*upstream, ac, name_of(ahead));
      if (seen != "nothing" && (!whole(seen, ahead) || get(*upstream, ac, name_of(ahead)) != seen))
        ::_exit(1);
    }
  };
  std::vector<pid_t> children;
  for (int writer = 0; writer < writers; ++writer) children.push_back(start([&] { work(writer); }));
  for (const pid_t child : children) EXPECT_EQ(finish(child), 0);
  EXPECT_EQ(files_below(shared), static_cast<std::size_t>(keys));
}

}  // namespace
}  // namespace ballflow
