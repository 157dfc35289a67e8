#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "ballflow/error.hpp"
#include "ballflow/store.hpp"
#include "faulty_file_system.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

class FileDigestTest : public ::testing::Test {
 protected:
  FileDigestTest() { test::write_file(input, content); }

  std::string failure(const std::string& path) const {
    try {
      store->file_digest(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::store);
      EXPECT_FALSE(error.hint().empty());
      return error.what();
    }
    return "no failure";
  }

  /// Whether the digest was taken without reading the file (a memo is read in one call, a file in two).
  bool memoised(const Digest& expected) {
    files->reset_counts();
    EXPECT_EQ(store->file_digest(input), expected);
    return files->count("read") == 1;
  }

  const test::TempFolder folder;
  const std::string input = folder.file("an input file");
  const std::string content = std::string(100, 'a');
  const std::shared_ptr<test::FaultyFileSystem> files = std::make_shared<test::FaultyFileSystem>();
  const std::shared_ptr<Store> store = Store::open({folder.file("cache")}, files);
};

constexpr std::int64_t ten_seconds = 10'000'000'000;

}  // namespace

TEST_F(FileDigestTest, a_young_file_is_read_every_time) {
  EXPECT_FALSE(memoised(sha256(content)));
  EXPECT_FALSE(memoised(sha256(content)));
  EXPECT_EQ(files->count("write"), 0);
}

TEST_F(FileDigestTest, an_old_file_is_read_once) {
  files->clock_offset = ten_seconds;
  EXPECT_FALSE(memoised(sha256(content)));
  EXPECT_TRUE(memoised(sha256(content)));
  const auto other = Store::open({store->root()}, files);
  files->reset_counts();
  EXPECT_EQ(other->file_digest(input), sha256(content));
  EXPECT_EQ(files->count("read"), 1);
}

TEST_F(FileDigestTest, a_memo_is_not_trusted_while_the_file_is_young) {
  files->clock_offset = ten_seconds;
  store->file_digest(input);
  files->clock_offset = 0;
  files->reset_counts();
  EXPECT_EQ(store->file_digest(input), sha256(content));
  EXPECT_EQ(files->count("open"), 1) << "the file, not the memo";
}

TEST_F(FileDigestTest, a_file_from_the_future_is_never_memoised) {
  files->clock_offset = -ten_seconds;
  EXPECT_FALSE(memoised(sha256(content)));
  EXPECT_FALSE(memoised(sha256(content)));
}

TEST_F(FileDigestTest, a_change_with_restored_size_and_time_is_noticed) {
  struct stat before {};
  ASSERT_EQ(::stat(input.c_str(), &before), 0);
  files->clock_offset = ten_seconds;
  store->file_digest(input);
  const std::string other(100, 'b');
  {
    std::fstream file(input, std::ios::in | std::ios::out | std::ios::binary);
    file << other;
  }
  const timespec times[2] = {before.st_atim, before.st_mtim};
  ASSERT_EQ(::utimensat(AT_FDCWD, input.c_str(), times, 0), 0);
  EXPECT_EQ(store->file_digest(input), sha256(other));
}

TEST_F(FileDigestTest, a_replaced_file_is_noticed) {
  files->clock_offset = ten_seconds;
  store->file_digest(input);
  test::write_file(folder.file("new"), "new content");
  fs::rename(folder.file("new"), input);
  EXPECT_EQ(store->file_digest(input), sha256("new content"));
}

TEST_F(FileDigestTest, links_to_input_files_are_followed) {
  fs::create_symlink(input, folder.file("link"));
  EXPECT_EQ(store->file_digest(folder.file("link")), sha256(content));
}

TEST_F(FileDigestTest, an_empty_and_a_long_file_are_read_to_the_end) {
  test::write_file(folder.file("empty"), "");
  EXPECT_EQ(store->file_digest(folder.file("empty")), sha256(""));
  const std::string longer((1 << 20) + 17, 'x');
  test::write_file(folder.file("long"), longer);
  EXPECT_EQ(store->file_digest(folder.file("long")), sha256(longer));
}

TEST_F(FileDigestTest, what_is_no_readable_file_is_named) {
  EXPECT_NE(failure(folder.file("absent")).find("absent: No such file"), std::string::npos);
  EXPECT_NE(failure(folder.path()).find("is a directory"), std::string::npos);
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_NE(failure(folder.file("pipe")).find("not a regular file"), std::string::npos);
  files->fault = [](const std::string& call) { return call == "read" ? -EIO : 0; };
  EXPECT_NE(failure(input).find("Input/output error"), std::string::npos);
}

TEST_F(FileDigestTest, a_file_that_changes_once_is_read_again) {
  bool changed = false;
  files->before_read = [&] {
    if (!changed) std::ofstream(input, std::ios::app) << "more";
    changed = true;
  };
  EXPECT_EQ(store->file_digest(input), sha256(content + "more"));
}

TEST_F(FileDigestTest, a_file_that_keeps_changing_is_an_error) {
  files->before_read = [&] { std::ofstream(input, std::ios::app) << "more"; };
  EXPECT_NE(failure(input).find("changes while"), std::string::npos);
}

}  // namespace ballflow
