#include "ballflow/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <regex>
#include <set>

#include "ballflow/error.hpp"
#include "base/draft.hpp"
#include "faulty_file_system.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using test::FaultyFileSystem;

/// Notes what is opened and how, and may put something in the way first.
class WatchedFileSystem final : public FaultyFileSystem {
 public:
  struct Opened {
    int folder;
    std::string name;
    int flags;
  };
  std::vector<Opened> made;  // with O_CREAT
  std::function<void(const std::string& name)> before_making;

  int open(int folder, const std::string& name, int flags, mode_t mode) override {
    if ((flags & O_CREAT) != 0) {
      made.push_back({folder, name, flags});
      if (before_making) before_making(name);
    }
    return FaultyFileSystem::open(folder, name, flags, mode);
  }
};

class OutputFileTest : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder.path())) found.push_back(entry.path().filename());
    return found;
  }
  /// What a writer of `content` throws; empty when it writes.
  std::string failure(const std::string& named, const std::string& content) const {
    try {
      OutputFile file(named, files);
      file << content;
      file.commit();
      return {};
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::store);
      EXPECT_FALSE(error.hint().empty());
      return error.what();
    }
  }

  const test::TempFolder folder;
  const std::string path = folder.file("result.ply");
  const std::shared_ptr<WatchedFileSystem> files = std::make_shared<WatchedFileSystem>();
};

}  // namespace

TEST_F(OutputFileTest, readers_see_the_old_or_the_new_content) {
  test::write_file(path, "old");
  OutputFile file(path, files);
  file << std::string_view("new ") << 17 << ' ' << 0.1;
  file.raw(std::uint16_t{0x4142});
  EXPECT_EQ(test::read_file(path), "old");
  file.commit();
  EXPECT_EQ(test::read_file(path), "new 17 0.1BA");
  EXPECT_EQ(names(), std::vector<std::string>{"result.ply"});
}

TEST_F(OutputFileTest, without_a_commit_nothing_has_happened) {
  test::write_file(path, "old");
  {
    OutputFile file(path, files);
    file << std::string(200'000, 'x');
    EXPECT_EQ(names().size(), 2u);
  }
  EXPECT_EQ(test::read_file(path), "old");
  EXPECT_EQ(names().size(), 1u);
}

TEST_F(OutputFileTest, the_temporary_name_has_host_and_randomness_and_is_made_exclusively) {
  const std::string machine = files->machine(), host = machine.substr(0, machine.rfind('-'));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(failure(path, "x"), "");
  ASSERT_EQ(files->made.size(), 3u);
  std::set<std::string> different;
  for (const auto& opened : files->made) {
    EXPECT_EQ(opened.name.rfind("result.ply.tmp-" + host.substr(0, 64) + "-", 0), 0u) << opened.name;
    EXPECT_TRUE(std::regex_search(opened.name, std::regex("-[0-9a-f]{16}$"))) << opened.name;
    EXPECT_EQ(opened.flags & (O_EXCL | O_NOFOLLOW), O_EXCL | O_NOFOLLOW);
    different.insert(opened.name);
  }
  EXPECT_EQ(different.size(), 3u);
}

TEST_F(OutputFileTest, what_lies_under_the_temporary_name_is_neither_followed_nor_changed) {
  const std::string victim = folder.file("victim");
  test::write_file(victim, "precious");
  int planted = 0;
  files->before_making = [&](const std::string& name) {
    if (++planted <= 2) fs::create_symlink(victim, folder.file(name));
  };
  EXPECT_EQ(failure(path, "content"), "") << "another name is taken";
  EXPECT_EQ(planted, 3);
  EXPECT_EQ(test::read_file(victim), "precious");
  EXPECT_EQ(test::read_file(path), "content");
  EXPECT_FALSE(fs::is_symlink(path));

  files->before_making = [&](const std::string& name) { fs::create_symlink(victim, folder.file(name)); };
  EXPECT_NE(failure(path, "again").find("File exists"), std::string::npos);
  EXPECT_EQ(test::read_file(victim), "precious");
  EXPECT_EQ(test::read_file(path), "content");
}

TEST_F(OutputFileTest, a_link_keeps_pointing_at_what_is_replaced) {
  fs::create_directory(folder.file("elsewhere"));
  const std::string real = folder.file("elsewhere/real");
  test::write_file(real, "old");
  fs::create_symlink("elsewhere/real", path);
  EXPECT_EQ(failure(path, "new"), "");
  EXPECT_TRUE(fs::is_symlink(path));
  EXPECT_EQ(test::read_file(real), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.file("elsewhere")), fs::directory_iterator()), 1);
}

