// Collecting an upstream in a folder: what is old goes, entries first, and what is left is whole.
#include "ballflow/upstream_gc.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include "ballflow/upstream.hpp"
#include "store_fixture.hpp"

namespace ballflow {
namespace {

constexpr std::int64_t day = 86400;

class UpstreamGcTest : public StoreTest {
 protected:
  UpstreamGcTest() { fs::create_directory(shared); }

  static Digest key_of(int i) { return sha256("key " + std::to_string(i)); }
  static void age(const std::string& file, double days) {
    const std::int64_t time =
        FileSystem().now() - static_cast<std::int64_t>(days * static_cast<double>(day) * 1e9);
    const timespec times[2] = {{0, UTIME_OMIT}, {time / 1'000'000'000, time % 1'000'000'000}};
    ASSERT_EQ(::utimensat(AT_FDCWD, file.c_str(), times, AT_SYMLINK_NOFOLLOW), 0) << file;
  }
  /// Publishes artifact `content` by key `i`, both written so many days ago.
  void put(int i, int content, double entry_days, double blob_days) {
    StoreOptions options;
    options.root = folder.file("a machine");
    options.upstream.upstream = Upstream::open(shared);
    const auto store = Store::open(options);
    const ArtifactPtr artifact = make_probe(content);
    ASSERT_TRUE(store->put_blob(*artifact, false));
    ASSERT_TRUE(store->put_action(key_of(i), action_for(*artifact)));
    age(entry(i), entry_days);
    age(blob(content), blob_days);
  }
  std::string entry(int i) const { return place_of(shared, "ac", key_of(i)); }
  std::string blob(int content) const { return place_of(shared, "cas", make_probe(content)->digest()); }
  UpstreamCollected collect(std::int64_t days, bool dry_run = false) {
    return collect_upstream(shared, {days * day, dry_run}, files);
  }
  /// What is said when nothing can be done; "collected" otherwise.
  std::string refusal(const std::string& place) {
    try {
      collect_upstream(place, {day, false}, files);
    } catch (const Error& error) {
      EXPECT_FALSE(error.hint().empty());
      return error.what();
    }
    return "collected";
  }
  /// Another machine, with nothing of its own, finds entry `i` with its artifact.
  bool whole(int i, int content) const {
    StoreOptions options;
    options.root = folder.file("reader of " + std::to_string(i));
    options.upstream.upstream = Upstream::open(shared);
    const auto store = Store::open(options);
    const auto found = store->find_action(key_of(i));
    const ArtifactPtr artifact = found ? store->load(found->outputs[0]) : nullptr;
    return artifact != nullptr && test::same(*artifact, *make_probe(content)) &&
           store->upstream_notes().empty();
  }

