#include "ballflow/artifact.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "ballflow/error.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using test::array_of;

/// A file of the layout from its parts, for files that seal() would not write.
std::string file_of(std::string header, const std::string& data) {
  header.resize((header.size() + 8 + 63) / 64 * 64 - 8, ' ');
  std::string file(8, '\0');
  for (std::size_t i = 0; i < 8; ++i) file[i] = static_cast<char>(header.size() >> (8 * i) & 0xff);
  return file + header + data;
}

ArtifactPtr decode(const std::string& bytes) {
  const auto copy = std::make_shared<std::vector<std::byte>>(bytes.size());
  if (!bytes.empty()) std::memcpy(copy->data(), bytes.data(), bytes.size());
  return Artifact::decode(*copy, copy);
}

std::string refusal(const std::string& bytes) {
  try {
    decode(bytes);
  } catch (const BadArtifact& error) {
    EXPECT_EQ(error.code(), ExitCode::store);
    return error.what();
  }
  return "accepted";
}

const std::string meta = R"("__metadata__":{"ballflow":"1","summary":"{}","type":"T","version":"1"})";

std::string with_arrays(const std::string& arrays) { return "{" + meta + "," + arrays + "}"; }

std::string seal_failure(std::vector<NamedArray> arrays, const std::string& summary = "{}",
                         const std::string& type = "T") {
  try {
    Artifact::seal(type, 1, std::move(arrays), summary, nullptr);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    return error.what();
  }
  return "sealed";
}

const std::vector<double> reals{1.0, -2.5};
const std::vector<std::uint8_t> bytes3{1, 2, 3};
const std::vector<std::int32_t> seven{7};

TEST(artifact, hashing_can_be_given_up_and_done_again) {
  const std::vector<double> values(4'000'000, 1.5);
  const auto sealed =
      Artifact::seal("Numbers", 1, {{"values", BF_F64, {values.size()}, values.data()}}, "{}", nullptr);
  int looks = 0;
  EXPECT_FALSE(sealed->hash([&] { return ++looks == 2; }));
  EXPECT_EQ(looks, 2);
  EXPECT_TRUE(sealed->hash([] { return false; }));
  Hasher hasher;
  for (const auto& piece : sealed->pieces()) hasher.add(piece.data(), piece.size());
  EXPECT_EQ(sealed->digest(), hasher.finish());
  EXPECT_TRUE(sealed->hash([] { return true; })) << "it is known already";
}

TEST(artifact, gives_the_same_sums_whichever_is_asked_for_first_and_in_several_threads) {
  const std::vector<double> values(100'000, 1.5);
  const auto sealed = [&] {
    return Artifact::seal("Numbers", 1, {{"values", BF_F64, {values.size()}, values.data()}}, "{}", nullptr);
  };
  const auto digest_first = sealed(), checksum_first = sealed(), both = sealed();
  const Digest digest = digest_first->digest();
  const Checksum checksum = checksum_first->checksum();
  EXPECT_TRUE(digest_first->checksum() == checksum);
  EXPECT_TRUE(checksum_first->digest() == digest);
  Hasher hasher;
  for (const auto& piece : both->pieces()) hasher.add(piece.data(), piece.size());
  EXPECT_TRUE(hasher.finish() == digest);
  std::thread other([&] { EXPECT_TRUE(both->digest() == digest); });
  EXPECT_TRUE(both->checksum() == checksum);
  other.join();
}

}  // namespace

TEST(artifact, file_is_exactly_the_documented_layout) {
  const auto artifact =
      Artifact::seal("Probe", 3,
                     {array_of("b", BF_U8, {3}, bytes3), array_of("n", BF_I32, {}, seven),
                      array_of("a", BF_F64, {2, 1}, reals)},
                     "{ \"count\":2, \"box\" :[0.50, 1.0], \"name\":\"\\u00e9\\\"\" }", nullptr);
  // Doubles by hand: 1.0 and -2.5 as IEEE 754, little-endian.
  const std::string data = std::string("\0\0\0\0\0\0\xf0\x3f", 8) + std::string("\0\0\0\0\0\0\x04\xc0", 8) +
                           std::string("\x07\0\0\0", 4) + "\x01\x02\x03";
  const std::string expected = file_of(
      R"({"__metadata__":{"ballflow":"1","summary":"{\"box\":[0.5,1],\"count\":2,\"name\":\"é\\\"\"}",)"
      R"("type":"Probe","version":"3"},)"
      R"("a":{"dtype":"F64","shape":[2,1],"data_offsets":[0,16]},)"
      R"("b":{"dtype":"U8","shape":[3],"data_offsets":[20,23]},)"
      R"("n":{"dtype":"I32","shape":[],"data_offsets":[16,20]}})",
      data);
  EXPECT_EQ(test::file_bytes(*artifact), expected);
  EXPECT_EQ(artifact->file_size(), expected.size());
  EXPECT_EQ(artifact->digest(), sha256(expected));
  EXPECT_EQ(artifact->checksum(), checksum_of(expected.data(), expected.size()));
}

