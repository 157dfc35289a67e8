// Options of "ballflow run": what they print, write and return.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

struct RunOptionsTest : testing::Test {
  test::TempFolder folder;

  ProcessResult ballflow(std::vector<std::string> arguments,
                         std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    environment["BALLFLOW_CACHE"] = folder.file("cache");
    return test::run_process(arguments, environment);
  }
  ProcessResult run(std::vector<std::string> arguments, std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(),
                     {"run", test::source_file("graphs/medial_axis.json"), "--set", "sampling=vertices",
                      "--set", "growth=additive", "--set", "repair=none", "--set", "input=shape:torus?n=2000",
                      "--set", "strategy=greedy"});
    return ballflow(std::move(arguments), std::move(environment));
  }
  json report() { return json::parse(test::read_file(folder.file("report.json"))); }
  std::string status(const std::string& node) { return report().at("nodes").at(node).at("status"); }
  static std::vector<json> lines(const std::string& text) {
    std::vector<json> result;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) result.push_back(json::parse(line));
    return result;
  }
};

TEST_F(RunOptionsTest, until_and_only_run_a_part_and_say_what_is_missing) {
  const std::string file = folder.file("report.json");
  const ProcessResult missing = run({"--only", "alpha"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("needs dmt/sampling/sample, whose result is not in the cache"),
            std::string::npos);
  EXPECT_NE(missing.err.find("--until alpha"), std::string::npos) << missing.err;

  EXPECT_EQ(run({"--until", "diagram", "--report", file}).exit_code, 0);
  EXPECT_EQ(status("select"), "run");
  EXPECT_EQ(status("diagram"), "run");
  EXPECT_EQ(status("alpha"), "skipped");
  EXPECT_EQ(run({"--only", "alpha", "--out", folder.file("out"), "--report", file}).exit_code, 0);
  EXPECT_EQ(status("alpha"), "run");
  EXPECT_EQ(status("axis"), "skipped");
  EXPECT_TRUE(fs::exists(folder.file("out/alpha_shape.ply")));
  EXPECT_FALSE(fs::exists(folder.file("out/medial_axis.ply"))) << "was not computed";
}

TEST_F(RunOptionsTest, force_computes_a_subgraph_again) {
  const std::string file = folder.file("report.json");
  ASSERT_EQ(run({}).exit_code, 0);
  ASSERT_EQ(run({"--force", "dmt", "--report", file}).exit_code, 0);
  for (const char* node : {"dmt/sampling/sample", "dmt/sampling/poles", "dmt/sampling/label"})
    EXPECT_EQ(status(node), "run") << node;
  for (const char* node : {"enlarge", "axis"}) EXPECT_EQ(status(node), "hit") << node;
}

TEST_F(RunOptionsTest, keep_going_writes_what_could_be_computed) {
  test::write_file(folder.file("bad.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  test::write_file(folder.file("graph.json"), R"({"doc": "Two models, one of them damaged.", "nodes": {
    "bad":   { "type": "Sample", "params": { "file": ")" +
                                                  folder.file("bad.off") + R"(" } },
    "poles": { "type": "VoronoiPoles", "inputs": { "points": "bad.points" } },
    "good":  { "type": "Sample", "params": { "file": "shape:torus?n=2000" } } },
    "outputs": { "poles": "poles.poles", "good": "good.points" } })");
  const ProcessResult result = ballflow(
      {"run", folder.file("graph.json"), "--keep-going", "--threads", "1", "--out", folder.file("out")});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("node bad (Sample) failed"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("needs bad, which failed"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder.file("out/good.ply")));
  EXPECT_FALSE(fs::exists(folder.file("out/poles.ply")));
}

TEST_F(RunOptionsTest, wrong_names_and_sizes_are_refused_before_anything_runs) {
  const ProcessResult name = run({"--until", "selct"});
  EXPECT_EQ(name.exit_code, 2);
  EXPECT_NE(name.err.find("did you mean \"select\"?"), std::string::npos) << name.err;
  const ProcessResult size = run({"--memory", "plenty"});
  EXPECT_EQ(size.exit_code, 2);
  EXPECT_NE(size.err.find("write it as 8G"), std::string::npos) << size.err;
  EXPECT_EQ(run({"--only", "alpha", "--until", "alpha"}).exit_code, 2);
  EXPECT_EQ(run({"--trace", folder.file("none/trace.json")}).exit_code, 5);
  EXPECT_FALSE(fs::exists(folder.file("cache/runs")) && !fs::is_empty(folder.file("cache/runs")));
}

TEST_F(RunOptionsTest, a_small_memory_budget_runs_one_node_at_a_time_with_the_same_result) {
  ASSERT_EQ(run({"--no-cache", "--report", folder.file("report.json")}).exit_code, 0);
  const json free = report();
  const ProcessResult result =
      run({"--no-cache", "--memory", "1M", "--json", "--report", folder.file("report.json")});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_EQ(report().at("outputs"), free.at("outputs"));
  std::set<std::string> running;
  for (const json& line : lines(result.out)) {
    if (line.at("event") == "node_started") running.insert(line.at("node").get<std::string>());
    if (line.at("event") == "node_finished") running.erase(line.at("node").get<std::string>());
    EXPECT_LE(running.size(), 1u);
  }
}

TEST_F(RunOptionsTest, a_matrix_larger_than_the_memory_budget_is_refused_with_both_sizes) {
  const ProcessResult refused = run({"--memory", "20000"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("node matrix (CoverMatrix) failed"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("the run may use 0.02 MB"), std::string::npos) << refused.err;
  const ProcessResult made = run({"--memory", "1M"});
  EXPECT_EQ(made.exit_code, 0) << "a refusal is not remembered: " << made.err;
}

TEST_F(RunOptionsTest, json_lines_follow_their_schema) {
  const ProcessResult cold = run({"--json", "--quiet", "--out", folder.file("out")});
  const ProcessResult warm = run({"--json", "--quiet", "--force", "alpha"});
  const ProcessResult part = run({"--json", "--only", "alpha", "--set", "epsilon=5"});
  EXPECT_EQ(cold.exit_code, 0);
  EXPECT_EQ(cold.err, "");
  EXPECT_EQ(part.exit_code, 3);
  std::map<std::string, int> count;
  for (const json& line : lines(cold.out)) ++count[line.at("event")];
  EXPECT_EQ(count["run_started"], 1);
  EXPECT_EQ(count["node_started"], 20);
  EXPECT_EQ(count["node_finished"], 20);
  EXPECT_GE(count["cache_write"], 11);
  const json reported = lines(cold.out).back();
  EXPECT_EQ(reported.at("event"), "run_reported");
  EXPECT_FALSE(reported.at("files").empty());
  for (const auto& [name, file] : reported.at("files").items())
    EXPECT_TRUE(fs::exists(file.get<std::string>())) << name;

  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3 with jsonschema is not installed";
  test::write_file(folder.file("lines"), cold.out + warm.out + part.out);
  test::write_file(folder.file("check.py"), R"(import json, sys, jsonschema
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
for line in open(sys.argv[2]):
    for error in validator.iter_errors(json.loads(line)):
        print(line, error.message, file=sys.stderr)
        sys.exit(1)
)");
  const std::string command = "python3 '" + folder.file("check.py") + "' '" +
                              test::source_file("schemas/run_events.schema.json") + "' '" +
                              folder.file("lines") + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(RunOptionsTest, a_trace_has_every_node_on_a_lane_without_overlap) {
  ASSERT_EQ(run({"--trace", folder.file("trace.json"), "--threads", "3"}).exit_code, 0);
  const json trace = json::parse(test::read_file(folder.file("trace.json")));
  std::map<int, std::vector<std::pair<double, double>>> lanes;
  std::set<std::string> nodes;
  int writes = 0, counters = 0;
  for (const json& event : trace.at("traceEvents")) {
    if (event.at("ph") == "C") ++counters;
    if (event.at("ph") != "X") continue;
    const double start = event.at("ts"), end = start + event.at("dur").get<double>();
    EXPECT_GE(start, 0);
    EXPECT_GE(end, start);
    if (event.at("cat") == "cache") ++writes;
    if (event.at("cat") != "node") continue;
    nodes.insert(event.at("name").get<std::string>());
    lanes[event.at("tid")].emplace_back(start, end);
  }
  EXPECT_EQ(nodes.size(), 20u);
  EXPECT_GE(writes, 11);
  EXPECT_GE(counters, 20);
  for (auto& [lane, slices] : lanes) {
    std::sort(slices.begin(), slices.end());
    for (std::size_t i = 1; i < slices.size(); ++i) EXPECT_LE(slices[i - 1].second, slices[i].first) << lane;
  }
}

TEST_F(RunOptionsTest, the_determinism_check_passes_on_the_whole_pipeline) {
  for (const char* strategy : {"greedy", "hybrid"}) {
    const ProcessResult result =
        run({"--check-determinism", "--threads", "4", "--set", std::string("strategy=") + strategy});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("same results with 1 and with 4 threads"), std::string::npos) << result.out;
  }
}

struct NoisyTest : RunOptionsTest {
  ProcessResult run_noisy(int by, std::vector<std::string> options = {}) {
    test::write_file(folder.file("noisy.json"), R"({"doc": "A time and a later one.", "nodes": {
      "clock": { "type": "Clock" },
      "later": { "type": "Later", "inputs": { "time": "clock.now" }, "params": { "by": )" +
                                                    std::to_string(by) + R"( } } },
      "outputs": { "later": "later.later" } })");
    std::vector<std::string> arguments = {"--plugin", test::binary_file("tests/cli/noisy.so"),
                                          "run",      folder.file("noisy.json"),
                                          "--report", folder.file("report.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return ballflow(std::move(arguments));
  }
};

TEST_F(NoisyTest, another_result_for_the_same_key_is_a_loud_warning_or_exit_3_when_strict) {
  ASSERT_EQ(run_noisy(1).exit_code, 0);
  fs::remove_all(folder.file("cache/cas"));
  const ProcessResult strict = run_noisy(2, {"--strict"});
  EXPECT_EQ(strict.exit_code, 3);
  EXPECT_NE(strict.err.find("clock is not deterministic"), std::string::npos) << strict.err;

  const ProcessResult warned = run_noisy(2, {"--quiet"});
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_NE(warned.err.find("warning: node clock (Clock) is NOT DETERMINISTIC"), std::string::npos)
      << warned.err;
  EXPECT_EQ(report().at("nodes").at("clock").at("deterministic"), false);
  const std::string digest = report().at("outputs").at("later").at("digest");
  EXPECT_EQ(run_noisy(2, {"--strict"}).exit_code, 0) << "the entry was replaced";
  EXPECT_EQ(status("clock"), "hit");
  EXPECT_EQ(report().at("outputs").at("later").at("digest"), digest);
}

TEST_F(NoisyTest, a_library_may_be_named_behind_the_command) {
  test::write_file(folder.file("noisy.json"), R"({"nodes": { "clock": { "type": "Clock" } },
    "outputs": { "now": "clock.now" } })");
  const std::string library = test::binary_file("tests/cli/noisy.so");
  EXPECT_EQ(ballflow({"run", folder.file("noisy.json"), "--plugin", library, "--quiet"}).exit_code, 0);
  const ProcessResult wrong = ballflow({"run", folder.file("noisy.json"), "--plugins", library});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--plugins"), std::string::npos) << wrong.err;
}

TEST_F(NoisyTest, the_determinism_check_names_the_element) {
  const ProcessResult result = run_noisy(1, {"--check-determinism"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("output now: array nanoseconds is "), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ballflow
