// The whole pipeline on scans and CAD models: what must hold whatever the model is.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <ostream>

#include "ballflow/run.hpp"
#include "built_registry.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class RealModel : public testing::TestWithParam<const char*> {};

TEST_P(RealModel, is_covered_and_its_axis_has_the_topology_of_the_pruned_union) {
  const std::string file = test::data_file("models/" + std::string(GetParam()));
  if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
  const Dag dag =
      load_graph(test::source_file("graphs/medial_axis.json"), registry(),
                 {{"input", file}, {"sampling", "vertices"}, {"growth", "additive"}, {"repair", "none"}});
  Silent silent;
  Runner runner(dag, registry(), Store::open({}), {}, silent);
  const RunResult& result = runner.run();
  Json summary = Json::object();
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    ASSERT_EQ(result.nodes[i].status, NodeStatus::run) << dag.nodes[i].path << ": " << result.nodes[i].cause;
    for (const OutputEntry& entry : result.nodes[i].outputs) {
      summary[dag.nodes[i].path + "." + entry.port] = Json::parse(entry.summary);
    }
  }
  EXPECT_EQ(summary["axis.axis"]["euler_characteristic"], summary["alpha.complex"]["euler_characteristic"]);
  EXPECT_EQ(summary["axis.axis"]["components"], summary["alpha.complex"]["betti"][0]);
  // Only samples that no candidate contains: dragon_res3 has four.
  EXPECT_EQ(summary["verify.check"]["uncovered"], summary["matrix.cover"]["uncovered"]);
  EXPECT_LE(summary["verify.check"]["uncovered"], 4);
  // Thesis, Table 3.1: nearly as many inner balls as samples.
  EXPECT_GT(summary["dmt/sampling/label.inner"]["count"].get<double>(),
            0.9 * summary["dmt/sampling/sample.points"]["count"].get<double>());
}

INSTANTIATE_TEST_SUITE_P(Models, RealModel,
                         testing::Values("stanford_bunny.obj.gz", "stanford_dragon_50k.obj.gz",
                                         "fandisk.off.gz", "rocker_arm.obj.gz", "three_holes.off.gz",
                                         "stanford_dragon_res3.ply.gz"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           return name.substr(0, name.find('.'));
                         });

/// With the default parameters: from the solid to the axis of the balls that are left.
struct Solid {
  const char* file;
  Json betti;
  int samples;  // no more than these
  bool large;   // for tools/nightly: BALLFLOW_TEST_LARGE=1
};
void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.file; }

class DefaultRun : public testing::TestWithParam<Solid> {};

TEST_P(DefaultRun, keeps_the_topology_from_the_solid_to_the_medial_axis) {
  const Solid& solid = GetParam();
  if (solid.large && std::getenv("BALLFLOW_TEST_LARGE") == nullptr) {
    GTEST_SKIP() << "BALLFLOW_TEST_LARGE is not set";
  }
  const std::string file = test::data_file("models/" + std::string(solid.file));
  if (file.empty()) GTEST_SKIP() << "no test data";
  const Dag dag = load_graph(test::source_file("graphs/medial_axis.json"), registry(), {{"input", file}});
  Silent silent;
  Runner runner(dag, registry(), Store::open({}), {}, silent);
  const RunResult& result = runner.run();
  std::map<std::string, Json> summary;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    ASSERT_EQ(result.nodes[i].status, NodeStatus::run) << dag.nodes[i].path << ": " << result.nodes[i].cause;
    for (const OutputEntry& entry : result.nodes[i].outputs) {
      summary[dag.nodes[i].path + "." + entry.port] = Json::parse(entry.summary);
    }
  }
  const Json& table = summary["topology.topology"];
  for (const char* stage : {"surface", "inner", "enlarged", "complex", "axis"}) {
    EXPECT_EQ(table[stage], solid.betti) << stage << ": " << table["words"];
  }
  EXPECT_LE(summary["dmt/sampling/refine.points"]["count"].get<int>(), solid.samples);
}

INSTANTIATE_TEST_SUITE_P(Models, DefaultRun,
                         testing::Values(Solid{"eight.off.gz", {1, 2, 0}, 20'000, false},
                                         Solid{"panda_link1.obj.gz", {1, 0, 0}, 20'000, false},
                                         Solid{"femur_ICL_MRI.off.gz", {1, 0, 0}, 20'000, false},
                                         Solid{"three_holes.off.gz", {1, 3, 0}, 20'000, true},
                                         Solid{"fertility.off.gz", {1, 4, 0}, 20'000, true},
                                         Solid{"rocker_arm.obj.gz", {1, 1, 0}, 20'000, true},
                                         Solid{"knot2.off.gz", {2, 2, 0}, 20'000, true},
                                         Solid{"fandisk.off.gz", {1, 0, 0}, 20'000, true},
                                         Solid{"anchor_dense.off.gz", {1, 4, 0}, 20'000, true},
                                         Solid{"abc_00000801.obj.gz", {1, 9, 0}, 20'000, true},
                                         Solid{"scapula_48.stl.gz", {1, 0, 0}, 20'000, true},
                                         Solid{"crank_cse.obj.gz", {1, 12, 0}, 45'000, true},
                                         Solid{"occt_TR12J.stl.gz", {1, 22, 0}, 50'000, true},
                                         Solid{"cheese.off.gz", {1, 133, 0}, 85'000, true}),
                         [](const auto& instance) {
                           const std::string name = instance.param.file;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace ballflow