TEST_F(OutputFileTest, pipes_and_devices_are_written_as_they_are) {
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  EXPECT_EQ(failure(path, "through the pipe"), "");
  std::array<char, 64> text{};
  EXPECT_EQ(::read(reader, text.data(), text.size()), 16);
  EXPECT_STREQ(text.data(), "through the pipe");
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(path));
  EXPECT_EQ(failure("/dev/null", "x"), "");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(files->made.empty());
}

TEST_F(OutputFileTest, a_name_as_long_as_names_get_works) {
  const std::string longest = folder.file(std::string(255, 'n'));
  EXPECT_EQ(failure(longest, "x"), "");
  EXPECT_EQ(test::read_file(longest), "x");
}

TEST_F(OutputFileTest, refusals_name_the_file_and_leave_nothing) {
  EXPECT_NE(failure(folder.file("missing/file"), "x").find("missing/file: No such file"), std::string::npos);
  EXPECT_NE(failure(folder.path(), "x").find("Is a directory"), std::string::npos);
  EXPECT_NE(failure(folder.path() + "/", "x").find("Is a directory"), std::string::npos);
  EXPECT_NE(failure("", "x"), "");
  test::write_file(path, "old");
  for (const char* failing : {"write", "close", "rename_replace"}) {
    files->fault = [&](const std::string& call) { return call == failing ? -ENOSPC : 0; };
    EXPECT_NE(failure(path, "new").find("No space left on device"), std::string::npos) << failing;
    files->fault = {};
    EXPECT_EQ(test::read_file(path), "old") << failing;
    EXPECT_EQ(names().size(), 1u) << failing;
  }
  files->write_at_most = 3;
  EXPECT_EQ(failure(path, "in many small pieces"), "");
  EXPECT_EQ(test::read_file(path), "in many small pieces");
}

TEST_F(OutputFileTest, a_draft_that_must_not_replace_does_not_whatever_the_file_system_can) {
  // rename without replacing, else a second name, else a look before
  for (const int missing : {0, 1, 2}) {
    files->fault = [&](const std::string& call) {
      return call == "rename" && missing > 0 ? -EINVAL : call == "link" && missing > 1 ? -EPERM : 0;
    };
    const test::TempFolder place;
    const OpenFile open(*files, files->open(FileSystem::working_folder, place.path(), folder_flags, 0));
    const auto publish = [&](const std::string& text, bool replace) {
      Draft draft(*files, open.get(), "draft", 0644);
      EXPECT_EQ(draft.made(), 0);
      EXPECT_EQ(draft.write(std::as_bytes(std::span(text))), 0);
      return draft.publish(open.get(), "file", replace);
    };
    EXPECT_EQ(publish("first", false), 0) << missing;
    EXPECT_EQ(publish("second", false), -EEXIST) << missing;
    EXPECT_EQ(test::read_file(place.file("file")), "first") << missing;
    EXPECT_EQ(publish("third", true), 0) << missing;
    EXPECT_EQ(test::read_file(place.file("file")), "third") << missing;
    EXPECT_EQ(std::distance(fs::directory_iterator(place.path()), fs::directory_iterator()), 1) << missing;
  }
}

}  // namespace ballflow
