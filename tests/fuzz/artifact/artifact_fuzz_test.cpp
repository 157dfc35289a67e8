// Mutated artifact files: the decoder refuses with BadArtifact or accepts exactly what sealing would write.
// Deterministic: the standard fixes the numbers of mt19937_64.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/canonical_json.hpp"

namespace ballflow {
namespace {

class Fuzzer {
 public:
  explicit Fuzzer(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t bound) {
    return bound == 0 ? 0 : static_cast<std::size_t>(random_() % bound);
  }

  /// A valid file with arrays of random types and shapes.
  std::string valid() {
    constexpr std::uint32_t dtypes[] = {BF_F64, BF_F32, BF_I64, BF_I32, BF_U32, BF_U16, BF_U8};
    std::vector<std::vector<std::uint64_t>> storage;
    std::vector<NamedArray> arrays;
    const std::size_t count = below(5);
    for (std::size_t i = 0; i < count; ++i) {
      NamedArray array{"array" + std::to_string(i), dtypes[below(7)], {}, nullptr};
      for (std::size_t rank = below(4); rank > 0; --rank) array.shape.push_back(below(4));
      storage.emplace_back(array.bytes() / 8 + 1, random_());
      array.data = storage.back().data();
      arrays.push_back(std::move(array));
    }
    const std::string summary =
        R"({"count":)" + std::to_string(below(1000)) + R"(,"box":[[0.1,-2e30],null]})";
    const auto artifact =
        Artifact::seal("Type", static_cast<int>(below(3)), std::move(arrays), summary, nullptr);
    std::string bytes;
    for (const auto piece : artifact->pieces()) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    }
    return bytes;
  }

  void mutate(std::string& bytes) {
    static const std::vector<std::string> tokens{"{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 ",",
                                                 ":",
                                                 "\"",
                                                 "\\",
                                                 "\\u0000",
                                                 "-1",
                                                 "0",
                                                 "1e9",
                                                 "18446744073709551615",
                                                 "9223372036854775808",
                                                 "null",
                                                 "true",
                                                 "\"F64\"",
                                                 "\"shape\":",
                                                 "\"data_offsets\":[0,0]",
                                                 "\"__metadata__\":{}",
                                                 " ",
                                                 "\n",
                                                 "\xff",
                                                 "[[[[",
                                                 "{\"a\":{\"a\":",
                                                 "\"dtype\":\"U8\","};
    const std::size_t at = below(bytes.size() + 1);
    switch (below(7)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 1:
        bytes.insert(at, tokens[below(tokens.size())]);
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size() + 1), below(40)));
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5: {  // another digit for a digit: shapes, offsets, versions
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + below(10));
        break;
      }
      default: {
        const std::string& token = tokens[below(tokens.size())];
        bytes.replace(at, std::min(token.size(), bytes.size() - at), token);
      }
    }
  }

  /// Makes the length of the header fit again, so that mutations reach the parser behind it.
  void repair_length(std::string& bytes) {
    const std::size_t end = bytes.rfind('}');
    if (bytes.size() < 8 || end == std::string::npos || end < 8) return;
    const std::size_t header = (end + 1 + 63) / 64 * 64;
    if (bytes.size() < header) bytes.resize(header, ' ');
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>((header - 8) >> (8 * i) & 0xff);
  }

 private:
  std::mt19937_64 random_;
};

/// Whether the decoder accepts; fails the test when it accepts anything that is not canonical.
bool accepts(const std::string& bytes) {
  // In memory of exactly this size, so that the address sanitizer sees a step beyond it.
  const auto memory = std::make_shared<std::vector<std::byte>>(bytes.size());
  memory->shrink_to_fit();
  if (!bytes.empty()) std::memcpy(memory->data(), bytes.data(), bytes.size());
  try {
    const ArtifactPtr read = Artifact::decode(*memory, memory);
    const ArtifactPtr again =
        Artifact::seal(read->type(), read->version(), read->arrays(), read->summary(), memory);
    std::string sealed;
    for (const auto piece : again->pieces())
      sealed.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    EXPECT_EQ(sealed, bytes);
    EXPECT_EQ(read->checksum(), again->checksum());
    EXPECT_EQ(read->digest(), again->digest());
    return true;
  } catch (const BadArtifact&) {
    return false;
  }
}

}  // namespace

TEST(artifact_fuzz, mutated_files_are_refused_or_canonical) {
  Fuzzer fuzzer(1);
  int accepted = 0, refused = 0;
  for (int round = 0; round < 30000; ++round) {
    std::string bytes = fuzzer.valid();
    ASSERT_TRUE(accepts(bytes)) << round;
    for (std::size_t i = fuzzer.below(4) + 1; i > 0; --i) fuzzer.mutate(bytes);
    if (fuzzer.below(2) == 0) fuzzer.repair_length(bytes);
    ++(accepts(bytes) ? accepted : refused);
  }
  // Both happen, else the mutations are too tame or too wild to mean anything.
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 10000);
}

TEST(artifact_fuzz, noise_is_refused) {
  Fuzzer fuzzer(2);
  for (int round = 0; round < 5000; ++round) {
    std::string bytes(fuzzer.below(300), '\0');
    for (char& byte : bytes) byte = static_cast<char>(fuzzer.below(256));
    if (bytes.size() > 64) bytes.replace(0, 8, std::string("\x38\0\0\0\0\0\0\0", 8));
    EXPECT_FALSE(accepts(bytes)) << round;
  }
}

TEST(canonical_json_fuzz, canonical_text_is_a_fixed_point) {
  Fuzzer fuzzer(3);
  int valid = 0;
  for (int round = 0; round < 30000; ++round) {
    std::string text = R"({"a":[1,2.5e-7,-0.0,"\u00e9\n"],"b":{"c":null,"a":true},"z":18446744073709551615})";
    for (std::size_t i = fuzzer.below(3) + 1; i > 0; --i) fuzzer.mutate(text);
    try {
      const std::string once = canonical_json(text, ExitCode::usage);
      EXPECT_EQ(canonical_json(once, ExitCode::usage), once) << text;
      ++valid;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(valid, 500);
}

}  // namespace ballflow
