// Commands that only look: graph, plugins, nodes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct InspectTest : testing::Test {
  test::ProcessResult ballflow(std::vector<std::string> arguments,
                               std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    environment["BALLFLOW_CACHE"] = folder.file("cache");
    return test::run_process(arguments, environment);
  }
  test::TempFolder folder;
};

TEST_F(InspectTest, graph_draws_the_expanded_graph_with_its_parameters_and_what_a_run_would_do) {
  const std::vector<std::string> graph = {test::source_file("graphs/medial_axis.json"),
                                          "--set",
                                          "input=shape:torus?n=600",
                                          "--set",
                                          "strategy=hybrid",
                                          "--set",
                                          "sampling=vertices"};
  const auto draw = [&](std::vector<std::string> more) {
    more.insert(more.begin(), graph.begin(), graph.end());
    more.insert(more.begin(), "graph");
    const auto result = ballflow(more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  const std::string plain = draw({});
  EXPECT_EQ(plain.rfind("digraph ", 0), 0u);
  EXPECT_NE(plain.find("label=\"loop until cover.remaining == 0\""), std::string::npos) << plain;
  EXPECT_NE(plain.find("<B>reduce</B><BR/>Reduce"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("<B>RUN</B>"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder.file("cache"))) << "drawing needs no cache";
  EXPECT_NE(draw({"--status"}).find("<B>RUN</B>"), std::string::npos);
  std::vector<std::string> run = {"run", "--quiet"};
  run.insert(run.end(), graph.begin(), graph.end());
  ASSERT_EQ(ballflow(run).exit_code, 0);
  const std::string after = draw({"--status"});
  EXPECT_NE(after.find("<B>HIT</B>"), std::string::npos);
  EXPECT_EQ(after.find("<B>RUN</B>"), std::string::npos) << after;
  EXPECT_EQ(ballflow({"graph", folder.file("absent.json")}).exit_code, 2);
}

TEST_F(InspectTest, plugins_lists_what_was_found_and_why_others_were_refused) {
  test::write_file(folder.file("libraries/text.so"), "no library");
  fs::copy_file(test::binary_file("lib/ballflow/balls.so"), folder.file("libraries/balls.so"));
  const std::map<std::string, std::string> environment = {
      {"BALLFLOW_PLUGIN_PATH", folder.file("libraries") + ":" + folder.file("absent")}};
  const auto listed = ballflow({"plugins", "--json"}, environment);
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const json found = json::parse(listed.out);
  ASSERT_EQ(found.at("folders").size(), 3u);
  EXPECT_EQ(found.at("folders").at(0), (json{{"path", folder.file("libraries")}, {"exists", true}}));
  EXPECT_EQ(found.at("folders").at(1), (json{{"path", folder.file("absent")}, {"exists", false}}));
  ASSERT_EQ(found.at("refused").size(), 1u);
  EXPECT_EQ(found.at("refused").at(0).at("path"), folder.file("libraries/text.so"));
  EXPECT_EQ(found.at("refused").at(0).at("reason"), "is no ELF file (no shared library)");
  const json& first = found.at("plugins").at(0);
  EXPECT_EQ(first.at("path"), folder.file("libraries/balls.so"));
  EXPECT_EQ(first.at("name"), "balls");
  EXPECT_NE(std::find(first.at("nodes").begin(), first.at("nodes").end(), "Enlarge"),
            first.at("nodes").end());
  const auto text = ballflow({"plugins"}, environment);
  EXPECT_NE(text.out.find("refused  " + folder.file("libraries/text.so") + "\n  is no ELF file"),
            std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find(folder.file("absent") + " (no such folder)"), std::string::npos) << text.out;
}

TEST_F(InspectTest, nodes_markdown_takes_its_examples_from_graphs) {
  const auto page = ballflow({"nodes", "--markdown", "--graphs", test::source_file("graphs")});
  ASSERT_EQ(page.exit_code, 0) << page.err;
  EXPECT_EQ(page.out, test::read_file(test::source_file("nodes/README.md")));
}

}  // namespace
}  // namespace ballflow
