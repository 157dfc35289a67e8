// What the verifier finds, moves, and leaves alone.
#include "gc_fixture.hpp"

namespace ballflow {
namespace {

class VerifyTest : public GcTest {};

}  // namespace

TEST_F(VerifyTest, verify_finds_nothing_in_a_good_cache) {
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

TEST_F(VerifyTest, verify_moves_what_is_damaged_to_quarantine_and_a_run_heals_it) {
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

TEST_F(VerifyTest, only_full_verification_finds_content_that_fits_its_entry_but_not_its_name) {
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

TEST_F(VerifyTest, an_entry_that_describes_a_good_artifact_wrongly_is_the_bad_one) {
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

TEST_F(VerifyTest, memoised_digests_are_verified_and_bounded) {
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
