// Graphs by name, from a folder that has none.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct NamesTest : testing::Test {
  NamesTest() { fs::create_directory(folder.file("empty")); }
  test::ProcessResult ballflow(std::vector<std::string> arguments) {
    const std::vector<std::string> there = {"/usr/bin/env", "-C", folder.file("empty"),
                                            test::binary_file("bin/ballflow")};
    arguments.insert(arguments.begin(), there.begin(), there.end());
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  test::TempFolder folder;
};

TEST_F(NamesTest, of_all_graphs_and_experiments_are_listed_with_what_they_make) {
  const auto listed = ballflow({"graph", "--list", "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  std::size_t files = 0;
  for (const char* shipped : {"graphs", "graphs/experiments"}) {
    for (const auto& entry : fs::directory_iterator(test::source_file(shipped)))
      files += entry.path().extension() == ".json" ? 1 : 0;
  }
  const json graphs = json::parse(listed.out);
  EXPECT_EQ(graphs.size(), files);
  const std::string text = ballflow({"graph", "--list"}).out;
  std::istringstream lines(text);
  for (const json& graph : graphs) {
    EXPECT_TRUE(fs::is_regular_file(graph.at("file").get<std::string>())) << graph;
    EXPECT_GT(graph.at("doc").get<std::string>().size(), 10u) << graph;
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line.rfind(graph.at("name").get<std::string>() + " ", 0), 0u) << line;
    EXPECT_NE(line.find(graph.at("doc").get<std::string>()), std::string::npos) << line;
  }
}

TEST_F(NamesTest, are_taken_by_every_command_that_takes_a_graph) {
  EXPECT_EQ(ballflow({"check", "medial_axis"}).out.rfind("medial_axis: ", 0), 0u);
  EXPECT_EQ(ballflow({"graph", "experiments/table_3_3"}).out.rfind("digraph ", 0), 0u);
  EXPECT_NE(ballflow({"plan", "shape"}).out.find("RUN"), std::string::npos);
  const auto swept = ballflow({"sweep", "shape", "--axis", "n=200,300", "--quiet"});
  EXPECT_EQ(swept.exit_code, 0) << swept.err;
}

TEST_F(NamesTest, decide_nothing_about_keys_and_the_history_of_a_graph) {
  const auto run = [this](const std::string& graph) {
    const auto result = ballflow({"run", graph, "--set", "n=200", "--report", folder.file("report.json")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(test::read_file(folder.file("report.json")));
  };
  const json by_name = run("shape");
  EXPECT_EQ(by_name.at("command").get<std::string>().rfind("ballflow run shape ", 0), 0u);
  const json by_path = run(test::source_file("graphs/shape.json"));
  const json by_link = run(test::binary_file("share/ballflow/graphs/shape.json"));
  for (const json* other : {&by_path, &by_link}) {
    ASSERT_EQ(other->at("nodes").size(), by_name.at("nodes").size());
    for (const auto& [path, first] : by_name.at("nodes").items()) {
      const json& node = other->at("nodes").at(path);
      EXPECT_EQ(node.at("status"), "hit") << node;  // under the same key
      EXPECT_EQ(node.at("outputs"), first.at("outputs"));
    }
  }
  const auto mark = [](const json& report) { return report.at("run").get<std::string>().substr(20, 8); };
  EXPECT_EQ(mark(by_name), mark(by_path));
  EXPECT_EQ(mark(by_name), mark(by_link));
  const auto explained = ballflow({"explain", "shape", "shape", "--against", "latest"});
  EXPECT_EQ(explained.exit_code, 0) << explained.err;
}

TEST_F(NamesTest, that_are_unknown_are_wrong_usage_with_the_nearest_ones) {
  const auto misspelt = ballflow({"run", "medial_axes"});
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_NE(misspelt.err.find("did you mean \"medial_axis\""), std::string::npos) << misspelt.err;
  EXPECT_EQ(ballflow({"check", "strategies/greedy"}).exit_code, 2) << "a part has no name";
  EXPECT_EQ(ballflow({"graph"}).exit_code, 2);
  EXPECT_EQ(ballflow({"graph", "--list", "shape"}).exit_code, 2);
  EXPECT_EQ(ballflow({"graph", "shape", "--json"}).exit_code, 2);
}

TEST_F(NamesTest, give_way_to_a_file_of_that_path) {
  test::write_file(folder.file("empty/shape"), R"({ "nodes": {}, "outputs": { "x": "nothing.y" } })");
  const auto own = ballflow({"check", "shape"});
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_EQ(own.err.rfind("shape:1:", 0), 0u) << own.err;
}

}  // namespace
}  // namespace ballflow
