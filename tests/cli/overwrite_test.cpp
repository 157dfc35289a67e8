// Nothing that is written takes the place of what is read: whatever way leads there, it is refused with words
// before anything runs, and not a byte changes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;
using Words = std::vector<std::string>;

const char* const octahedron =
    "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
    "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

struct OverwriteTest : testing::Test {
  test::TempFolder folder;
  std::string scan = folder.file("scan.off"), graph = folder.file("graph.json");

  OverwriteTest() {
    test::write_file(scan, octahedron);
    test::write_file(graph, R"({"doc": "Reads a model.",
      "params": { "input": { "kind": "file", "doc": "a model" } },
      "nodes": { "read": { "graph": "parts/read.json", "params": { "input": "${input}" } } },
      "outputs": { "points": "read.points" } })");
    fs::create_directory(folder.file("parts"));
    test::write_file(folder.file("parts/read.json"), R"({"doc": "Reads a model.",
      "params": { "input": { "kind": "file", "doc": "a model" } },
      "nodes": { "sample": { "type": "Sample", "params": { "file": "${input}" } } },
      "outputs": { "points": "sample.points" } })");
    fs::create_directory_symlink(folder.path(), folder.file("parts/up"));
  }

  ProcessResult ballflow(Words arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  static bool has_viewer() { return fs::exists(test::binary_file("share/ballflow/viewer.html")); }
  Words run(Words more, const std::string& input = {}) {
    more.insert(more.begin(), {"run", graph, "--set", "input=" + (input.empty() ? scan : input)});
    return more;
  }
  /// The content of every file, links not followed.
  std::map<std::string, std::string> contents() {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      if (entry.is_symlink()) {
        result[entry.path()] = "-> " + fs::read_symlink(entry.path()).string();
      } else if (entry.is_regular_file()) {
        result[entry.path()] = test::read_file(entry.path());
      }
    }
    return result;
  }
  void expect_unchanged(const std::map<std::string, std::string>& before, const std::string& situation) {
    const auto after = contents();
    for (const auto& [path, content] : before) {
      ASSERT_TRUE(after.contains(path)) << situation << ": " << path << " is gone";
      EXPECT_EQ(after.at(path) == content, true) << situation << ": " << path << " was changed";
    }
    for (const auto& [path, content] : after) {
      const bool known =
          before.contains(path) || path.starts_with(folder.file("cache/"));  // made when first used
      EXPECT_TRUE(known) << situation << ": " << path << " was written";
    }
  }
  void expect_refused(const Words& arguments, const std::string& words) {
    const auto before = contents();
    const ProcessResult result = ballflow(arguments);
    std::string situation;
    for (const std::string& argument : arguments) situation += argument + " ";
    EXPECT_EQ(result.exit_code, 2) << situation << "\n" << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << situation << "\n" << result.err;
    EXPECT_NE(result.err.find("nothing was run"), std::string::npos) << situation << "\n" << result.err;
    expect_unchanged(before, situation);
  }
};

TEST_F(OverwriteTest, a_report_is_never_written_over_the_input_whatever_way_leads_there) {
  ASSERT_EQ(ballflow(run({})).exit_code, 0);  // the cache has all: not even a hit may destroy
  fs::create_symlink(scan, folder.file("soft"));
  fs::create_symlink("soft", folder.file("softer"));
  fs::create_hard_link(scan, folder.file("hard.json"));
  const int open_file = open(scan.c_str(), O_RDONLY);
  ASSERT_GE(open_file, 0);
  for (const std::string& way :
       {scan, folder.file("parts/../scan.off"), folder.file(".//scan.off"), folder.file("parts/up/scan.off"),
        folder.file("soft"), folder.file("softer"), folder.file("hard.json"), folder.file("new/../scan.off"),
        "/proc/self/root" + scan, "/proc/self/fd/" + std::to_string(open_file),
        fs::relative(scan, fs::current_path()).string()}) {
    expect_refused(run({"--report", way}), "the file of node read/sample, which would be lost");
    expect_refused(run({"--trace", way}), "the file of node read/sample, which would be lost");
  }
  close(open_file);
  // Also where the input is what is named by a detour.
  expect_refused(run({"--report", scan}, folder.file("softer")), "is the same file");
  expect_refused(run({"--out", folder.file("new"), "--report", scan}, folder.file("new/../scan.off")),
                 "the file of node read/sample");
}

