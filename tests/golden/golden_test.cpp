// Whole pipelines on generated models. Two kinds of truth: topology that is known from the formula of the
// model, and figures of an earlier run (BALLFLOW_TEST_ACCEPT=1 rewrites those in tests/golden/ and skips).
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "ballflow/run.hpp"
#include "built_registry.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

struct Case {
  const char* name;
  const char* graph;
  std::vector<Setting> settings;
  int euler_characteristic;  // of the solid: 1 - genus; ignored for kNoTopology
};
constexpr int kNoTopology = 1000;

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// The thesis: the vertices are the sample, balls grow freely, nothing is returned.
std::vector<Setting> as_in_the_thesis(std::vector<Setting> settings) {
  settings.insert(settings.end(), {{"sampling", "vertices"}, {"growth", "additive"}, {"repair", "none"}});
  return settings;
}
/// For graphs that neither prune nor grow, or grow in a way of their own.
std::vector<Setting> of_vertices(std::vector<Setting> settings) {
  settings.push_back({"sampling", "vertices"});
  return settings;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"box", "medial_axis", {{"input", "shape:box?n=60"}}, 1},
      {"bracket", "medial_axis", {{"input", "shape:bracket?n=500"}, {"delta", "1"}}, 0},
      {"double_torus_offset", "offset", {{"input", "shape:doubleTorus?n=2000"}, {"delta", "1"}}, kNoTopology},
      {"sphere", "medial_axis", as_in_the_thesis({{"input", "shape:sphere?n=2500"}}), 1},
      {"torus", "medial_axis", as_in_the_thesis({{"input", "shape:torus?n=6000"}}), 0},
      {"double_torus", "medial_axis", as_in_the_thesis({{"input", "shape:doubleTorus?n=8000"}}), -1},
      {"3cross", "medial_axis", as_in_the_thesis({{"input", "shape:3cross?n=8000"}}), 1},
      {"knot", "medial_axis", as_in_the_thesis({{"input", "shape:knot?n=8000"}}), 0},
      {"torus_hybrid", "medial_axis",
       as_in_the_thesis({{"input", "shape:torus?n=6000"}, {"strategy", "hybrid"}}), 0},
      {"double_torus_mesh",
       "ball_mesh",
       {{"input", "shape:doubleTorus?n=2000"}, {"delta", "1"}},
       kNoTopology},
      {"gear_discs", "discs", {{"polygon", "polygon:gear"}}, kNoTopology},
      {"gear_plus_star",
       "minkowski_2d",
       {{"a", "polygon:gear"}, {"b", "polygon:star?R=0.3"}, {"algorithm", "hierarchical"}},
       kNoTopology},
      {"balls", "balls", {}, kNoTopology},  // a ring of balls and one ball apart: Betti 2 1 0
      {"minkowski_sum", "minkowski_sum",
       as_in_the_thesis({{"a", "shape:torus?n=2000"}, {"b", "shape:knot?n=3000&R=0.2"}}), kNoTopology},
      {"gear_plus_star_outer",
       "minkowski_2d",
       {{"a", "polygon:gear"}, {"b", "polygon:star?R=0.3"}, {"mode", "outer"}, {"max_error", "0.03"}},
       kNoTopology},
      {"minkowski_sum_outer", "minkowski_sum",
       as_in_the_thesis({{"a", "shape:torus?n=1000"}, {"b", "shape:box?n=500&R=0.3"}, {"mode", "outer"}}),
       kNoTopology},
      {"torus_error", "one_sided", as_in_the_thesis({{"input", "shape:torus?n=1500"}, {"max_error", "0.06"}}),
       kNoTopology},
      {"3cross_offset_inner", "offset",
       as_in_the_thesis({{"input", "shape:3cross?n=2000"}, {"mode", "inner"}}), kNoTopology},
      {"torus_cross_distance", "distance",
       as_in_the_thesis({{"a", "shape:torus?R=1&r=0.3&n=1500"}, {"b", "shape:3cross?R=0.5&n=1500"}}),
       kNoTopology},
      {"torus_way", "path",
       as_in_the_thesis({{"robot", "shape:box?R=0.3&n=500"}, {"obstacles", "shape:torus?R=1&r=0.3&n=1500"}}),
       kNoTopology},
      {"box_dmt", "dmt", of_vertices({{"input", "shape:box?n=2000"}}), kNoTopology},
      {"knot_points", "dmt_points", {{"input", "shape:knot?n=8000"}}, kNoTopology},
      {"double_torus_growth", "growth",
       of_vertices({{"input", "shape:doubleTorus?n=4000"}, {"epsilon", "30"}}), kNoTopology},
      {"double_torus_pole_bound", "growth",
       of_vertices({{"input", "shape:doubleTorus?n=4000"}, {"epsilon", "10"}, {"mode", "pole_bound"}}),
       kNoTopology},
      {"torus_feature_size", "local_feature_size", {{"input", "shape:torus?n=6000"}}, kNoTopology},
      {"double_torus_surface", "surface_stages", {{"input", "shape:doubleTorus?n=4000"}}, kNoTopology},
      {"torus_seed_polytope",
       "seed_polytope",
       {{"input", "shape:torus?n=2500"}, {"shrink", "0.6"}},
       kNoTopology},
      {"torus_outside", "outer_medial_axis", of_vertices({{"input", "shape:torus?n=6000"}}), kNoTopology},
      // A plate 2 x 2 x 0.04 within 0.01: balls for that are more than 3000.
      {"plate_ellipsoids",
       "ellipsoids",
       {{"input", "shape:box?R=1&r=0.02"}, {"delta", "0.5"}, {"spacing", "5"}},
       kNoTopology},
      {"plate_60_ellipsoids",
       "k_ellipsoids",
       {{"input", "shape:box?R=1&r=0.02"}, {"delta", "2"}, {"spacing", "10"}, {"k", "60"}},
       kNoTopology},
      {"double_torus_150_balls", "k_balls",
       of_vertices({{"input", "shape:doubleTorus?n=4000"}, {"k", "150"}}), kNoTopology},
      // A bump at a place that lies between those of the model.
      {"bump_box_completed",
       "shape_complete",
       {{"input", "shape:bumpBox?n=1500&r=0.65"},
        {"extent", "whole"},
        {"samples", "300"},
        {"model.points", "1000"}},
       kNoTopology},
      // A ring of genus 1, a large and a small tetrahedron, a triangle, in turns in one file.
      {"components",
       "split_components",
       {{"input", test::source_file("tests/data/components.off")}, {"components", "[0,1,2,3]"}},
       kNoTopology},
      {"label_ball", "label_surface", {}, kNoTopology},
  };
  return all;
}