TEST(artifact, bytes_do_not_depend_on_the_order_of_arrays_and_keys) {
  std::vector<NamedArray> arrays{array_of("a", BF_F64, {2}, reals), array_of("b", BF_U8, {3}, bytes3),
                                 array_of("c", BF_F64, {2}, reals), array_of("n", BF_I32, {}, seven)};
  const std::string expected =
      test::file_bytes(*Artifact::seal("T", 1, arrays, R"({"x":{"b":1,"a":2},"y":3})", nullptr));
  std::sort(arrays.begin(), arrays.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  do {
    EXPECT_EQ(test::file_bytes(*Artifact::seal("T", 1, arrays, R"({"y":3,"x":{"a":2,"b":1}})", nullptr)),
              expected);
  } while (std::next_permutation(arrays.begin(), arrays.end(),
                                 [](const auto& a, const auto& b) { return a.name < b.name; }));
}

TEST(artifact, every_part_changes_the_digest) {
  const auto digest = [](const std::string& type, int version, NamedArray array, const std::string& summary) {
    return Artifact::seal(type, version, {std::move(array)}, summary, nullptr)->digest();
  };
  const std::vector<double> other{1.0, -2.25};
  const std::vector<Digest> digests{digest("T", 1, array_of("a", BF_F64, {2}, reals), "{}"),
                                    digest("U", 1, array_of("a", BF_F64, {2}, reals), "{}"),
                                    digest("T", 2, array_of("a", BF_F64, {2}, reals), "{}"),
                                    digest("T", 1, array_of("b", BF_F64, {2}, reals), "{}"),
                                    digest("T", 1, array_of("a", BF_I64, {2}, reals), "{}"),
                                    digest("T", 1, array_of("a", BF_F64, {1, 2}, reals), "{}"),
                                    digest("T", 1, array_of("a", BF_F64, {2}, other), "{}"),
                                    digest("T", 1, array_of("a", BF_F64, {2}, reals), R"({"n":1})")};
  for (std::size_t i = 0; i < digests.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(digests[i], digests[j]) << i << ' ' << j;
  }
}

TEST(artifact, data_and_every_array_are_aligned) {
  std::vector<NamedArray> arrays;
  const std::vector<std::uint64_t> storage(8);
  for (const std::uint32_t dtype : {BF_U8, BF_U16, BF_I32, BF_F32, BF_U32, BF_I64, BF_F64}) {
    arrays.push_back({"array" + std::to_string(dtype), dtype, {3}, storage.data()});
  }
  for (std::size_t extra = 0; extra < 70; ++extra) {  // every length of the header modulo 64
    const std::string summary = R"({"t":")" + std::string(extra, 'x') + "\"}";
    const ArtifactPtr artifact = decode(test::file_bytes(*Artifact::seal("T", 1, arrays, summary, nullptr)));
    EXPECT_EQ(artifact->pieces().front().size() % 64, 0u);
    for (const NamedArray& array : artifact->arrays()) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data) % dtype_size(array.dtype), 0u) << array.name;
    }
  }
}

