// Every graph in graphs/ is a runnable example: it loads, runs on a generated model, and its result does not
// depend on the number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "ballflow/run.hpp"
#include "built_registry.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_file(folder))) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Of the node libraries and of this program: what other builds made does not count.
std::string build_mark() {
  std::string files = "/proc/self/exe";
  for (const PluginCandidate& library : registry().candidates()) files += '\n' + library.path;
  std::string states;
  std::istringstream lines(files);
  for (std::string file; std::getline(lines, file);) {
    states += file + ' ' + std::to_string(std::filesystem::file_size(file)) + ' ' +
              std::to_string(std::filesystem::last_write_time(file).time_since_epoch().count()) + '\n';
  }
  return sha256(states).hex().substr(0, 16);
}

/// A store for each number of threads, which the tests of all graphs share: what graphs have in common is
/// computed once with each of these numbers, by one test or another, and compared wherever it is looked at.
std::shared_ptr<Store> results_with(unsigned threads) {
  static const std::string root = test::binary_file("tests/contract/results/" + build_mark());
  std::filesystem::create_directories(root);
  return Store::open({root + "/" + std::to_string(threads), false, {}});
}

std::vector<RunResult> run_with_threads(const Dag& dag, const std::vector<unsigned>& threads) {
  std::vector<RunResult> results;
  for (const unsigned count : threads) {
    Silent silent;
    RunOptions options;
    options.threads = count;
    Runner runner(dag, registry(), results_with(count), options, silent);
    results.push_back(runner.run());
  }
  return results;
}

/// Of two nodes with one key, in one graph or in two, one runs and the other one takes its result, whichever
/// comes first.
bool has_result(NodeStatus status) { return status == NodeStatus::run || status == NodeStatus::hit; }

void expect_equal_digests(const Dag& dag, const std::vector<RunResult>& results) {
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    for (const RunResult& result : results) {
      ASSERT_EQ(has_result(result.nodes[i].status), has_result(results[0].nodes[i].status))
          << dag.nodes[i].path << ": " << result.nodes[i].cause;
      for (std::size_t port = 0; port < result.nodes[i].outputs.size(); ++port) {
        EXPECT_EQ(result.nodes[i].outputs[port].digest, results[0].nodes[i].outputs[port].digest)
            << dag.nodes[i].path << "." << result.nodes[i].outputs[port].port;
      }
    }
  }
}

/// A model of shapes, made once: graphs that take one have no default.
ArtifactPtr model_of_shapes() {
  static const ArtifactPtr model = [] {
    const Dag dag = load_graph(test::source_file("graphs/shape_prior.json"), registry(),
                               {{"balls", "20"}, {"points", "1000"}, {"samples", "300"}});
    Silent silent;
    Runner runner(dag, registry(), Store::open({}), {}, silent);
    EXPECT_EQ(runner.run().status, ExitCode::ok);
    const auto prior = std::find_if(dag.outputs.begin(), dag.outputs.end(),
                                    [](const DagOutput& output) { return output.name == "prior"; });
    return runner.artifact(prior->from);
  }();
  return model;
}

class EveryGraph : public testing::TestWithParam<std::string> {};

