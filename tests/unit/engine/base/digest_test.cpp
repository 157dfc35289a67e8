#include "ballflow/digest.hpp"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace ballflow
