// Damaged files: never a wrong result, never a crash, and the next publication heals.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "ballflow/store.hpp"
#include "faulty_file_system.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using test::action_for;
using test::entry_for;
using test::make_probe;
using test::place_of;

/// Calls check with every truncation, with one flipped bit per byte (all eight in turn over the file), with
/// zeros of the right length and with one byte too many.
void for_each_damage(const std::string& good,
                     const std::function<void(const std::string&, const std::string&)>& check) {
  for (std::size_t size = 0; size < good.size(); ++size)
    check(good.substr(0, size), "cut to " + std::to_string(size));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1 << i % 8);
    check(bad, "bit " + std::to_string(i % 8) + " of byte " + std::to_string(i));
  }
  check(std::string(good.size(), '\0'), "zeros");
  check(good + '\0', "one byte longer");
  check(good + good, "twice");
}

void overwrite(const std::string& path, const std::string& content) {
  fs::remove(path);
  test::write_file(path, content);
  ASSERT_EQ(::chmod(path.c_str(), 0644), 0);
}

class CorruptionTest : public ::testing::Test {
 protected:
  const test::TempFolder folder;
  const std::string root = folder.file("cache");
  const std::shared_ptr<Store> store = Store::open({root});
  const ArtifactPtr probe = make_probe(1);
  const ActionEntry action = action_for(*probe);
  const Digest key = sha256("key");
};

}  // namespace

TEST_F(CorruptionTest, damaged_blobs_go_to_quarantine_and_heal) {
  const std::string place = place_of(root, "cas", probe->digest());
  std::uint64_t quarantined = 0;
  for_each_damage(test::file_bytes(*probe), [&](const std::string& bad, const std::string& what) {
    overwrite(place, bad);
    EXPECT_EQ(store->has_blob(entry_for(*probe)), bad.size() == probe->file_size()) << what;
    EXPECT_EQ(store->load(entry_for(*probe)), nullptr) << what;
    EXPECT_FALSE(fs::exists(place)) << what;
    EXPECT_EQ(store->load(entry_for(*probe)), nullptr) << what;
    ++quarantined;
  });
  EXPECT_EQ(store->statistics().quarantined, quarantined);
  EXPECT_TRUE(store->put_blob(*probe, false));
  EXPECT_TRUE(test::same(*store->load(entry_for(*probe)), *probe));
}

TEST_F(CorruptionTest, publishing_replaces_a_damaged_blob) {
  const std::string place = place_of(root, "cas", probe->digest());
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, test::file_bytes(*probe).size()}) {
    overwrite(place, std::string(size, 'x'));
    EXPECT_TRUE(store->put_blob(*probe, false));
    EXPECT_TRUE(test::same(*store->load(entry_for(*probe)), *probe));
  }
}

TEST_F(CorruptionTest, a_damaged_blob_that_cannot_be_moved_is_replaced_in_place) {
  const auto files = std::make_shared<test::FaultyFileSystem>();
  const auto other = Store::open({root}, files);
  const std::string place = place_of(root, "cas", probe->digest());
  overwrite(place, std::string(probe->file_size(), 'x'));
  int replacements = 0;
  files->fault = [&](const std::string& call) {
    return call == "rename_replace" && ++replacements == 1 ? -EIO : 0;
  };
  EXPECT_TRUE(other->put_blob(*probe, false));
  EXPECT_EQ(replacements, 2);
  EXPECT_TRUE(test::same(*other->load(entry_for(*probe)), *probe));
}

TEST_F(CorruptionTest, another_good_artifact_under_the_wrong_name_is_damage) {
  const std::string place = place_of(root, "cas", probe->digest());
  overwrite(place, test::file_bytes(*make_probe(2)));
  EXPECT_EQ(store->load(entry_for(*probe)), nullptr);
  EXPECT_FALSE(fs::exists(place));
}

TEST_F(CorruptionTest, a_good_blob_survives_a_description_that_is_wrong) {
  store->put_blob(*probe, false);
  OutputEntry wrong = entry_for(*probe);
  wrong.checksum.low ^= 1;
  EXPECT_EQ(store->load(wrong), nullptr);
  wrong = entry_for(*probe);
  wrong.bytes += 1;
  EXPECT_EQ(store->load(wrong), nullptr);
  EXPECT_FALSE(store->has_blob(wrong));
  wrong = entry_for(*probe);
  wrong.type = "Other";
  EXPECT_EQ(store->load(wrong), nullptr);
  wrong = entry_for(*probe);
  wrong.summary = "{}";
  EXPECT_EQ(store->load(wrong), nullptr);
  EXPECT_NE(store->load(entry_for(*probe)), nullptr);
  EXPECT_EQ(store->statistics().quarantined, 0u);
}

