// Sweeps and their comparison as a user meets them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

struct SweepCli : testing::Test {
  test::TempFolder folder;
  std::string graph = test::source_file("graphs/experiments/epsilon_by_strategy.json");

  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  /// Runs the experiment on a small model; its report.
  json sweep(std::vector<std::string> more, const std::string& out) {
    std::vector<std::string> arguments = {"sweep", graph, "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = ballflow(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(test::read_file(out + "/report.json"));
  }
  static std::map<std::string, int> count_statuses(const json& report) {
    std::map<std::string, int> counts;
    for (const auto& [path, node] : report.at("nodes").items()) ++counts[node.at("status")];
    return counts;
  }
  static bool valid_against(const std::string& schema, const std::string& file) {
    const ProcessResult result =
        test::run_process({"/usr/bin/env", "python3", "-c",
                           "import json, sys, jsonschema\n"
                           "jsonschema.validate(json.load(open(sys.argv[2])), json.load(open(sys.argv[1])))",
                           test::source_file(schema), file});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0;
  }
};

const std::vector<std::string> small_torus = {"--set", "input=shape:torus?n=1500", "--set",
                                              "sampling=vertices"};

TEST_F(SweepCli, computes_the_topology_of_what_comes_before_the_pruning_once) {
  const ProcessResult result = ballflow(
      {"run", test::source_file("graphs/medial_axis.json"), "--set", "sampling=vertices", "--set",
       "growth=additive", "--set", "repair=none", "--axis", "strategy=none,greedy,certified", "--set",
       small_torus[1], "--quiet", "--report", folder.file("report.json"), "--out", folder.file("out")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(test::read_file(folder.file("report.json")));
  std::map<std::string, int> executions;
  for (const auto& [path, node] : report.at("nodes").items()) {
    if (node.at("status") == "run") ++executions[node.at("type")];
  }
  EXPECT_EQ(executions["SelectBalls"], 3);
  EXPECT_EQ(executions["Topology"], 3);
  EXPECT_EQ(executions["UnionTopology"], 2);  // of the inner and of the enlarged balls
  EXPECT_EQ(executions["SolidTopology"], 1);
}

TEST_F(SweepCli, runs_shared_prefixes_once_and_gives_what_single_runs_give) {
  const json report = sweep(small_torus, folder.file("out"));
  ASSERT_EQ(report.at("variants").size(), 6u);
  std::map<std::string, int> executions;
  for (const auto& [path, node] : report.at("nodes").items()) {
    // No output of the sweep asks for volumes.
    const bool asked = node.at("type") != "UnionMeasure";
    EXPECT_EQ(node.at("status"), asked ? "run" : "skipped") << path;
    ++executions[node.at("type")];
  }
  EXPECT_EQ(executions["Sample"], 1);
  EXPECT_EQ(executions["VoronoiPoles"], 1);
  EXPECT_EQ(executions["LabelPoles"], 1);
  EXPECT_EQ(executions["Enlarge"], 3);
  EXPECT_EQ(executions["CoverMatrix"], 3);
  EXPECT_EQ(executions["SelectBalls"], 6);

  for (const json& variant : report.at("variants")) {
    EXPECT_EQ(variant.at("status"), "ok");
    const json& params = variant.at("params");
    const ProcessResult alone = test::run_process(
        {test::binary_file("bin/ballflow"), "run", test::source_file("graphs/medial_axis.json"), "--set",
         "sampling=vertices", "--set", small_torus[1], "--set", "epsilon=" + params.at("epsilon").dump(),
         "--set", "strategy=" + params.at("strategy").get<std::string>(), "--no-cache", "--quiet", "--report",
         folder.file("alone.json")});
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const json single = json::parse(test::read_file(folder.file("alone.json")));
    for (const char* output : {"balls", "cover", "check", "medial_axis"}) {
      EXPECT_EQ(report.at("outputs").at(variant.at("name").get<std::string>() + "/" + output).at("digest"),
                single.at("outputs").at(output).at("digest"))
          << variant.at("name") << " " << output;
    }
    EXPECT_TRUE(fs::exists(folder.file("out/" + variant.at("name").get<std::string>() + "/balls.ply")));
  }

  // 6 measures of unions.
  const json again = sweep(small_torus, folder.file("out"));
  EXPECT_EQ(
      count_statuses(again),
      (std::map<std::string, int>{{"hit", static_cast<int>(report.at("nodes").size()) - 6}, {"skipped", 6}}));
}

TEST_F(SweepCli, another_strategy_costs_only_what_changed) {
  std::vector<std::string> arguments = small_torus;
  arguments.insert(arguments.end(), {"--axis", "strategy=greedy"});
  const json first = sweep(arguments, folder.file("out"));
  // Skipped: 3 measures of the union.
  EXPECT_EQ(count_statuses(first).at("run"), static_cast<int>(first.at("nodes").size()) - 3);
  arguments.back() = "strategy=greedy,hybrid";
  std::map<std::string, int> executions;
  const json swapped = sweep(arguments, folder.file("out"));
  for (const auto& [path, node] : swapped.at("nodes").items()) {
    if (node.at("status") != "run") continue;
    EXPECT_NE(path.find("strategy=hybrid"), std::string::npos) << path;
    ++executions[node.at("type")];
  }
  EXPECT_EQ(executions.at("loop"), 3) << "one per epsilon";
  EXPECT_EQ(executions.at("SelectBalls"), 3);
  EXPECT_EQ(executions.at("MedialAxis"), 3);
  for (const char* type : {"Sample", "VoronoiPoles", "LabelPoles", "Enlarge", "CoverMatrix"})
    EXPECT_EQ(executions.count(type), 0u) << type;
}

TEST_F(SweepCli, the_report_and_every_graph_fit_their_schemas) {
  if (test::run_process({"/usr/bin/env", "python3", "-c", "import jsonschema"}).exit_code != 0)
    GTEST_SKIP() << "python3-jsonschema is not installed";
  sweep(small_torus, folder.file("out"));
  EXPECT_TRUE(valid_against("schemas/run_report.schema.json", folder.file("out/report.json")));
  test::write_file(folder.file("plain.json"), R"({"map": {"file": ["a*.ply", "b.ply"]},
    "sweep": {"axes": {"s.seed": [1, "x", true]}, "mode": "zip", "exclude": [{"s.seed": 1}]},
    "params": {"file": {"kind": "file"}}, "nodes": {}})");
  EXPECT_TRUE(valid_against("schemas/graph.schema.json", folder.file("plain.json")));
}

TEST_F(SweepCli, files_are_inputs_and_folders) {
  fs::create_directories(folder.file("my scans"));
  const std::string made = folder.file("made");
  for (const char* name : {"torus", "box"}) {
    ASSERT_EQ(ballflow({"run", test::source_file("graphs/shape.json"), "--set", std::string("shape=") + name,
                        "--set", "n=800", "--out", made, "--format", "mesh=off", "--quiet"})
                  .exit_code,
              0);
    fs::rename(made + "/mesh.off", folder.file("my scans/" + std::string(name) + ".off"));
  }
  const json report =
      sweep({"--inputs", folder.file("my scans/*.off"), "--axis", "epsilon=0.5"}, folder.file("out"));
  ASSERT_EQ(report.at("variants").size(), 4u);
  EXPECT_EQ(report.at("variants")[0].at("name"), "input=box.off,epsilon=0.5,strategy=greedy");
  EXPECT_TRUE(fs::exists(folder.file("out/input=torus.off,epsilon=0.5,strategy=hybrid/balls.ply")));
  const ProcessResult none = ballflow({"sweep", graph, "--inputs", folder.file("my scans/*.obj")});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no file matches"), std::string::npos) << none.err;
}

TEST_F(SweepCli, a_variant_that_fails_does_not_cost_the_others_their_files) {
  const ProcessResult result =
      ballflow({"sweep", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--inputs",
                "shape:torus?n=500", folder.file("missing.off"), "--out", folder.file("out")});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("[input=missing.off]/sampling/sample (Sample) failed"), std::string::npos)
      << result.err;
  EXPECT_NE(result.out.find("shape:torus?n=500"), std::string::npos) << result.out;
  const json report = json::parse(test::read_file(folder.file("out/report.json")));
  EXPECT_EQ(report.at("variants")[0].at("status"), "failed");
  EXPECT_EQ(report.at("variants")[1].at("status"), "ok");
  EXPECT_TRUE(fs::exists(folder.file("out/input=shape:torus_n_500/inner.ply")));
  EXPECT_FALSE(fs::exists(folder.file("out/input=missing.off/inner.ply")));
}

TEST_F(SweepCli, plan_check_and_run_understand_sweeps) {
  const ProcessResult checked = ballflow({"check", graph});
  EXPECT_NE(checked.out.find(": 6 variants with "), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find(" nodes, 30 outputs, no errors"), std::string::npos) << checked.out;
  const ProcessResult planned = ballflow({"plan", graph, "--axis", "epsilon=0.2"});
  EXPECT_NE(planned.out.find("[strategy=hybrid]/model/prune/rounds"), std::string::npos) << planned.out;
  const ProcessResult ran = ballflow({"run", graph, "--axis", "epsilon=0.5", small_torus[0], small_torus[1]});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("shared_seconds"), std::string::npos) << ran.out;
  const ProcessResult plain = ballflow({"sweep", test::source_file("graphs/shape.json")});
  EXPECT_EQ(plain.exit_code, 2);
  EXPECT_NE(plain.err.find("--axis NAME=VALUE,VALUE"), std::string::npos) << plain.err;
}

