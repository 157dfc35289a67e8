// Clouds of points, without normals and without a mesh.
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

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

TEST_F(CloudTest, a_number_of_balls_that_cannot_be_reached_is_named) {
  const auto failed =
      run("k_balls", {"--set", "input=shape:torus?n=1500", "--set", "k=3", "--set", "largest=2"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_NE(failed.err.find("the largest allowed, still needs"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("balls, not 3"), std::string::npos) << failed.err;
}

}  // namespace
}  // namespace ballflow
