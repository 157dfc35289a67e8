#include "ballflow/digest.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "base/open_file.hpp"
#include "faulty_file_system.hpp"
#include "test_data.hpp"

namespace ballflow {

TEST(digest, equals_the_published_sha256_examples) {
  // FIPS 180-2, appendix B, and the empty message.
  EXPECT_EQ(sha256("").hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc").hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq").hex(),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  Hasher million;
  for (int i = 0; i < 1000; ++i) million.add(std::string(1000, 'a'));
  EXPECT_EQ(million.finish().hex(), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(digest, hexadecimal_text_reads_back) {
  const Digest digest = sha256("x");
  EXPECT_EQ(Digest::from_hex(digest.hex()), digest);
}

TEST(digest, refuses_text_that_hex_would_not_write) {
  const std::string good = sha256("x").hex();
  EXPECT_FALSE(Digest::from_hex(""));
  EXPECT_FALSE(Digest::from_hex(good.substr(1)));
  EXPECT_FALSE(Digest::from_hex(good + "0"));
  std::string upper = good, other = good;
  upper[5] = 'A';
  other[5] = 'g';
  EXPECT_FALSE(Digest::from_hex(upper));
  EXPECT_FALSE(Digest::from_hex(other));
}

TEST(checksum, equals_the_published_value_of_nothing) {
  // The test vector of XXH3-128 for length 0, seed 0.
  const Checksum expected{0x6001C324468D497FULL, 0x99AA06D3014798D8ULL};
  EXPECT_EQ(checksum_of(nullptr, 0), expected);
  EXPECT_EQ(Checksummer().finish(), expected);
}

TEST(checksum, does_not_depend_on_the_pieces) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += static_cast<char>(i * i);
  for (const std::size_t step : {1u, 7u, 256u, 4999u}) {
    Checksummer sum;
    for (std::size_t at = 0; at < text.size(); at += step)
      sum.add(text.data() + at, std::min(step, text.size() - at));
    EXPECT_EQ(sum.finish(), checksum_of(text.data(), text.size())) << step;
  }
}

TEST(sums, of_pieces_are_those_of_the_whole) {
  std::string text;
  for (int i = 0; i < 1'000'000; ++i) text += static_cast<char>(i * 31 >> 3);
  const auto bytes = std::as_bytes(std::span(text));
  for (const std::size_t cut : {std::size_t{0}, std::size_t{1}, std::size_t{131'072}, text.size()}) {
    const std::vector<std::span<const std::byte>> pieces{bytes.first(cut), bytes.subspan(cut)};
    Digest digest, alone;
    Checksum checksum;
    ASSERT_TRUE(sum_up(pieces, &digest, &checksum));
    EXPECT_EQ(digest, sha256(text)) << cut;
    EXPECT_EQ(checksum, checksum_of(text.data(), text.size())) << cut;
    ASSERT_TRUE(sum_up(pieces, &alone, nullptr));
    EXPECT_EQ(alone, digest);
  }
}

TEST(sums, of_much_are_given_up_when_asked) {
  const std::string large(40 << 20, 'x');
  const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(large))};
  Digest digest;
  int looks = 0;
  EXPECT_FALSE(sum_up(pieces, &digest, nullptr, [&looks] { return ++looks == 2; }));
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(digest, Digest());
}

TEST(sums, of_a_file_stop_beyond_what_was_expected) {
  const test::TempFolder folder;
  const std::string content(1'000'000, 'y');
  test::write_file(folder.file("input"), content);
  test::FaultyFileSystem files;
  const auto sum = [&](std::uint64_t at_most, Digest& digest) {
    const OpenFile file(files, files.open(FileSystem::working_folder, folder.file("input"), O_RDONLY, 0));
    return sha256_of_file(files, file.get(), at_most, digest);
  };
  Digest digest;
  EXPECT_EQ(sum(content.size(), digest), 1'000'000);
  EXPECT_EQ(digest, sha256(content));
  const std::int64_t read = sum(10, digest);
  EXPECT_GT(read, 10) << "so that the caller sees that the file has grown";
  EXPECT_LT(read, 1'000'000);
  files.fault = [](const std::string& call) { return call == "read" ? -EIO : 0; };
  EXPECT_EQ(sum(content.size(), digest), -EIO);
}

}  // namespace ballflow
