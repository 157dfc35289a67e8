// What a run looks like while it runs.
#include <gtest/gtest.h>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Progress : testing::Test {
  test::TempFolder folder;

  std::string command() {
    test::write_file(folder.file("naps.json"), R"({"doc": "Two naps.", "nodes": {
      "quiet": {"type": "Nap", "params": {"seconds": 1.3}},
      "open": {"type": "Nap", "params": {"seconds": 1, "tell": true}}},
      "outputs": {"quiet": "quiet.rest", "open": "open.rest"}})");
    return test::binary_file("bin/ballflow") + " --plugin " + test::binary_file("tests/cli/slow.so") +
           " run " + folder.file("naps.json") + " --cache " + folder.file("cache") +
           " --force quiet --force open";
  }
  /// What a terminal of 100 columns receives.
  std::string on_a_terminal(const std::string& options) {
    const auto result = test::run_process(
        {"/usr/bin/script", "-qec", "stty cols 100 rows 24; " + command() + options, "/dev/null"},
        {{"TERM", "xterm"}});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return result.out;
  }
};

TEST_F(Progress, on_a_terminal_is_a_block_with_bars_and_the_time_that_is_left) {
  const std::string first = on_a_terminal("");
  EXPECT_TRUE(contains(first, "open                 [######")) << first;
  EXPECT_TRUE(contains(first, "quiet                [......")) << "nothing is known of it";
  EXPECT_TRUE(contains(first, "0 of 2 nodes done, ")) << first;
  EXPECT_TRUE(contains(first, " MB")) << first;
  EXPECT_TRUE(contains(first, "\033[A\033[2K")) << "it is redrawn";
  const std::string second = on_a_terminal("");
  EXPECT_TRUE(contains(second, "quiet                [-----")) << "as long as before: " << second;
  EXPECT_TRUE(contains(second, " of computing left")) << second;
  EXPECT_FALSE(contains(second, "of unknown length\n")) << second;
}

TEST_F(Progress, with_quiet_is_nothing_on_a_terminal_too) {
  EXPECT_FALSE(contains(on_a_terminal(" --quiet"), "nodes done"));
}

TEST_F(Progress, in_a_pipe_is_plain_lines) {
  const auto result = test::run_process({"/bin/sh", "-c", command()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(contains(result.err, "\033")) << result.err;
  EXPECT_FALSE(contains(result.err, "nodes done")) << result.err;
  EXPECT_TRUE(contains(result.err, "quiet: ")) << result.err;
  EXPECT_EQ(test::run_process({"/bin/sh", "-c", command() + " --quiet"}).err, "");
}

}  // namespace
}  // namespace ballflow