/// The summaries of all outputs, which can be read in a diff, and the digests of all their bytes.
Json figures(const Dag& dag, const RunResult& result) {
  Json json = Json::object(), digests = Json::object();
  for (const DagOutput& output : dag.outputs) {
    for (const OutputEntry& entry : result.nodes[output.from.node].outputs) {
      if (entry.port != output.from.port) continue;
      json[output.name] = Json::parse(entry.summary);
      digests[output.name] = entry.digest.hex();
    }
  }
  json["digests"] = digests;
  return json;
}

class Golden : public testing::TestWithParam<Case> {};

TEST_P(Golden, has_the_topology_of_the_model_and_the_figures_of_before) {
  const Case& c = GetParam();
  const Dag dag =
      load_graph(test::source_file("graphs/" + std::string(c.graph) + ".json"), registry(), c.settings);
  Silent silent;
  Runner runner(dag, registry(), Store::open({}), {}, silent);
  const RunResult& result = runner.run();
  const std::vector<bool> needed = needed_nodes(dag);
  std::set<std::string> ran;
  for (const NodeResult& node : result.nodes) {
    if (node.status == NodeStatus::run) ran.insert(node.manifest);
  }
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    // Of nodes with equal keys one runs for all.
    const bool shared = result.nodes[i].status == NodeStatus::hit && ran.contains(result.nodes[i].manifest);
    if (shared && needed[i]) continue;
    ASSERT_EQ(result.nodes[i].status, needed[i] ? NodeStatus::run : NodeStatus::skipped)
        << dag.nodes[i].path << ": " << result.nodes[i].cause;
  }
  const Json now = figures(dag, result);
  if (c.euler_characteristic != kNoTopology) {
    EXPECT_EQ(now["alpha_shape"]["euler_characteristic"], c.euler_characteristic);
    EXPECT_EQ(now["medial_axis"]["euler_characteristic"], c.euler_characteristic);
    EXPECT_EQ(now["alpha_shape"]["betti"], Json({1, 1 - c.euler_characteristic, 0}));
    EXPECT_EQ(now["medial_axis"]["components"], 1);
    EXPECT_EQ(now["topology"]["surface"], now["alpha_shape"]["betti"]);
    EXPECT_EQ(now["topology"]["changes"], 0);
    EXPECT_EQ(now["check"]["uncovered"], 0);
    EXPECT_EQ(now["cover"]["remaining"], 0);
  }

  const std::string file = test::source_file("tests/golden/" + std::string(c.name) + ".json");
  const char* accept = std::getenv("BALLFLOW_TEST_ACCEPT");
  if (accept != nullptr && std::string(accept) == "1") {
    test::write_file(file, now.dump(1) + "\n");
    GTEST_SKIP() << "accepted into " << file;
  }
  ASSERT_TRUE(std::filesystem::exists(file)) << "run once with BALLFLOW_TEST_ACCEPT=1";
  EXPECT_EQ(now.dump(1) + "\n", test::read_file(file));
}

INSTANTIATE_TEST_SUITE_P(Pipelines, Golden, testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace ballflow