TEST_P(EveryGraph, runs_on_a_generated_model_with_equal_digests_for_any_number_of_threads) {
  const std::string file = test::source_file("graphs/" + GetParam() + ".json");
  std::map<std::string, ArtifactPtr> given;
  if (GetParam() == "shape_instance" || GetParam() == "shape_fit") given["prior"] = model_of_shapes();
  const bool takes_input = load_graph(file, registry(), {}, {}, given).params.count("input") != 0;
  std::vector<Setting> settings;
  if (takes_input) settings.push_back({"input", "shape:torus?n=4000"});
  // Fits with many balls take longest, and differ from these in their number alone.
  if (GetParam() == "robot_spheres") settings.push_back({"curves.fits", "2,4"});
  // A part can lie in many ways on the whole, which takes long.
  if (GetParam() == "shape_fit" || GetParam() == "shape_complete")
    settings = {{"input", "shape:bumpBox?n=1500&r=0.65"}, {"extent", "whole"}, {"samples", "300"}};
  if (GetParam() == "shape_prior") settings = {{"points", "1000"}, {"samples", "300"}};
  if (GetParam() == "shape_complete") settings.push_back({"model.points", "1000"});
  // Comparing takes most of the time, and looks at as many things with fewer samples.
  if (GetParam() == "ellipsoids" || GetParam() == "k_ellipsoids")
    settings.insert(settings.end(), {{"spacing", "5"}, {"delta", "2"}});
  if (GetParam() == "ellipsoids") settings.push_back({"epsilon", "2"});
  const Dag dag = load_graph(file, registry(), settings, {}, given);
  EXPECT_FALSE(dag.doc.empty());
  const auto results = run_with_threads(dag, {1, 2, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

INSTANTIATE_TEST_SUITE_P(Graphs, EveryGraph, testing::ValuesIn(names_in("graphs")),
                         [](const auto& instance) { return instance.param; });

class EveryExperiment : public testing::TestWithParam<std::string> {};

TEST_P(EveryExperiment, runs_on_a_generated_model_and_shares_what_its_variants_have_in_common) {
  const std::string file = test::source_file("graphs/experiments/" + GetParam() + ".json");
  const Json document = Json::parse(test::read_file(file), nullptr, true, true);
  std::vector<Setting> settings;
  if (document.at("params").contains("input")) settings.push_back({"input", "shape:torus?n=1500"});
  const Dag dag = load_graph(file, registry(), settings);
  EXPECT_FALSE(dag.doc.empty());
  ASSERT_GT(dag.variants.size(), 1u);
  std::size_t alone = 0;
  for (const Variant& variant : dag.variants) alone += variant.nodes.size();
  EXPECT_LT(dag.nodes.size(), alone);
  const auto results = run_with_threads(dag, {1, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

INSTANTIATE_TEST_SUITE_P(Experiments, EveryExperiment, testing::ValuesIn(names_in("graphs/experiments")),
                         [](const auto& instance) { return instance.param; });

TEST(GraphFiles, fit_the_schema_for_editors) {
  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3 with jsonschema is not installed";
  const test::TempFolder folder;
  Json graphs = Json::object();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_file("graphs"))) {
    if (entry.path().extension() == ".json")
      graphs[entry.path().string()] =
          Json::parse(test::read_file(entry.path().string()), nullptr, true, true);
  }
  ASSERT_GT(graphs.size(), 5u);
  test::write_file(folder.file("graphs.json"), graphs.dump());
  test::write_file(folder.file("check.py"), R"(
import json, sys, jsonschema
validator = jsonschema.Draft7Validator(json.load(open(sys.argv[1])))
wrong = [(file, error.message) for file, graph in json.load(open(sys.argv[2])).items() for error in validator.iter_errors(graph)]
for one in wrong: print(*one)
sys.exit(1 if wrong else 0)
)");
  const std::string command = "python3 '" + folder.file("check.py") + "' '" +
                              test::source_file("schemas/graph.schema.json") + "' '" +
                              folder.file("graphs.json") + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

class EveryStrategy : public testing::TestWithParam<std::string> {};

TEST_P(EveryStrategy, prunes_in_any_graph_with_equal_digests_for_any_number_of_threads) {
  const Dag dag = load_graph(test::source_file("graphs/medial_axis.json"), registry(),
                             {{"input", "shape:torus?n=3000"}, {"strategy", GetParam()}});
  const auto results = run_with_threads(dag, {1, 2, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
  const DagNode* select = dag.find("select");
  ASSERT_NE(select, nullptr);
}

class EveryRepair : public testing::TestWithParam<std::string> {};

TEST_P(EveryRepair, follows_any_pruning_with_equal_digests_for_any_number_of_threads) {
  const Dag dag =
      load_graph(test::source_file("graphs/medial_axis.json"), registry(),
                 {{"input", "shape:torus?n=3000"}, {"strategy", "greedy"}, {"repair", GetParam()}});
  const auto results = run_with_threads(dag, {1, 2, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

class EveryFeatureSize : public testing::TestWithParam<std::string> {};

TEST_P(EveryFeatureSize, measures_with_equal_digests_for_any_number_of_threads) {
  const Dag dag = load_graph(test::source_file("graphs/local_feature_size.json"), registry(),
                             {{"input", "shape:torus?n=1000"}, {"to", GetParam()}});
  const auto results = run_with_threads(dag, {1, 2, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

INSTANTIATE_TEST_SUITE_P(FeatureSizes, EveryFeatureSize, testing::ValuesIn(names_in("graphs/feature_size")),
                         [](const auto& instance) { return instance.param; });

class EveryLfsFrom : public testing::TestWithParam<std::string> {};

TEST_P(EveryLfsFrom, gives_a_surface_with_equal_digests_for_any_number_of_threads) {
  const Dag dag = load_graph(test::source_file("graphs/surface_stages.json"), registry(),
                             {{"input", "shape:torus?n=2000"}, {"lfs_from", GetParam()}});
  const auto results = run_with_threads(dag, {1, 2, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

INSTANTIATE_TEST_SUITE_P(LfsFrom, EveryLfsFrom, testing::ValuesIn(names_in("graphs/lfs_from")),
                         [](const auto& instance) { return instance.param; });

INSTANTIATE_TEST_SUITE_P(Repairs, EveryRepair, testing::ValuesIn(names_in("graphs/repair")),
                         [](const auto& instance) { return instance.param; });

class EveryRobustness : public testing::TestWithParam<std::string> {};

TEST_P(EveryRobustness, makes_a_surface_possible_with_equal_digests_for_any_number_of_threads) {
  const Dag dag = load_graph(test::source_file("graphs/surface_stages.json"), registry(),
                             {{"input", "shape:torus?n=1500"}, {"robustness", GetParam()}});
  EXPECT_TRUE(dag.warnings.empty());
  const auto results = run_with_threads(dag, {1, 4});
  ASSERT_EQ(results[0].status, ExitCode::ok);
  expect_equal_digests(dag, results);
}

INSTANTIATE_TEST_SUITE_P(Robustness, EveryRobustness, testing::ValuesIn(names_in("graphs/robustness")),
                         [](const auto& instance) { return instance.param; });

INSTANTIATE_TEST_SUITE_P(Strategies, EveryStrategy, testing::ValuesIn(names_in("graphs/strategies")),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace ballflow