  const std::string shared = folder.file("group share");
};

TEST_F(UpstreamGcTest, old_entries_go_and_old_blobs_that_none_names_any_more) {
  put(1, 1, 40, 40);  // both go
  put(2, 2, 10, 40);  // an old blob that a young entry names
  put(3, 3, 40, 10);  // a young blob whose entry goes
  put(4, 4, 10, 10);
  put(5, 2, 40, 40);  // the old entry of a blob that stays
  const auto bytes = [](const std::string& file) { return fs::file_size(file); };
  const std::uint64_t entries = bytes(entry(1)) + bytes(entry(3)) + bytes(entry(5)), blobs = bytes(blob(1));

  const UpstreamCollected dry = collect(30, true);
  EXPECT_EQ(files_below(shared), 9u) << "a dry run removes nothing";
  EXPECT_EQ(files->count("remove"), 0);
  const UpstreamCollected done = collect(30);
  for (const UpstreamCollected& result : {dry, done}) {
    EXPECT_EQ(result.entries.files, 3u);
    EXPECT_EQ(result.entries.bytes, entries);
    EXPECT_EQ(result.blobs.files, 1u);
    EXPECT_EQ(result.blobs.bytes, blobs);
    EXPECT_EQ(result.entries_left.files, 2u);
    EXPECT_EQ(result.blobs_left.files, 3u);
    EXPECT_EQ(result.failed.files, 0u);
  }
  EXPECT_FALSE(fs::exists(blob(1)));
  EXPECT_TRUE(fs::exists(blob(3)));
  for (const int i : {1, 3, 5}) EXPECT_FALSE(fs::exists(entry(i))) << i;
  EXPECT_TRUE(whole(2, 2));
  EXPECT_TRUE(whole(4, 4));
  EXPECT_EQ(collect(30).entries.files, 0u) << "a second collection finds nothing";
}

TEST_F(UpstreamGcTest, interrupted_anywhere_it_leaves_entries_with_their_blobs) {
  for (int stop = 0; stop < 6; ++stop) {
    SCOPED_TRACE(stop);
    fs::remove_all(folder.file("a machine"));
    for (int i = 0; i < 3; ++i) {
      fs::remove_all(folder.file("reader of " + std::to_string(i)));
      put(i, i, 40, 40);
    }
    int calls = 0;
    files->fault = [&calls, stop](const std::string& call) {
      if (call == "remove" && calls++ >= stop) throw std::runtime_error("killed");
      return 0;
    };
    EXPECT_THROW(collect(30), std::runtime_error);
    files->fault = {};
    std::size_t entries = 0;
    for (int i = 0; i < 3; ++i) {
      if (!fs::exists(entry(i))) continue;
      ++entries;
      EXPECT_TRUE(whole(i, i)) << i;
    }
    EXPECT_EQ(entries, static_cast<std::size_t>(std::max(3 - stop, 0))) << "entries go first";
    EXPECT_EQ(files_below(shared), static_cast<std::size_t>(6 - stop));
  }
}

TEST_F(UpstreamGcTest, what_an_entry_names_that_cannot_be_removed_stays) {
  put(1, 1, 40, 40);
  put(2, 2, 40, 40);
  int calls = 0;
  files->fault = [&calls](const std::string& call) { return call == "remove" && calls++ == 0 ? -EACCES : 0; };
  const UpstreamCollected done = collect(30);
  EXPECT_EQ(done.failed.files, 1u);
  EXPECT_NE(done.why.find("ac/"), std::string::npos) << done.why;
  EXPECT_NE(done.why.find("Permission denied"), std::string::npos) << done.why;
  EXPECT_EQ(done.entries_left.files, 1u);
  EXPECT_EQ(done.blobs.files, 1u);
  const int left = fs::exists(entry(1)) ? 1 : 2;
  EXPECT_TRUE(whole(left, left));
}

TEST_F(UpstreamGcTest, what_cannot_be_read_costs_no_blob) {
  put(1, 1, 0, 40);
  for (const char* call : {"read", "list"}) {
    files->fault = [call](const std::string& now) { return now == call ? -EIO : 0; };
    EXPECT_NE(refusal(shared).find("cannot read " + shared + "/ac"), std::string::npos) << call;
    EXPECT_EQ(files->count("remove"), 0) << call;
  }
  files->fault = {};
  EXPECT_TRUE(whole(1, 1));
}

TEST_F(UpstreamGcTest, leftovers_of_publishers_go_and_everything_else_stays) {
  put(1, 1, 40, 40);
  const std::string old_draft = entry(1) + ".tmp-host-0123456789abcdef",
                    old_damaged = blob(1) + ".damaged-0123";
  const std::string young_draft = blob(1) + ".tmp-host-fedcba9876543210";
  const std::string others = fs::path(entry(1)).parent_path().string() + "/notes.tmp-of mine";
  const std::string outside = shared + "/submissions/log";
  const std::string target = folder.file("target");
  fs::create_directory(shared + "/submissions");
  for (const std::string& file : {old_draft, old_damaged, young_draft, others, outside, target}) {
    test::write_file(file, "text");
    if (file != young_draft) age(file, 40);
  }
  // Links with the names of results, to a file and to a folder.
  fs::create_directory(folder.file("elsewhere"));
  const std::string linked = fs::path(place_of(shared, "cas", sha256("link"))).filename().string();
  const std::string kept = folder.file("elsewhere/" + linked);
  test::write_file(kept, "text");
  age(kept, 40);
  const std::string shard = shared + "/cas/" + sha256("link").hex().substr(0, 2);
  fs::create_directory_symlink(folder.file("elsewhere"), shard);
  const std::string link = fs::path(entry(1)).parent_path().string() + "/" + linked;
  fs::create_symlink(target, link);
  age(link, 40);

  const UpstreamCollected done = collect(30);
  EXPECT_EQ(done.entries.files, 1u);
  EXPECT_EQ(done.blobs.files, 1u);
  EXPECT_EQ(done.leftovers.files, 2u);
  EXPECT_EQ(done.leftovers.bytes, 8u);
  for (const std::string& file : {old_draft, old_damaged}) EXPECT_FALSE(fs::exists(file)) << file;
  for (const std::string& file : {young_draft, others, outside, target, kept})
    EXPECT_TRUE(fs::exists(file)) << file;
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::is_symlink(shard));
}

TEST_F(UpstreamGcTest, a_damaged_entry_names_nothing) {
  put(1, 1, 10, 40);
  fs::permissions(entry(1), fs::perms::owner_write, fs::perm_options::add);
  test::write_file(entry(1), "half an ent");
  age(entry(1), 10);
  EXPECT_EQ(collect(30).blobs.files, 1u);
  EXPECT_TRUE(fs::exists(entry(1))) << "it is young";
}

TEST_F(UpstreamGcTest, other_places_are_refused_with_the_next_step) {
  EXPECT_NE(refusal("http://host/path").find("is a server"), std::string::npos);
  EXPECT_NE(refusal(folder.file("nowhere")).find("there is no upstream folder"), std::string::npos);
  open();
  EXPECT_NE(refusal(root).find("is the cache of a machine"), std::string::npos);
  EXPECT_EQ(refusal(shared), "collected") << "an empty one";
}

TEST(UpstreamAge, is_a_whole_number_of_hours_days_weeks_or_years) {
  EXPECT_EQ(parse_age("36h"), 36 * 3600);
  EXPECT_EQ(parse_age("1d"), day);
  EXPECT_EQ(parse_age("8w"), 56 * day);
  EXPECT_EQ(parse_age("100y"), 36500 * day);
  EXPECT_EQ(parse_age("0d"), 0);
  for (const char* text :
       {"", "d", "12", "12m", "12days", "-1d", "1.5d", "101y", "99999999999999999999h", " 1d", "1d "})
    EXPECT_FALSE(parse_age(text)) << text;
}

}  // namespace
}  // namespace ballflow
