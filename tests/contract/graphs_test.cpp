// Every graph in graphs/ is a runnable example: it loads, runs on a generated model, and its result depends
// neither on the number of threads nor on the processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "ballflow/run.hpp"
#include "process.hpp"
#include "quick_graphs.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

/// Set in a process that computes with most threads, as on a processor without FMA and AVX2, and compares
/// nothing.
constexpr char on_other_processor[] = "BALLFLOW_TEST_ON_OTHER_PROCESSOR";

bool is_on_other_processor() { return std::getenv(on_other_processor) != nullptr; }

RunResult run_with(const Dag& dag, unsigned threads) {
  Silent silent;
  RunOptions options;
  options.threads = threads;
  Runner runner(dag, registry(), results_with(threads), options, silent);
  return runner.run();
}

/// The test that calls, once more in a process of its own: functions of the C library choose their
/// instructions by the processor, and glibc lets a process leave some out.
std::string repeat_on_other_processor() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const test::ProcessResult result = test::run_process(
      {"/proc/self/exe", std::string("--gtest_filter=") + test.test_suite_name() + "." + test.name()},
      {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2"}, {on_other_processor, "1"}});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  return result.out;
}

/// Results with each number of threads, ascending; those with most threads as of a processor without FMA and
/// AVX2.
std::vector<RunResult> run_with_threads(const Dag& dag, const std::vector<unsigned>& threads) {
  std::vector<RunResult> results;
  if (is_on_other_processor()) {
    results.push_back(run_with(dag, threads.back()));
    return results;
  }
  repeat_on_other_processor();
  for (const unsigned count : threads) results.push_back(run_with(dag, count));
  // Or nothing would have been compared with.
  for (std::size_t i = 0; i < dag.nodes.size(); ++i)
    EXPECT_NE(results.back().nodes[i].status, NodeStatus::run)
        << dag.nodes[i].path << " had not been computed on the other processor";
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
    Runner runner(dag, registry(), results_with(is_on_other_processor() ? 4 : 1), {}, silent);
    EXPECT_EQ(runner.run().status, ExitCode::ok);
    const auto prior = std::find_if(dag.outputs.begin(), dag.outputs.end(),
                                    [](const DagOutput& output) { return output.name == "prior"; });
    return runner.artifact(prior->from);
  }();
  return model;
}

// Else equal digests would say nothing.
TEST(OtherProcessor, rounds_exponentials_otherwise) {
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no FMA either";
  std::ostringstream all;  // one in a thousand differs
  for (int i = 1; i < 20000; ++i) all << std::hexfloat << std::exp(0.000731 * i) << ' ';
  const std::string bits = "exponentials " + sha256(all.str()).hex();
  std::printf("%s\n", bits.c_str());
  if (is_on_other_processor()) return;
  const std::string there = repeat_on_other_processor();
  EXPECT_NE(there.find("exponentials "), std::string::npos) << there;
  EXPECT_EQ(there.find(bits), std::string::npos);
}

class EveryGraph : public testing::TestWithParam<std::string> {};

TEST_P(EveryGraph, runs_on_a_generated_model_with_equal_digests_for_any_number_of_threads) {
  const std::string file = test::source_file("graphs/" + GetParam() + ".json");
  std::map<std::string, ArtifactPtr> given;
  if (GetParam() == "shape_instance" || GetParam() == "shape_fit") given["prior"] = model_of_shapes();
  const Dag dag = load_graph(file, registry(), quick_settings(GetParam(), given), {}, given);
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
                             {{"input", "shape:torus?n=4000"}, {"strategy", GetParam()}});
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
                 {{"input", "shape:torus?n=4000"}, {"strategy", "greedy"}, {"repair", GetParam()}});
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

TEST(Samplings, of_the_vertices_lead_to_an_axis_with_equal_digests_for_any_number_of_threads) {
  const Dag dag =
      load_graph(test::source_file("graphs/medial_axis.json"), registry(),
                 {{"input", "shape:torus?n=2000"}, {"strategy", "hybrid"}, {"sampling", "vertices"}});
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