TEST_F(SweepCli, runs_are_listed_and_compared) {
  sweep(small_torus, folder.file("out"));
  for (const char* n : {"400", "800"}) {
    ASSERT_EQ(
        ballflow({"run", test::source_file("graphs/shape.json"), "--set", std::string("n=") + n}).exit_code,
        0);
  }
  const ProcessResult listed = ballflow({"runs"});
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 4) << listed.out;
  const ProcessResult two =
      ballflow({"compare", "previous", "latest", "--format", "csv", "--fields", "points.count"});
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_EQ(two.out.substr(0, two.out.find('\r')), "run,n,points.count,seconds,run_nodes,hit_nodes");
  const ProcessResult variants =
      ballflow({"compare", folder.file("out"), "--fields", "model.prune.cover.chosen,model.enlarge.epsilon",
                "--format", "json"});
  EXPECT_EQ(variants.exit_code, 0) << variants.err;
  const json rows = json::parse(variants.out);
  ASSERT_EQ(rows.size(), 6u);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("model.enlarge.epsilon"), row.at("epsilon"));
    EXPECT_GT(row.at("model.prune.cover.chosen"), 0);
  }
  EXPECT_LT(rows[1].at("model.prune.cover.chosen"), rows[0].at("model.prune.cover.chosen"))
      << "hybrid and greedy";
  const ProcessResult wrong = ballflow({"compare", folder.file("out"), "--fields", "cover.chosne"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"cover.chosen\"?"), std::string::npos) << wrong.err;
  EXPECT_EQ(ballflow({"compare", "nothing"}).exit_code, 2);
}

/// What the table of a fixed report looks like. BALLFLOW_TEST_ACCEPT=1 rewrites the expectation and skips.
TEST_F(SweepCli, tables_look_as_they_did) {
  const char* const accept = std::getenv("BALLFLOW_TEST_ACCEPT");
  const bool accepting = accept != nullptr && std::string(accept) == "1";
  for (const char* format : {"text", "csv", "md", "json"}) {
    const ProcessResult result =
        ballflow({"compare", test::source_file("tests/cli/compare/sweep.json"),
                  test::source_file("tests/cli/compare/single.json"), "--format", format});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string expected = test::source_file(std::string("tests/cli/compare/table.") + format);
    if (accepting) {
      test::write_file(expected, result.out);
    } else {
      EXPECT_EQ(result.out, test::read_file(expected)) << format;
    }
  }
  if (accepting) GTEST_SKIP() << "accepted";
}

}  // namespace
}  // namespace ballflow
