// The scaffold of node libraries: what it refuses and what it writes. That it builds and runs is tested
// against an installation (tests/plugin/installed).
#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct NewNodeTest : testing::Test {
  test::ProcessResult new_node(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {test::binary_file("bin/ballflow"), "new-node"});
    return test::run_process(arguments);
  }
  void expect_refused(const std::string& id, const std::string& why) {
    const auto result = new_node({id, "--dir", folder.file("refused")});
    EXPECT_EQ(result.exit_code, 2) << id;
    EXPECT_NE(result.err.find(why), std::string::npos) << id << ": " << result.err;
    EXPECT_FALSE(fs::exists(folder.file("refused"))) << id;
  }
  test::TempFolder folder;
};

TEST_F(NewNodeTest, refuses_ids_that_no_node_of_a_stranger_can_have) {
  expect_refused("Offset", "ids without a namespace belong to ballflow");
  expect_refused("acme.offset", "does not begin with a capital letter");
  for (const char* id :
       {"", ".", "acme.", ".Offset", "acme..Offset", "2d.Offset", "acme.Off-set", "acme/Offset",
        "../acme.Offset", "acme.Of fset", "acme.Offs\xc3\xa4t", "acme.Offset;rm"})
    expect_refused(id, "it is made of letters, digits, _ and dots");
  expect_refused("acme." + std::string(200, 'O'), "too long");
}

TEST_F(NewNodeTest, refuses_a_folder_that_exists) {
  fs::create_directory(folder.file("there"));
  const auto result = new_node({"acme.Offset", "--dir", folder.file("there")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("exists already"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.file("there")));
  fs::create_symlink(folder.file("nowhere"), folder.file("link"));
  EXPECT_EQ(new_node({"acme.Offset", "--dir", folder.file("link")}).exit_code, 2);
  test::write_file(folder.file("file"), "");
  EXPECT_EQ(new_node({"acme.Offset", "--dir", folder.file("file/below")}).exit_code, 5);
}

TEST_F(NewNodeTest, writes_five_files_named_after_the_node_without_gaps) {
  const auto result = new_node({"com.acme.IPBallOffset", "--dir", folder.file("deep/er")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.file("deep/er"))) {
    names.push_back(entry.path().filename().string());
    const std::string text = test::read_file(entry.path().string());
    EXPECT_EQ(text.find('@'), std::string::npos) << names.back() << " has a gap";
    EXPECT_EQ(text.back(), '\n') << names.back();
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"CMakeLists.txt", "README.md", "graph.json",
                                             "ip_ball_offset.cpp", "ip_ball_offset_test.cpp"}));
  const std::string cmake = test::read_file(folder.file("deep/er/CMakeLists.txt"));
  EXPECT_NE(cmake.find("ballflow_node_library(com_acme_ip_ball_offset SOURCES ip_ball_offset.cpp"),
            std::string::npos)
      << cmake;
}

}  // namespace
}  // namespace ballflow
