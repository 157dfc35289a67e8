// Failure messages, and the command in them that runs the failed node alone.
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

const std::string open_box = R"(OFF
8 10 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 0 2 1
3 0 3 2
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7
)";

struct ExecNodeTest : testing::Test {
  ExecNodeTest() { unsetenv("BALLFLOW_CACHE"); }

  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  /// As if pasted into a terminal, where $BALLFLOW_CACHE is not set.
  static ProcessResult paste(const std::string& line) { return test::run_process({"/bin/bash", "-c", line}); }
  /// The command in a failure message; empty when there is none.
  static std::string command_in(const std::string& err) {
    const std::string start = "  this node alone: ";
    const std::size_t at = err.find(start);
    if (at == std::string::npos) return {};
    return err.substr(at + start.size(), err.find('\n', at) - at - start.size());
  }
  static std::string line_with(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    if (at == std::string::npos) return {};
    const std::size_t begin = text.rfind('\n', at) + 1;
    return text.substr(begin, text.find('\n', at) - begin);
  }
  /// The run fails; its message names what failed, and the command in it fails with the same cause.
  ProcessResult expect_repeatable(const std::vector<std::string>& arguments, const std::string& cause) {
    const ProcessResult failed = ballflow(arguments);
    EXPECT_EQ(failed.exit_code, 3) << failed.err;
    EXPECT_NE(failed.err.find(cause), std::string::npos) << failed.err;
    const std::string command = command_in(failed.err);
    EXPECT_NE(command, "") << failed.err;
    const ProcessResult again = paste(command);
    EXPECT_EQ(again.exit_code, 3) << command << "\n" << again.err;
    EXPECT_NE(again.err.find(cause), std::string::npos) << command << "\n" << again.err;
    return failed;
  }
  std::string digest_of(const std::string& node, const std::string& port) {
    const json report = json::parse(test::read_file(folder.file("report.json")));
    return report.at("nodes").at(node).at("outputs").at(port).at("digest");
  }

  test::TempFolder folder;
};

