// Clouds of points, without normals and without a mesh.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using nlohmann::json;

struct CloudTest : testing::Test {
  test::TempFolder folder;

  test::ProcessResult run(const std::string& graph, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {test::binary_file("bin/ballflow"), "run",
                                         test::source_file("graphs/" + graph + ".json")});
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}}, 0, SIGKILL);
  }
  json report(const std::string& name) { return json::parse(test::read_file(folder.file(name))); }
  void make_cloud() {
    const auto made = run("shape", {"--set", "shape=torus", "--set", "n=3000", "--out", folder.path(),
                                    "--format", "points=xyz"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
};

TEST_F(CloudTest, has_the_medial_axis_of_its_mesh) {
  make_cloud();
  const auto mesh = run("medial_axis", {"--set", "input=shape:torus?n=3000", "--set", "sampling=vertices",
                                        "--report", folder.file("mesh.json")});
  ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
  const auto cloud = run("medial_axis", {"--set", "input=" + folder.file("points.xyz"), "--report",
                                         folder.file("cloud.json"), "--out", folder.file("out")});
  ASSERT_EQ(cloud.exit_code, 0) << cloud.err;
  for (const char* output : {"inner", "balls", "medial_axis"}) {
    EXPECT_EQ(report("cloud.json").at("outputs").at(output).at("digest"),
              report("mesh.json").at("outputs").at(output).at("digest"))
        << output;
  }
}

TEST_F(CloudTest, is_pruned_and_its_absent_mesh_is_an_empty_file) {
  make_cloud();
  const auto pruned =
      run("prune", {"--set", "input=" + folder.file("points.xyz"), "--out", folder.file("out")});
  ASSERT_EQ(pruned.exit_code, 0) << pruned.err;
}

TEST_F(CloudTest, is_not_labelled_by_a_mesh_that_is_not_there) {
  make_cloud();
  const auto refused =
      run("medial_axis", {"--set", "input=" + folder.file("points.xyz"), "--set", "labels=mesh"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("the mesh has no triangles"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("method angle"), std::string::npos) << refused.err;
}

TEST_F(CloudTest, becomes_a_surface_and_three_reports_and_the_rest_where_it_is_asked_for) {
  make_cloud();
  const auto names = [&](const std::string& graph) {
    const std::string out = folder.file(graph);
    const auto made = run(graph, {"--set", "input=" + folder.file("points.xyz"), "--out", out});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
      const std::string name = entry.path().filename().string();
      if (name.front() != '.') files.insert(name);
    }
    return files;
  };
  EXPECT_EQ(names("reconstruct"),
            (std::set<std::string>{"mesh.ply", "noise.json", "regime.json", "report.json"}));
  const std::set<std::string> stages = names("surface_stages");
  for (const char* name : {"mesh.ply", "report.json", "points.ply", "original.ply", "balls.ply"})
    EXPECT_TRUE(stages.contains(name)) << name;
}

TEST_F(CloudTest, has_proven_radii_from_all_poles_only) {
  make_cloud();
  const auto regime = [&](const std::string& lfs_from) {
    const auto made = run("reconstruct", {"--set", "input=" + folder.file("points.xyz"), "--set",
                                          "radius=0.3", "--set", "shrink=0.03", "--set",
                                          "lfs_from=" + lfs_from, "--report", folder.file("report.json")});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return report("report.json").at("outputs").at("regime").at("summary").at("regime").get<std::string>();
  };
  EXPECT_EQ(regime("poles"), "proven");
  EXPECT_EQ(regime("pruned"), "heuristic");
}

TEST_F(CloudTest, a_number_of_balls_that_cannot_be_reached_is_named) {
  const auto failed =
      run("k_balls", {"--set", "input=shape:torus?n=1500", "--set", "balls=3", "--set", "largest=2"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.err.find("the largest allowed, still needs"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("balls, not 3"), std::string::npos) << failed.err;
}

}  // namespace
}  // namespace ballflow
