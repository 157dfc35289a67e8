#include "io/file_content.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "mesh_files.hpp"
#include "test_data.hpp"
#include "zstd_files.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t limit = 1 << 20;

std::string content_of(const std::string& bytes) {
  const test::TempFolder folder;
  test::write_file(folder.file("a"), bytes);
  return std::string(read_file_content(folder.file("a"), limit).view());
}

std::string refusal(const std::string& bytes) {
  try {
    content_of(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string mark = "\xef\xbb\xbf";

/// Text as UTF-16 with the low byte at place `low` of each pair.
std::string wide(const std::string& text, std::size_t low) {
  std::string result;
  for (const char c : text) {
    result += low == 0 ? c : '\0';
    result += low == 0 ? '\0' : c;
  }
  return result;
}

TEST(file_content, leaves_out_a_byte_order_mark_before_text) {
  EXPECT_EQ(content_of(mark + "v 1 2 3\n"), "v 1 2 3\n");
  EXPECT_EQ(content_of(test::gzipped(mark + "v 1 2 3\n")), "v 1 2 3\n");
  EXPECT_EQ(content_of("v 1 " + mark), "v 1 " + mark) << "only at the beginning";
  const std::string ply = "ply\nformat binary_little_endian 1.0\n" + std::string(9, '\0');
  EXPECT_EQ(content_of(mark + ply), ply);
  // The header of a binary STL file.
  const std::string binary = mark + std::string(81, '\0') + "\n";
  EXPECT_EQ(content_of(binary), binary);
  EXPECT_NE(refusal(mark).find("is empty"), std::string::npos);
}

TEST(file_content, refuses_text_of_two_or_four_bytes_a_character) {
  const std::string text = "OFF\r\n4 4 6\r\n0 0 0\r\n";
  for (const std::string& bytes :
       {"\xff\xfe" + wide(text, 0), "\xfe\xff" + wide(text, 1), wide(text, 0), wide(text, 1)}) {
    EXPECT_NE(refusal(bytes).find("is in UTF-16\nsave it as UTF-8"), std::string::npos) << refusal(bytes);
  }
  EXPECT_NE(refusal(std::string("\xff\xfe\0\0", 4) + wide(wide(text, 0), 0)).find("is in UTF-32"),
            std::string::npos);
  // A binary file may begin so.
  EXPECT_EQ(refusal("\xff\xfe" + std::string(78, '\0') + "\1\2\3\4"), "");
}

TEST(file_content, unpacks_gzip_and_zstd_whatever_the_name_says) {
  const std::string text = test::as_off(test::small_mesh());
  EXPECT_EQ(content_of(test::gzipped(text)), text);
  EXPECT_EQ(content_of(test::zstd_packed(text)), text);
  EXPECT_EQ(content_of(test::zstd_packed(text) + test::zstd_packed("tail")), text + "tail");
  const std::string zeros(limit, 'x');
  EXPECT_EQ(content_of(test::zstd_packed(zeros)), zeros);
  EXPECT_NE(refusal(test::zstd_packed(zeros + "x")).find("unpacks to more than 1048576 bytes"),
            std::string::npos);
}

TEST(file_content, refuses_zstd_streams_that_are_damaged_or_cut_off) {
  const std::string packed = test::zstd_packed(test::as_off(test::small_mesh()));
  for (std::size_t size = 4; size < packed.size(); size += 7) {
    EXPECT_NE(refusal(packed.substr(0, size)).find("is cut off"), std::string::npos) << size;
  }
  std::string damaged = packed;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);  // of the checksum
  EXPECT_NE(refusal(damaged).find("is damaged"), std::string::npos);
  EXPECT_NE(refusal(packed + "more").find("is damaged"), std::string::npos);
  EXPECT_NE(refusal(test::zstd_packed("")).find("is empty when unpacked"), std::string::npos);
}

TEST(file_content, names_packers_that_are_not_unpacked) {
  EXPECT_NE(refusal("BZh91AY&SY").find("packed with bzip2\nunpack it first"), std::string::npos);
  EXPECT_NE(refusal(std::string("\xfd\x37zXZ\0", 6)).find("packed with xz"), std::string::npos);
  EXPECT_NE(refusal("PK\x03\x04 a.off").find("packed with ZIP"), std::string::npos);
  EXPECT_NE(refusal("PK\x03\x04 3D/3dmodel.model").find("is a 3MF model"), std::string::npos);
  EXPECT_NE(refusal("7z\xbc\xaf\x27\x1c").find("packed with 7z"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