TEST_F(OverwriteTest, outputs_of_a_graph_are_never_written_over_an_input) {
  const std::string out = folder.file("out"), input = folder.file("out/points.ply");
  const Words as_ply = {"--out", out};
  ASSERT_EQ(ballflow(run(as_ply)).exit_code, 0);
  // An earlier result is the input of the next run.
  expect_refused(run(as_ply, input), "the output points of --out");
  fs::create_directory_symlink(out, folder.file("other"));
  expect_refused(run({"--out", folder.file("other")}, input), "the output points of --out");
  expect_refused(run({"--out", folder.file("new/../out")}, input), "the output points of --out");
  fs::create_directory(folder.file("linked"));
  fs::create_symlink(scan, folder.file("linked/points.ply"));
  expect_refused(run({"--out", folder.file("linked")}), "the output points of --out");
  // The file in which a folder keeps what its files were made from.
  fs::copy_file(scan, folder.file("linked/.ballflow-outputs.json"));
  fs::remove(folder.file("linked/points.ply"));
  fs::create_hard_link(folder.file("linked/.ballflow-outputs.json"), folder.file("again.off"));
  expect_refused(run({"--out", folder.file("linked")}, folder.file("again.off")), "--out");
  // Another format has another name, and overwrites nothing.
  EXPECT_EQ(ballflow(run({"--out", out, "--format", "points=xyz"}, input)).exit_code, 0);
}

TEST_F(OverwriteTest, graphs_and_their_subgraphs_are_never_overwritten) {
  expect_refused(run({"--report", graph}), "is the graph, which would be lost");
  expect_refused(run({"--trace", folder.file("parts/read.json")}), "is a subgraph, which would be lost");
  expect_refused(run({"--trace", folder.file("parts/up/parts/read.json")}), "a subgraph");
  if (has_viewer()) expect_refused({"graph", graph, "--set", "input=" + scan, "--html", graph}, "the graph");
  fs::create_directories(folder.file("all/parts"));
  fs::copy_file(graph, folder.file("all/report.json"));
  fs::copy_file(folder.file("parts/read.json"), folder.file("all/parts/read.json"));
  expect_refused({"sweep", folder.file("all/report.json"), "--inputs", scan, "--out", folder.file("all")},
                 "is the graph");
}

TEST_F(OverwriteTest, inputs_of_loops_and_of_all_variants_of_a_sweep_are_seen) {
  test::write_file(folder.file("body.json"), R"({"doc": "Reads a model again.",
    "inputs": { "points": { "type": "PointSet", "doc": "what was read" } },
    "nodes": { "again": { "type": "Sample", "params": { "file": ")" +
                                                 scan + R"(" } } },
    "outputs": { "points": "again.points" } })");
  test::write_file(folder.file("loop.json"), R"({"doc": "A loop.",
    "nodes": { "first": { "type": "Sample", "params": { "file": "shape:torus?n=500" } },
      "rounds": { "loop": "body.json", "inputs": { "points": "first.points" }, "until": "points.count <= 6" } },
    "outputs": { "points": "rounds.points" } })");
  expect_refused({"run", folder.file("loop.json"), "--report", scan}, "the file of node ");
  expect_refused({"run", folder.file("loop.json"), "--report", folder.file("body.json")}, "body.json is ");
  fs::copy_file(scan, folder.file("scan2.off"));
  expect_refused({"sweep", graph, "--inputs", folder.file("scan*.off"), "--report", folder.file("scan2.off")},
                 "the file of node ");
}

TEST_F(OverwriteTest, nothing_is_written_into_the_cache_of_the_run) {
  const std::string cache = folder.file("cache");
  ASSERT_EQ(ballflow(run({})).exit_code, 0);
  fs::create_directory_symlink(cache, folder.file("shortcut"));
  for (const std::string& place : {cache, cache + "/out", cache + "/a/../b", folder.file("shortcut/out"),
                                   folder.file("parts/up/cache/cas"), "/proc/self/root" + cache}) {
    expect_refused(run({"--out", place}), "is in the cache");
    expect_refused(run({"--report", place + "/report.json"}), "is in the cache");
  }
  expect_refused(run({"--report", cache}), "is in the cache");
  // One that is not there yet.
  const ProcessResult fresh =
      ballflow(run({"--cache", folder.file("new"), "--out", folder.file("new/../new")}));
  EXPECT_EQ(fresh.exit_code, 2) << fresh.err;
  EXPECT_FALSE(fs::exists(folder.file("new/points.ply")));
  // Without a cache there is none to protect, and a folder beside it is not in it.
  EXPECT_EQ(ballflow(run({"--no-cache", "--out", folder.file("cached")})).exit_code, 0);
}