TEST_F(CorruptionTest, damaged_entries_are_misses_and_heal) {
  store->put_action(key, action);
  const std::string place = place_of(root, "ac", key);
  for_each_damage(test::read_file(place), [&](const std::string& bad, const std::string& what) {
    overwrite(place, bad);
    EXPECT_FALSE(store->find_action(key)) << what;
  });
  EXPECT_TRUE(store->put_action(key, action));
  EXPECT_TRUE(test::equal(*store->find_action(key), action));
}

TEST_F(CorruptionTest, an_entry_of_another_key_is_a_miss) {
  const Digest other = sha256("other");
  store->put_action(key, action);
  overwrite(place_of(root, "ac", other), test::read_file(place_of(root, "ac", key)));
  EXPECT_FALSE(store->find_action(other));
  EXPECT_TRUE(store->find_action(key));
}

TEST_F(CorruptionTest, lengths_and_counts_that_lie_behind_a_right_checksum_are_misses) {
  store->put_action(key, action);
  const std::string place = place_of(root, "ac", key);
  const std::string good = test::read_file(place);
  const auto resealed = [](std::string bytes) {
    const Checksum sum = checksum_of(bytes.data(), bytes.size());
    for (const std::uint64_t half : {sum.low, sum.high}) {
      for (int i = 0; i < 8; ++i) bytes += static_cast<char>(half >> (8 * i) & 0xff);
    }
    return bytes;
  };
  const std::string content = good.substr(0, good.size() - 16);
  ASSERT_EQ(resealed(content), good);
  for (std::size_t size = 0; size < content.size(); ++size) {
    overwrite(place, resealed(content.substr(0, size)));
    EXPECT_FALSE(store->find_action(key)) << size;
  }
  // 0xffffffff over every aligned and unaligned place: lengths, counts, versions; where it hits plain content
  // the entry is another valid one, and the reader must still not run away.
  for (std::size_t i = 0; i + 4 <= content.size(); ++i) {
    std::string bad = content;
    bad.replace(i, 4, 4, '\xff');
    overwrite(place, resealed(bad));
    if (const auto found = store->find_action(key)) {
      EXPECT_EQ(found->outputs.size(), 1u);
      EXPECT_EQ(found->warnings.size(), 2u);
      EXPECT_EQ(found->manifest.size(), action.manifest.size());
    }
  }
  overwrite(place, resealed(content + 'x'));
  EXPECT_FALSE(store->find_action(key));
}

TEST_F(CorruptionTest, a_huge_entry_is_not_read) {
  store->put_action(key, action);
  fs::permissions(place_of(root, "ac", key), fs::perms::owner_write, fs::perm_options::add);
  fs::resize_file(place_of(root, "ac", key), std::uintmax_t{1} << 40);  // sparse
  EXPECT_FALSE(store->find_action(key));
  EXPECT_TRUE(store->put_action(key, action));
  EXPECT_TRUE(store->find_action(key));
}

TEST_F(CorruptionTest, damaged_memos_do_not_change_the_digest_of_a_file) {
  const std::string input = folder.file("input");
  test::write_file(input, "the content");
  const auto files = std::make_shared<test::FaultyFileSystem>();
  files->clock_offset = 10'000'000'000;
  const auto later = Store::open({root}, files);
  ASSERT_EQ(later->file_digest(input), sha256("the content"));
  std::string place;
  for (const auto& entry : fs::recursive_directory_iterator(root + "/files")) {
    if (entry.is_regular_file()) place = entry.path();
  }
  const std::string good = test::read_file(place);
  for_each_damage(good, [&](const std::string& bad, const std::string& what) {
    overwrite(place, bad);
    EXPECT_EQ(later->file_digest(input), sha256("the content")) << what;
    EXPECT_EQ(test::read_file(place), good) << what << ": not healed";
  });
}

}  // namespace ballflow
