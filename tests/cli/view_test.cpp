// `ballflow view` as a command; what its pages show is tested in tests/browser.
#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct ViewTest : testing::Test {
  test::ProcessResult run(std::vector<std::string> arguments,
                          const std::string& program = test::binary_file("bin/ballflow")) {
    arguments.insert(arguments.begin(), program);
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  bool has_viewer() { return fs::exists(test::binary_file("share/ballflow/viewer.html")); }
  test::TempFolder folder;
};

TEST_F(ViewTest, says_how_to_get_the_viewer_when_it_was_not_built) {
  fs::create_directories(folder.file("bin"));
  fs::copy_file(test::binary_file("bin/ballflow"), folder.file("bin/ballflow"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"view"},
        {"graph", test::source_file("graphs/dmt.json"), "--html", folder.file("g.html")}}) {
    const auto result = run(command, folder.file("bin/ballflow"));
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_NE(result.err.find("built without its viewer"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("tools/setup viewer"), std::string::npos) << result.err;
  }
}

TEST_F(ViewTest, writes_one_page_that_names_no_address) {
  if (!has_viewer()) GTEST_SKIP() << "ballflow was built without its viewer";
  ASSERT_EQ(run({"run", test::source_file("graphs/shape.json"), "--quiet", "--set", "n=400"}).exit_code, 0);
  const std::string page = folder.file("page.html");
  const auto result = run({"view", "-o", page});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("2 layers"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
  const std::string html = test::read_file(page);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (const char* load : {"<link", "<script src", "@import"})
    EXPECT_EQ(html.find(load), std::string::npos) << load;
}

TEST_F(ViewTest, says_what_a_small_page_leaves_out) {
  if (!has_viewer()) GTEST_SKIP() << "ballflow was built without its viewer";
  ASSERT_EQ(run({"run", test::source_file("graphs/shape.json"), "--quiet", "--set", "n=20000"}).exit_code, 0);
  const auto result = run({"view", "-o", folder.file("page.html"), "--max-size", "50k"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("not in the page: mesh: left out"), std::string::npos) << result.err;
}

TEST_F(ViewTest, refuses_what_it_does_not_know) {
  if (!has_viewer()) GTEST_SKIP() << "ballflow was built without its viewer";
  EXPECT_EQ(run({"view", "nonsense", "-o", folder.file("page.html")}).exit_code, 2);
  EXPECT_EQ(run({"view", "--max-size", "much", "-o", folder.file("page.html")}).exit_code, 2);
  EXPECT_EQ(run({"view", "latest", "-o", folder.file("page.html")}).exit_code, 2) << "nothing has run";
  EXPECT_FALSE(fs::exists(folder.file("page.html")));
}

}  // namespace
}  // namespace ballflow