TEST(artifact, empty_arrays_and_single_numbers_read_back) {
  const auto sealed = Artifact::seal("T", 0,
                                     {{"none", BF_F64, {0, 3}, nullptr},
                                      {"void", BF_U8, {5, 0, 1u << 31, 1u << 31}, nullptr},
                                      array_of("n", BF_I32, {}, seven)},
                                     "{}", nullptr);
  const ArtifactPtr read = decode(test::file_bytes(*sealed));
  ASSERT_EQ(read->arrays().size(), 3u);
  EXPECT_EQ(read->find("none")->elements(), 0u);
  EXPECT_EQ(read->find("none")->shape, (std::vector<std::uint64_t>{0, 3}));
  EXPECT_EQ(read->find("void")->bytes(), 0u);
  EXPECT_EQ(read->find("n")->elements(), 1u);
  EXPECT_EQ(*static_cast<const std::int32_t*>(read->find("n")->data), 7);
  EXPECT_EQ(read->find("absent"), nullptr);

  const auto nothing = Artifact::seal("T", 1, {}, "{}", nullptr);
  EXPECT_TRUE(decode(test::file_bytes(*nothing))->arrays().empty());
}

TEST(artifact, decoding_gives_back_what_was_sealed) {
  const ArtifactPtr sealed = test::make_probe(5, 1000);
  const ArtifactPtr read = decode(test::file_bytes(*sealed));
  EXPECT_EQ(read->type(), "Probe");
  EXPECT_EQ(read->version(), 1);
  EXPECT_EQ(read->summary(), R"({"seed":5})");
  EXPECT_EQ(read->digest(), sealed->digest());
  EXPECT_EQ(read->checksum(), sealed->checksum());
  EXPECT_TRUE(test::same(*read, *sealed));
}

TEST(artifact, sealing_copies_no_data_and_keeps_its_owner) {
  auto owner = std::make_shared<std::vector<double>>(reals);
  const std::weak_ptr<std::vector<double>> watch = owner;
  const double* const data = owner->data();
  ArtifactPtr artifact = Artifact::seal("T", 1, {array_of("a", BF_F64, {2}, *owner)}, "{}", owner);
  owner.reset();
  EXPECT_FALSE(watch.expired());
  EXPECT_EQ(artifact->find("a")->data, data);
  artifact.reset();
  EXPECT_TRUE(watch.expired());
}

TEST(artifact, mapping_copies_no_data_and_survives_deletion) {
  const test::TempFolder folder;
  const ArtifactPtr sealed = test::make_probe(9, 5000);
  const std::string path = folder.file("a file with spaces");
  test::write_file(path, test::file_bytes(*sealed));
  const ArtifactPtr mapped = Artifact::map(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(test::same(*mapped, *sealed));
  // In a mapping, places in memory and in the file agree modulo the page size.
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto* const values = static_cast<const char*>(mapped->find("values")->data);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values) % page, mapped->pieces().front().size() % page);
  EXPECT_EQ(mapped->find("flags")->data, values + mapped->find("values")->bytes());
}

TEST(artifact, mapping_names_the_file_that_is_no_artifact) {
  const test::TempFolder folder;
  const auto failure = [](const std::string& path) -> std::string {
    try {
      Artifact::map(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::store);
      return error.what();
    }
    return "mapped";
  };
  test::write_file(folder.file("empty"), "");
  test::write_file(folder.file("text"), "solid cube\nfacet normal 0 0 1\n");
  EXPECT_NE(failure(folder.file("absent")).find("absent"), std::string::npos);
  EXPECT_NE(failure(folder.path()).find("not a regular file"), std::string::npos);
  EXPECT_NE(failure(folder.file("empty")).find("0 bytes"), std::string::npos);
  EXPECT_NE(failure(folder.file("text")).find("more than 16 MB"), std::string::npos);
}