TEST_F(ExecNodeTest, a_failed_source_can_be_repeated_whatever_its_file_is_called) {
  const std::string name = folder.file("it's a \"$(scan)\" \n \\ \xc3\xa4.off");
  test::write_file(name, "OFF\n1 1 0\n0 0 zero\n");
  const ProcessResult failed = expect_repeatable(
      {"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set", "input=" + name},
      "vertex 0");
  EXPECT_NE(failed.err.find("node sampling/sample (Sample) failed"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("what to do: "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("  param count = "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("again, from this node on: "), std::string::npos) << failed.err;
}

TEST_F(ExecNodeTest, a_file_that_is_absent_fails_the_same_way_alone) {
  expect_repeatable({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                     "input=" + folder.file("no.off")},
                    "No such file");
}

TEST_F(ExecNodeTest, a_failed_node_names_its_inputs_and_gets_them_from_the_cache) {
  test::write_file(folder.file("open.off"), open_box);
  const ProcessResult failed =
      expect_repeatable({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                         "input=" + folder.file("open.off"), "--set", "labels=mesh"},
                        "close the mesh");
  EXPECT_NE(failed.err.find("node sampling/label (LabelPoles) failed"), std::string::npos) << failed.err;
  const std::string mesh = line_with(failed.err, "  input mesh = sampling/sample.mesh");
  EXPECT_NE(mesh.find("sha256 "), std::string::npos) << failed.err;
  const std::string command = command_in(failed.err);
  EXPECT_NE(command.find("exec-node LabelPoles"), std::string::npos) << command;
  EXPECT_NE(command.find("--set method=mesh"), std::string::npos) << command;
  EXPECT_NE(command.find("--input mesh=" + mesh.substr(mesh.find("sha256 ") + 7)), std::string::npos)
      << command;
  // Only what is not default.
  EXPECT_EQ(command.find("--set ", command.find("--set ") + 1), std::string::npos) << command;
}

TEST_F(ExecNodeTest, without_a_cache_the_message_says_that_the_inputs_are_gone) {
  test::write_file(folder.file("open.off"), open_box);
  const ProcessResult failed =
      ballflow({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                "input=" + folder.file("open.off"), "--set", "labels=mesh", "--no-cache"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.err.find("it cannot be run alone: its input mesh is not stored (--no-cache)"),
            std::string::npos)
      << failed.err;
  EXPECT_EQ(command_in(failed.err), "");
  // What has no inputs needs no cache.
  test::write_file(folder.file("bad.off"), "OFF\n1 1 0\n0 0 zero\n");
  expect_repeatable({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--no-cache",
                     "--set", "input=" + folder.file("bad.off")},
                    "vertex 0");
  EXPECT_FALSE(fs::exists(folder.file("cache")));
}

/// A loop that selects balls by a cover again and again: the second time there are fewer balls than the cover
/// is about.
struct ExecLoopTest : ExecNodeTest {
  void write_graph(const std::string& until, const std::string& settings) {
    test::write_file(folder.file("body.json"), R"({
      "params": { "allow": { "kind": "boolean", "default": false } },
      "inputs": { "balls": { "type": "Balls" }, "cover": { "type": "CoverState" } },
      "nodes": { "select": { "type": "SelectBalls", "inputs": { "balls": "inputs.balls", "cover": "inputs.cover" },
                             "params": { "allow_unfinished": "${allow}" } } },
      "outputs": { "balls": "select.balls" } })");
    test::write_file(folder.file("graph.json"),
                     R"({
      "nodes": {
        "dmt": { "graph": ")" +
                         test::source_file("graphs/dmt.json") +
                         R"(", "params": { "input": "shape:torus?n=600", "sampling": "vertices" } },
        "grow": { "type": "Enlarge", "inputs": { "balls": "dmt.inner", "points": "dmt.points" }, "params": { "epsilon": 1 } },
        "matrix": { "type": "CoverMatrix", "inputs": { "balls": "grow.balls", "points": "dmt.points" } },
        "greedy": { "type": "Greedy", "inputs": { "cover": "matrix.cover" }, "params": { "mode": "until_covered" } },
        "again": { "loop": "body.json", "inputs": { "balls": "grow.balls", "cover": "greedy.cover" },
                   "until": ")" +
                         until + "\"" + settings +
                         R"( } },
      "outputs": { "balls": "again.balls" } })");
  }
};

TEST_F(ExecLoopTest, a_node_in_the_body_is_repeated_with_the_state_of_its_iteration) {
  write_graph("balls.count == 0", "");
  const ProcessResult failed = expect_repeatable(
      {"run", folder.file("graph.json"), "--set", "again.allow=true"}, "the cover is about");
  EXPECT_NE(failed.err.find("node again (loop) failed: again/select (SelectBalls) failed in iteration 2"),
            std::string::npos)
      << failed.err;
  EXPECT_NE(failed.err.find("  in it: again/select (SelectBalls)"), std::string::npos) << failed.err;
  const std::string command = command_in(failed.err);
  EXPECT_NE(command.find("exec-node SelectBalls"), std::string::npos) << command;
  EXPECT_NE(command.find("--set allow_unfinished=true"), std::string::npos) << command;
}

TEST_F(ExecLoopTest, a_loop_that_reaches_its_limit_is_repeated_as_a_loop) {
  write_graph("balls.count == 0", R"(, "max_iterations": 1)");
  const ProcessResult failed =
      expect_repeatable({"run", folder.file("graph.json"), "--set", "again/select.allow_unfinished=true"},
                        "1 iteration ended before balls.count == 0");
  const std::string command = command_in(failed.err);
  EXPECT_NE(command.find("exec-node loop --body "), std::string::npos) << command;
  EXPECT_NE(command.find("--set max_iterations=1"), std::string::npos) << command;
  EXPECT_NE(command.find("--set allow=false"), std::string::npos) << command;
  EXPECT_NE(command.find("--set select.allow_unfinished=true"), std::string::npos) << command;
  const ProcessResult goes_on = paste(command + " --set at_limit=stop");
  EXPECT_EQ(goes_on.exit_code, 0) << goes_on.err;
}

TEST_F(ExecNodeTest, gives_what_the_node_gives_in_a_graph_and_shares_its_cache) {
  ASSERT_EQ(ballflow({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                      "input=shape:torus?n=600", "--report", folder.file("report.json")})
                .exit_code,
            0);
  const std::string points = digest_of("sampling/sample", "points"),
                    poles = digest_of("sampling/poles", "poles");
  const ProcessResult hit = ballflow({"exec-node", "VoronoiPoles", "--input", "points=" + points});
  ASSERT_EQ(hit.exit_code, 0) << hit.err;
  EXPECT_NE(hit.out.find("HIT"), std::string::npos) << hit.out;
  EXPECT_NE(hit.out.find(poles), std::string::npos) << hit.out;
  // The same elsewhere, from a file, computed.
  ASSERT_EQ(ballflow({"export", points, folder.file("points.safetensors")}).exit_code, 0);
  const ProcessResult ran = ballflow({"exec-node", "VoronoiPoles", "--json", "--no-cache", "--input",
                                      "points=" + folder.file("points.safetensors"), "--output",
                                      "poles=" + folder.file("poles.safetensors")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json report = json::parse(ran.out);
  EXPECT_EQ(report.at("status"), "ok");
  EXPECT_EQ(report.at("nodes").at("VoronoiPoles").at("status"), "run");
  EXPECT_EQ(report.at("outputs").at("poles").at("digest"), poles);
  ASSERT_EQ(ballflow({"export", poles, folder.file("stored.safetensors")}).exit_code, 0);
  EXPECT_TRUE(test::read_file(folder.file("poles.safetensors")) ==
              test::read_file(folder.file("stored.safetensors")));
  // And what it stores is a hit for a graph.
  const ProcessResult other = ballflow(
      {"exec-node", "Sample", "--set", "file=shape:sphere?n=300", "--cache", folder.file("other cache")});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const ProcessResult graph =
      ballflow({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                "input=shape:sphere?n=300", "--cache", folder.file("other cache")});
  EXPECT_NE(graph.out.find("4 run, 1 from the cache"), std::string::npos) << graph.out;
}

TEST_F(ExecNodeTest, reports_failures_as_json_with_the_exit_code_of_every_run) {
  const ProcessResult failed = ballflow({"exec-node", "Sample", "--json", "--set", "file=/nowhere.off"});
  EXPECT_EQ(failed.exit_code, 3);
  const json report = json::parse(failed.out);
  EXPECT_EQ(report.at("status"), "failed");
  EXPECT_NE(report.at("nodes").at("Sample").at("error").at("cause").get<std::string>().find("/nowhere.off"),
            std::string::npos);
}

TEST_F(ExecNodeTest, what_is_wrong_with_the_command_is_said_before_anything_runs) {
  ASSERT_EQ(ballflow({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                      "input=shape:torus?n=600", "--report", folder.file("report.json")})
                .exit_code,
            0);
  const std::string points = digest_of("sampling/sample", "points"),
                    mesh = digest_of("sampling/sample", "mesh");
  const auto expect_wrong = [&](std::vector<std::string> arguments, const std::string& words) {
    arguments.insert(arguments.begin(), "exec-node");
    const ProcessResult result = ballflow(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  };
  expect_wrong({"VoronoiPole"}, "did you mean \"VoronoiPoles\"?");
  expect_wrong({"VoronoiPoles"}, "misses its input \"points\" (PointSet)");
  expect_wrong({"VoronoiPoles", "--input", "points"}, "no \"=\" between a name and a value");
  expect_wrong({"VoronoiPoles", "--input", "points=" + mesh}, "is a TriangleMesh, but input \"points\"");
  expect_wrong({"VoronoiPoles", "--input", "point=" + points}, "has no input \"point\"");
  expect_wrong({"VoronoiPoles", "--input", "points=" + points, "--input", "points=" + points},
               "points has an artifact already");
  expect_wrong({"VoronoiPoles", "--input", "points=" + folder.file("no.safetensors")},
               "there is no artifact");
  expect_wrong({"VoronoiPoles", "--input", "points=" + points, "--set", "nonsense=1"},
               "has no parameter \"VoronoiPoles.nonsense\"");
  expect_wrong({"Sample", "--set", "file=shape:torus", "--set", "count=many"}, "\"count\" must be");
  expect_wrong({"Sample", "--set", "file=shape:torus", "--output", "balls=b.ply"}, "has no output balls");
  expect_wrong({"loop"}, "name it with --body");
  expect_wrong({"Sample", "--body", "b.json"}, "only a loop has a body");
}

TEST_F(ExecNodeTest, a_file_that_breaks_the_invariants_of_its_type_never_reaches_a_node) {
  ASSERT_EQ(ballflow({"exec-node", "Sample", "--set", "file=shape:torus?n=600", "--output",
                      "points=" + folder.file("p.safetensors")})
                .exit_code,
            0);
  std::string bytes = test::read_file(folder.file("p.safetensors"));
  std::fill(bytes.end() - 8, bytes.end(), '\xff');  // the last coordinate becomes a NaN
  test::write_file(folder.file("p.safetensors"), bytes);
  const ProcessResult result =
      ballflow({"exec-node", "VoronoiPoles", "--input", "points=" + folder.file("p.safetensors")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("no valid PointSet"), std::string::npos) << result.err;
}

TEST_F(ExecNodeTest, a_graph_takes_an_artifact_as_a_parameter_from_the_cache_or_a_file) {
  ASSERT_EQ(ballflow({"run", test::source_file("graphs/dmt.json"), "--set", "sampling=vertices", "--set",
                      "input=shape:torus?n=600", "--report", folder.file("report.json")})
                .exit_code,
            0);
  const std::string points = digest_of("sampling/sample", "points"),
                    poles = digest_of("sampling/poles", "poles");
  const std::string graph = folder.file("poles.json");
  test::write_file(graph, R"({
    "params": { "sample": { "kind": "artifact", "type": "PointSet", "doc": "the sample" } },
    "nodes": { "poles": { "type": "VoronoiPoles", "inputs": { "points": "${sample}" } } },
    "outputs": { "poles": "poles.poles" } })");
  const auto run = [&](const std::string& value) {
    return ballflow({"run", graph, "--set", "sample=" + value, "--report", folder.file("again.json")});
  };
  const ProcessResult by_digest = run(points.substr(0, 12));
  EXPECT_EQ(by_digest.exit_code, 0) << by_digest.err;
  const json report = json::parse(test::read_file(folder.file("again.json")));
  EXPECT_EQ(report.at("nodes").at("poles").at("status"), "hit")
      << "the content is in the key, not where it was found";
  EXPECT_EQ(report.at("outputs").at("poles").at("digest"), poles);
  ASSERT_EQ(ballflow({"export", points, folder.file("points.safetensors")}).exit_code, 0);
  const ProcessResult by_file = run(folder.file("points.safetensors"));
  EXPECT_EQ(by_file.exit_code, 0) << by_file.err;
  EXPECT_EQ(json::parse(test::read_file(folder.file("again.json"))).at("outputs").at("poles").at("digest"),
            poles);
  const ProcessResult wrong = run(poles);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("must be a \"PointSet\""), std::string::npos) << wrong.err;
  const ProcessResult absent = run("nowhere.safetensors");
  EXPECT_EQ(absent.exit_code, 2);
  EXPECT_NE(absent.err.find("there is no artifact"), std::string::npos) << absent.err;
}

}  // namespace
}  // namespace ballflow