TEST_F(OverwriteTest, artifacts_that_are_given_as_files_are_never_overwritten) {
  const std::string file = folder.file("points.safetensors");
  ASSERT_EQ(ballflow(run({"--out", folder.path(), "--format", "points=safetensors"})).exit_code, 0);
  test::write_file(folder.file("poles.json"), R"({"doc": "Poles of given points.",
    "params": { "points": { "kind": "artifact", "type": "PointSet", "doc": "points" } },
    "nodes": { "poles": { "type": "VoronoiPoles", "inputs": { "points": "${points}" } } },
    "outputs": { "poles": "poles.poles" } })");
  expect_refused({"run", folder.file("poles.json"), "--set", "points=" + file, "--report", file},
                 "an artifact");
  expect_refused({"exec-node", "VoronoiPoles", "--input", "points=" + file, "--output", "poles=" + file},
                 "an artifact");
  expect_refused({"exec-node", "Sample", "--set", "file=" + scan, "--output", "points=" + scan},
                 "the file of node Sample");
  expect_refused({"export", file, file}, "an artifact");
  expect_refused({"export", file, folder.file("cache/points.ply")}, "is in the cache");
  expect_refused({"render", file, "-o", file}, "an artifact");
}

TEST_F(OverwriteTest, pages_and_pictures_are_never_written_over_what_they_show) {
  const std::string report = folder.file("out/report.json");
  ASSERT_EQ(ballflow(run({"--out", folder.file("out"), "--report", report})).exit_code, 0);
  expect_refused({"report", folder.file("out"), "-o", report}, "the report of a run");
  expect_refused({"render", report, "-o", report}, "the report of a run");
  expect_refused({"render", scan, "-o", folder.file("parts/../scan.off")}, "a model");
  if (has_viewer()) expect_refused({"view", report, "-o", report}, "the report of a run");
}

TEST_F(OverwriteTest, the_output_of_the_program_does_not_go_into_a_file_that_it_reads) {
  const auto before = contents();
  for (const std::string stream : {"", "2"}) {
    const std::string line = "exec '" + test::binary_file("bin/ballflow") + "' run '" + graph +
                             "' --set 'input=" + scan + "' " + stream + ">> '" + scan + "'";
    const ProcessResult result =
        test::run_process({"/bin/sh", "-c", line}, {{"BALLFLOW_CACHE", folder.file("cache")}});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    if (stream.empty()) {
      EXPECT_NE(result.err.find("what the program prints"), std::string::npos) << result.err;
      expect_unchanged(before, line);
    }
  }
  EXPECT_EQ(test::read_file(scan).rfind(octahedron, 0), 0u) << "at most a message follows";
}

TEST_F(OverwriteTest, two_files_that_are_written_are_not_one) {
  const std::string file = folder.file("r.json");
  fs::create_symlink("r.json", folder.file("parts/r.json"));
  expect_refused(run({"--report", file, "--trace", file}), "--report would be written to the same file");
  expect_refused(run({"--report", file, "--trace", folder.file("parts/up/r.json")}), "the same file");
  expect_refused(run({"--out", folder.file("out"), "--report", folder.file("out/points.ply")}),
                 "the same file");
  expect_refused({"exec-node", "Sample", "--set", "file=" + scan, "--output", "points=" + file, "--output",
                  "mesh=" + file},
                 "the same file");
}

TEST_F(OverwriteTest, results_and_devices_are_written_as_often_as_one_likes) {
  const Words words = {"--out", folder.file("out"), "--report", folder.file("out/report.json")};
  for (int i = 0; i < 2; ++i) EXPECT_EQ(ballflow(run(words)).exit_code, 0);
  EXPECT_EQ(ballflow(run({"--report", "/dev/null", "--trace", "/dev/null"})).exit_code, 0);
  EXPECT_EQ(ballflow(run({"--report", "/dev/stdout", "--quiet"})).exit_code, 0);
  EXPECT_EQ(ballflow(run({"--out", folder.path()})).exit_code, 0) << "beside the input";
  EXPECT_EQ(test::read_file(scan), octahedron);
}

}  // namespace
}  // namespace ballflow