TEST(artifact, sealing_refuses_what_no_reader_would_accept) {
  const auto a = array_of("a", BF_F64, {2}, reals);
  EXPECT_NE(seal_failure({a, a}).find("array a occurs twice"), std::string::npos);
  EXPECT_NE(seal_failure({{"a", 99, {2}, reals.data()}}).find("unknown element type 99"), std::string::npos);
  EXPECT_NE(seal_failure({{"a", BF_F64, {1, 1, 1, 1, 1}, reals.data()}}).find("rank 5"), std::string::npos);
  EXPECT_NE(seal_failure({{"a", BF_F64, {1ull << 62}, reals.data()}}).find("size overflows"),
            std::string::npos);
  EXPECT_NE(seal_failure({{"a", BF_U8, {1ull << 63}, reals.data()}}).find("overflows"), std::string::npos);
  EXPECT_NE(seal_failure({{"a", BF_U8, {1ull << 62}, reals.data()}, {"b", BF_U8, {1ull << 62}, reals.data()}})
                .find("overflows"),
            std::string::npos);
  EXPECT_NE(seal_failure({{"a", BF_F64, {2}, nullptr}}).find("no data"), std::string::npos);
  EXPECT_NE(seal_failure({{"", BF_F64, {2}, reals.data()}}).find("array name"), std::string::npos);
  EXPECT_NE(seal_failure({{"a\"b", BF_F64, {2}, reals.data()}}).find("array name"), std::string::npos);
  EXPECT_NE(seal_failure({{"\xff", BF_F64, {2}, reals.data()}}).find("array name"), std::string::npos);
  EXPECT_NE(seal_failure({{"__metadata__", BF_F64, {2}, reals.data()}}).find("reserved"), std::string::npos);
  EXPECT_NE(seal_failure({a}, "{}", "").find("type name"), std::string::npos);
  EXPECT_NE(seal_failure({a}, "[]").find("not a JSON object"), std::string::npos);
  EXPECT_NE(seal_failure({a}, "{").find("not valid JSON"), std::string::npos);
  EXPECT_NE(seal_failure({a}, R"({"t":")" + std::string(17 << 20, 'x') + "\"}").find("16 MB"),
            std::string::npos);
  EXPECT_EQ(seal_failure({a}), "sealed");
}

TEST(artifact, decoding_says_what_is_wrong) {
  const std::string eight(8, '\0');
  const std::string good = R"("a":{"dtype":"F64","shape":[1],"data_offsets":[0,8]})";
  ASSERT_EQ(refusal(file_of(with_arrays(good), eight)), "accepted");
  const std::vector<std::tuple<std::string, std::string, std::string>> cases{
      {"[]", "", "not a JSON object"},
      {"{", "", "not valid JSON"},
      {R"({"a":1})", "", "has no __metadata__"},
      {R"({"__metadata__":{}})", "", "__metadata__ is not"},
      {R"({"__metadata__":{"ballflow":"2","summary":"{}","type":"T","version":"1"}})", "",
       "format version \"2\""},
      {R"({"__metadata__":{"ballflow":1,"summary":"{}","type":"T","version":"1"}})", "",
       "ballflow is not a string"},
      {R"({"__metadata__":{"ballflow":"1","summary":"{}","type":"T","version":"1x"}})", "", "version \"1x\""},
      {R"({"__metadata__":{"ballflow":"1","summary":"{}","type":"T","version":"-1"}})", "", "negative"},
      {R"({"__metadata__":{"ballflow":"1","summary":"{}","type":"T","version":"99999999999"}})", "",
       "not a number"},
      {R"({"__metadata__":{"ballflow":"1","summary":"{","type":"T","version":"1"}})", "",
       "summary: not valid JSON"},
      {R"({"__metadata__":{"ballflow":"1","summary":"3","type":"T","version":"1"}})", "",
       "summary is not a JSON object"},
      {R"({"__metadata__":{"ballflow":"1","summary":"{ }","type":"T","version":"1"}})", "",
       "summary is not in canonical"},
      {R"({"__metadata__":{"ballflow":"1","summary":"{}","type":"","version":"1"}})", "", "type name"},
      {with_arrays(good + "," + good), eight, "key \"a\" twice"},
      {with_arrays(R"("a":7)"), eight, "array \"a\" is not"},
      {with_arrays(R"("a":{"dtype":"BF16","shape":[1],"data_offsets":[0,8]})"), eight,
       "unknown dtype \"BF16\""},
      {with_arrays(R"("a":{"dtype":8,"shape":[1],"data_offsets":[0,8]})"), eight, "unknown dtype"},
      {with_arrays(R"("a":{"dtype":"F64","shape":1,"data_offsets":[0,8]})"), eight, "shape is not a list"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[-1],"data_offsets":[0,8]})"), eight,
       "not an unsigned integer"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1.0],"data_offsets":[0,8]})"), eight,
       "not an unsigned integer"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1,1,1,1,1],"data_offsets":[0,8]})"), eight, "rank 5"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[4294967296,4294967296],"data_offsets":[0,8]})"), eight,
       "overflows"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[2305843009213693953],"data_offsets":[0,8]})"), eight,
       "overflows"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[8]})"), eight, "data_offsets is not"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[8,0]})"), eight, "run backwards"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[0,7]})"), eight, "its shape needs 8"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[8,16]})"), eight, "ends at 16"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[18446744073709551608,0]})"), eight,
       "run backwards"},
      {with_arrays(
           R"("a":{"dtype":"F64","shape":[1],"data_offsets":[18446744073709551600,18446744073709551608]})"),
       eight, "ends at"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[4,12]})"), std::string(12, '\0'),
       "misaligned"},
      {with_arrays(R"("a":{"dtype":"F64","shape":[1],"data_offsets":[8,16]})"), std::string(16, '\0'),
       "hole in the data"},
      {with_arrays(good), std::string(9, '\0'), "1 bytes of data belong to no array"},
      {with_arrays(good + R"(,"b":{"dtype":"F64","shape":[1],"data_offsets":[0,8]})"), eight, "overlaps"},
      {with_arrays(R"("b":{"dtype":"U8","shape":[8],"data_offsets":[0,8]},)"
                   R"("c":{"dtype":"F64","shape":[1],"data_offsets":[8,16]})"),
       std::string(16, '\0'), "not in canonical form"},
      {with_arrays(R"("a": {"dtype":"F64","shape":[1],"data_offsets":[0,8]})"), eight,
       "not in canonical form"},
      {with_arrays(R"("\u0061":{"dtype":"F64","shape":[1],"data_offsets":[0,8]})"), eight,
       "not in canonical form"},
      {"{" + good + "," + meta + "}", eight, "not in canonical form"}};
  for (const auto& [header, data, expected] : cases) {
    const std::string text = refusal(file_of(header, data));
    EXPECT_NE(text.find(expected), std::string::npos) << header << "\n  " << text;
  }
}

