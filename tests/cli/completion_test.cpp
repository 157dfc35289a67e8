// What may stand for the last word, as shells ask for it; and the pages made from the same description.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct CompletionTest : testing::Test {
  /// Candidates without what they mean; the last line, ":files" or ":folders" or ":", is one of them.
  std::vector<std::string> complete(std::vector<std::string> words) {
    words.insert(words.begin(), {test::binary_file("bin/ballflow"), "__complete"});
    const auto result = test::run_process(words, {{"BALLFLOW_CACHE", folder.file("cache")}});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    std::vector<std::string> lines;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);) lines.push_back(line.substr(0, line.find('\t')));
    return lines;
  }
  static bool has(const std::vector<std::string>& lines, const std::string& line) {
    return std::find(lines.begin(), lines.end(), line) != lines.end();
  }
  using Lines = std::vector<std::string>;
  test::TempFolder folder;
};

TEST_F(CompletionTest, of_commands_and_those_in_a_group) {
  EXPECT_EQ(complete({"swe"}), (Lines{"sweep", ":"}));
  EXPECT_EQ(complete({"cache", "p"}), (Lines{"pin", ":"}));
  EXPECT_EQ(complete({"--plugin", "x.so", "expl"}), (Lines{"explain", ":files"}));
  EXPECT_EQ(complete({"--plugin", "x.so", "cache", "p"}), (Lines{"pin", ":"}));
  EXPECT_FALSE(has(complete({""}), "__complete")) << "what shells call is not for people";
}

TEST_F(CompletionTest, of_options_and_their_choices) {
  EXPECT_EQ(complete({"run", "shape", "--cache-"}), (Lines{"--cache-size", ":"}));
  EXPECT_EQ(complete({"compare", "--format", "m"}), (Lines{"md", ":"}));
  EXPECT_EQ(complete({"completion", ""}), (Lines{"bash", "zsh", "fish", ":"}));
  EXPECT_EQ(complete({"run", "shape", "--threads", ""}), (Lines{":"})) << "a number has no candidates";
}

TEST_F(CompletionTest, of_graphs_by_name_and_of_files) {
  EXPECT_EQ(complete({"run", "medial_a"}), (Lines{"medial_axis", ":files"}));
  EXPECT_EQ(complete({"sweep", "experiments/table_3_3"}), (Lines{"experiments/table_3_3", ":files"}));
  EXPECT_EQ(complete({"explain", "enlarge", "medial_a"}), (Lines{"medial_axis", ":files"}));
  EXPECT_EQ(complete({"run", "shape", "--out", ""}), (Lines{":folders"}));
  EXPECT_EQ(complete({"look", ""}), (Lines{":files"}));
}

TEST_F(CompletionTest, of_what_the_graph_of_the_line_has) {
  EXPECT_EQ(complete({"run", "medial_axis", "--set", "eps"}), (Lines{"epsilon=", ":"}));
  EXPECT_EQ(complete({"run", "--set", "epsilon=0.5", "medial_axis", "--set", "growth=p"}),
            (Lines{"growth=power_diagram", "growth=pole_bound", ":"}));
  EXPECT_EQ(complete({"run", "medial_axis", "--set", "strategy=gre"}), (Lines{"strategy=greedy", ":"}))
      << "the names of files in graphs/strategies";
  EXPECT_EQ(complete({"run", "medial_axis", "--set", "input="}), (Lines{":files"}));
  EXPECT_TRUE(has(complete({"run", "medial_axis", "--until", ""}), "enlarge"));
  EXPECT_TRUE(has(complete({"run", "medial_axis", "--format", ""}), "balls="));
  EXPECT_EQ(complete({"run", "absent.json", "--set", "eps"}), (Lines{":"}));
  test::write_file(folder.file("own.json"),
                   R"({ "params": { "mine": { "kind": "boolean" } }, "nodes": [1], "outputs": 3 })");
  EXPECT_EQ(complete({"run", folder.file("own.json"), "--set", "m"}), (Lines{"mine=", ":"}));
  EXPECT_EQ(complete({"run", folder.file("own.json"), "--set", "mine="}),
            (Lines{"mine=true", "mine=false", ":"}));
  EXPECT_EQ(complete({"run", folder.file("own.json"), "--format", ""}), (Lines{":"}));
}

TEST_F(CompletionTest, of_node_types_and_their_parameters) {
  EXPECT_EQ(complete({"nodes", "Enla"}), (Lines{"Enlarge", ":"}));
  EXPECT_EQ(complete({"exec-node", "Greedy", "--set", "mo"}), (Lines{"mode=", ":"}));
  EXPECT_EQ(complete({"exec-node", "Greedy", "--set", "mode=a"}), (Lines{"mode=all", ":"}));
}

TEST_F(CompletionTest, has_a_page_for_every_command_that_names_all_its_options) {
  const auto made = test::run_process({test::binary_file("bin/ballflow"), "__share", folder.file("share")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  std::size_t pages = 0;
  for (const std::string& command : complete({""})) {
    if (command == ":") continue;
    ++pages;
    std::string text = test::read_file(folder.file("share/man/man1/ballflow-" + command + ".1"));
    std::erase(text, '\\');  // hyphens are escaped
    for (const std::string& option : complete({command, "-"}))
      EXPECT_TRUE(option == ":" || text.find("fB" + option + "fR") != std::string::npos) << command << option;
    EXPECT_NE(
        test::read_file(folder.file("share/man/man1/ballflow.1")).find(".TP\n\\fB" + command.substr(0, 3)),
        std::string::npos)
        << command;
  }
  EXPECT_GT(pages, 15u);
}

TEST_F(CompletionTest, leaves_unknown_hidden_commands_to_be_wrong_usage) {
  EXPECT_EQ(test::run_process({test::binary_file("bin/ballflow"), "__nothing"}).exit_code, 2);
  EXPECT_EQ(test::run_process({test::binary_file("bin/ballflow"), "completion", "tcsh"}).exit_code, 2);
}

}  // namespace
}  // namespace ballflow
