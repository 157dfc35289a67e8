// The whole pipeline on scans and CAD models: what must hold whatever the model is.
#include <gtest/gtest.h>

#include "ballflow/run.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class Silent final : public EventSink {
 public:
  void on(const Event&) override {}
};

const Registry& registry() {
  static const auto instance = Registry::load();
  return *instance;
}

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
class DefaultRun : public testing::TestWithParam<const char*> {};

TEST_P(DefaultRun, keeps_the_topology_from_the_solid_to_the_medial_axis) {
  const std::string file = test::data_file("models/" + std::string(GetParam()));
  if (file.empty()) GTEST_SKIP() << "no test data";
  const Dag dag = load_graph(test::source_file("graphs/medial_axis.json"), registry(), {{"input", file}});
  Silent silent;
  Runner runner(dag, registry(), Store::open({}), {}, silent);
  const RunResult& result = runner.run();
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    ASSERT_EQ(result.nodes[i].status, NodeStatus::run) << dag.nodes[i].path << ": " << result.nodes[i].cause;
    if (dag.nodes[i].path != "topology") continue;
    const Json table = Json::parse(result.nodes[i].outputs[0].summary);
    EXPECT_EQ(table["changes"], 0) << table["words"];
    EXPECT_NE(table["surface"], nullptr);
    EXPECT_EQ(table["surface"], table["axis"]) << table["words"];
  }
}

INSTANTIATE_TEST_SUITE_P(Models, DefaultRun,
                         testing::Values("eight.off.gz", "panda_link1.obj.gz", "femur_ICL_MRI.off.gz"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace ballflow