TEST(artifact, decoding_refuses_padding_that_is_not_minimal) {
  const std::string file = test::file_bytes(*Artifact::seal("T", 1, {}, "{}", nullptr));
  std::string longer = file + std::string(64, ' ');
  longer[0] = static_cast<char>(longer[0] + 64);
  EXPECT_NE(refusal(longer).find("not in canonical form"), std::string::npos);
}

TEST(artifact, decoding_refuses_headers_beyond_the_file_or_the_limit) {
  EXPECT_NE(refusal("").find("too few"), std::string::npos);
  EXPECT_NE(refusal("1234567").find("too few"), std::string::npos);
  EXPECT_NE(refusal(std::string("\x10\0\0\0\0\0\0\0", 8) + "{}").find("claims 16 bytes"), std::string::npos);
  EXPECT_NE(refusal(std::string(8, '\xff') + "{}").find("more than 16 MB"), std::string::npos);
}

TEST(artifact, deep_nesting_is_refused_before_it_costs_the_stack) {
  const std::string deep(8 << 20, '[');
  EXPECT_NE(refusal(file_of(deep, "")).find("nests deeper"), std::string::npos);
  EXPECT_NE(refusal(file_of(R"({"a":)" + deep, "")).find("nests deeper"), std::string::npos);
  EXPECT_NE(refusal(file_of(R"({"__metadata__":{"ballflow":"1","summary":")" + deep +
                                R"(","type":"T","version":"1"}})",
                            ""))
                .find("nests deeper"),
            std::string::npos);
  EXPECT_NE(seal_failure({}, R"({"a":)" + deep).find("nests deeper"), std::string::npos);
}

TEST(artifact, memory_that_is_not_aligned_is_refused) {
  const std::string file = test::file_bytes(*test::make_probe(1));
  std::vector<std::uint64_t> memory(file.size() / 8 + 2);
  char* const odd = reinterpret_cast<char*>(memory.data()) + 4;
  std::memcpy(odd, file.data(), file.size());
  EXPECT_THROW(Artifact::decode(std::as_bytes(std::span(odd, file.size())), nullptr), BadArtifact);
}

TEST(artifact, every_truncation_is_refused) {
  const std::string file = test::file_bytes(*test::make_probe(3));
  for (std::size_t size = 0; size < file.size(); ++size)
    EXPECT_NE(refusal(file.substr(0, size)), "accepted") << size;
}

}  // namespace ballflow
