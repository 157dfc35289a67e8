// Artifacts as inputs of a graph, and what a failed node leaves so that it can be run alone.
#include <gtest/gtest.h>

#include <filesystem>

#include "ballflow/run.hpp"
#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class Listener final : public EventSink {
 public:
  void on(const Event& event) override {
    if (hear) hear(event);
  }
  std::function<void(const Event&)> hear;
};

ArtifactPtr numbers(std::vector<double> values) {
  const auto owner = std::make_shared<std::vector<double>>(std::move(values));
  const Json summary = {{"count", owner->size()}, {"first", owner->front()}};
  return Artifact::seal("Numbers", 1, {{"values", BF_F64, {owner->size()}, owner->data()}}, summary.dump(),
                        owner);
}

struct GivenTest : testing::Test {
  GivenTest() {
    registry.add_plugin(toy::plugin(), "toy");
    toy::reset();
  }

  Dag parse(const std::string& text, const std::map<std::string, ArtifactPtr>& given) {
    return parse_graph(text, folder.file("graph.json"), registry, {}, {}, given);
  }
  std::string problem(const std::string& text, const std::map<std::string, ArtifactPtr>& given) {
    try {
      parse(text, given);
    } catch (const GraphError& error) {
      return error.findings().at(0).message;
    }
    return {};
  }
  RunResult run(const Dag& dag, std::shared_ptr<Store> store) {
    Runner runner(dag, registry, std::move(store), {}, events);
    const RunResult result = runner.run();
    if (result.status == ExitCode::ok && !dag.outputs.empty()) output = runner.artifact(dag.outputs[0].from);
    return result;
  }
  std::shared_ptr<Store> store() { return Store::open({folder.file("cache"), false}); }
  static const NodeResult& of(const Dag& dag, const RunResult& result, const std::string& path) {
    return result.nodes.at(static_cast<std::size_t>(dag.find(path) - dag.nodes.data()));
  }

  Registry registry;
  test::TempFolder folder;
  Listener events;
  ArtifactPtr output;
};

const char* const sum_of_two = R"({
  "inputs": { "a": { "type": "Numbers" }, "b": { "type": "Numbers", "optional": true } },
  "nodes": { "sum": { "type": "Add", "inputs": { "a": "inputs.a", "b": "inputs.b" } } },
  "outputs": { "sum": "sum.sum", "a": "inputs.a" } })";

TEST_F(GivenTest, are_read_by_nodes_and_may_be_outputs) {
  const ArtifactPtr two = numbers({2, 2});
  const Dag dag = parse(sum_of_two, {{"a", two}, {"b", numbers({1, 3})}});
  const RunResult result = run(dag, Store::open({}));
  ASSERT_EQ(result.status, ExitCode::ok);
  const auto* values = static_cast<const double*>(output->find("values")->data);
  EXPECT_EQ(std::vector<double>(values, values + 2), (std::vector<double>{3, 5}));
  EXPECT_EQ(of(dag, result, "inputs/a").status, NodeStatus::hit);
  EXPECT_EQ(of(dag, result, "inputs/a").outputs.at(0).digest, two->digest());
  EXPECT_EQ(dag.outputs.at(1).name, "a");
  EXPECT_EQ(dag.nodes.at(dag.outputs.at(1).from.node).path, "inputs/a");
}

TEST_F(GivenTest, give_the_same_key_as_the_node_that_made_them) {
  const auto cache = store();
  const Dag whole = parse(R"({ "nodes": {
      "two": { "type": "Source", "params": { "value": 2, "count": 2 } },
      "sum": { "type": "Add", "inputs": { "a": "two.numbers" } } },
    "outputs": { "sum": "sum.sum" } })",
                          {});
  const RunResult first = run(whole, cache);
  ASSERT_EQ(first.status, ExitCode::ok);
  const ArtifactPtr two = cache->load(of(whole, first, "two").outputs.at(0));
  ASSERT_NE(two, nullptr);
  const Dag alone = parse(sum_of_two, {{"a", two}});
  const RunResult second = run(alone, cache);
  EXPECT_EQ(of(alone, second, "sum").status, NodeStatus::hit);
  EXPECT_EQ(of(alone, second, "sum").manifest, of(whole, first, "sum").manifest);
  EXPECT_EQ(plan(alone, *cache, 0, {}).at(1).verdict, NodePlan::Verdict::hit);
  EXPECT_EQ(toy::counters.add, 1);
}

TEST_F(GivenTest, must_fit_the_inputs_of_the_graph) {
  EXPECT_EQ(problem(sum_of_two, {}), "input \"a\" (Numbers) is not connected");
  EXPECT_EQ(problem(sum_of_two, {{"a", numbers({1})}, {"c", numbers({1})}}), "the graph has no input \"c\"");
  const ArtifactPtr other = Artifact::seal("Letters", 1, {}, "{}", nullptr);
  EXPECT_EQ(problem(sum_of_two, {{"a", other}}),
            "input \"a\" takes a Numbers, but the artifact is a Letters");
  const ArtifactPtr newer = Artifact::seal("Numbers", 2, {}, "{}", nullptr);
  EXPECT_EQ(problem(sum_of_two, {{"a", newer}}),
            "\"inputs.a\" is a Numbers version 2, but input \"a\" of node \"sum\" (Add) takes version 1");
}

TEST_F(GivenTest, reach_the_nodes_of_subgraphs_and_loops) {
  test::write_file(folder.file("body.json"), R"({
    "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } } },
    "outputs": { "n": "add.sum" } })");
  test::write_file(folder.file("inner.json"), R"({
    "inputs": { "from": { "type": "Numbers" }, "by": { "type": "Numbers" } },
    "nodes": { "loop": { "loop": "body.json", "inputs": { "n": "inputs.from", "one": "inputs.by" },
                         "until": "n.first >= 10" } },
    "outputs": { "n": "loop.n" } })");
  const Dag dag = parse(R"({
    "inputs": { "a": { "type": "Numbers" }, "b": { "type": "Numbers" } },
    "nodes": { "inner": { "graph": "inner.json", "inputs": { "from": "inputs.a", "by": "inputs.b" } } },
    "outputs": { "n": "inner.n" } })",
                        {{"a", numbers({4})}, {"b", numbers({4})}});
  ASSERT_EQ(run(dag, Store::open({})).status, ExitCode::ok);
  EXPECT_EQ(*static_cast<const double*>(output->find("values")->data), 12);
}

const char* const doubled = R"({
  "params": { "numbers": { "kind": "artifact", "type": "Numbers", "doc": "to be doubled" } },
  "nodes": { "sum": { "type": "Add", "inputs": { "a": "${numbers}", "b": "${numbers}" } } },
  "outputs": { "sum": "sum.sum" } })";

/// A host that knows artifacts by name.
struct Shelf {
  std::map<std::string, ArtifactPtr> artifacts;
  int asked = 0;
  FindArtifact find() {
    return [this](const std::string& name) {
      ++asked;
      const auto found = artifacts.find(name);
      if (found == artifacts.end())
        throw Error(ExitCode::usage, "there is no artifact " + name, "look elsewhere");
      return found->second;
    };
  }
};

TEST_F(GivenTest, a_parameter_may_be_an_artifact_by_name_by_default_or_from_the_host) {
  Shelf shelf{{{"two.safetensors", numbers({2})}, {"three.safetensors", numbers({3})}}};
  const auto value_with = [&](const std::string& text, const std::vector<Setting>& sets,
                              const std::map<std::string, ArtifactPtr>& given) {
    const Dag dag = parse_graph(text, folder.file("graph.json"), registry, sets, {}, given, shelf.find());
    EXPECT_EQ(dag.params.at("numbers"), dag.nodes.at(0).kind.given()->artifact->digest().hex());
    EXPECT_EQ(run(dag, Store::open({})).status, ExitCode::ok);
    return *static_cast<const double*>(output->find("values")->data);
  };
  EXPECT_EQ(value_with(doubled, {{"numbers", "two.safetensors"}}, {}), 4);
  EXPECT_EQ(value_with(doubled, {{"numbers", "two.safetensors"}, {"numbers", "three.safetensors"}}, {}), 6);
  EXPECT_EQ(value_with(doubled, {}, {{"numbers", numbers({5})}}), 10);
  std::string with_default = doubled;
  with_default.replace(with_default.find("\"doc\""), 0, "\"default\": \"three.safetensors\", ");
  EXPECT_EQ(value_with(with_default, {}, {}), 6);
}

TEST_F(GivenTest, what_is_wrong_with_an_artifact_parameter_is_said_where_it_is) {
  Shelf shelf{{{"letters", Artifact::seal("Letters", 1, {}, "{}", nullptr)},
               {"halves", Artifact::seal("Numbers", 1, {}, R"({"count":0,"first":null})", nullptr)}}};
  const auto problem_with = [&](const std::string& text, const std::vector<Setting>& sets) {
    try {
      parse_graph(text, folder.file("graph.json"), registry, sets, {}, {}, shelf.find());
    } catch (const GraphError& error) {
      for (const Diagnostic& finding : error.findings()) {
        if (finding.severity == Diagnostic::Severity::error) return finding.message;
      }
    }
    return std::string();
  };
  EXPECT_EQ(problem_with(doubled, {}), "parameter \"numbers\" has no value");
  EXPECT_EQ(problem_with(doubled, {{"numbers", "nothing"}}),
            "parameter \"numbers\": there is no artifact nothing");
  EXPECT_EQ(problem_with(doubled, {{"numbers", "letters"}}),
            "parameter \"numbers\": \"letters\" is a \"Letters\" version 1, must be a \"Numbers\" version 1");
  EXPECT_EQ(problem_with(doubled, {{"numbers", "halves"}}),
            "parameter \"numbers\": \"halves\" has no array \"values\" (the numbers)");
  EXPECT_EQ(problem(doubled, {}), "parameter \"numbers\" has no value");
  const auto with = [](const std::string& params, const std::string& edge) {
    return R"({ "params": { )" + params + R"( }, "nodes": { "sum": { "type": "Add", "inputs": { "a": ")" +
           edge + R"(" } } }, "outputs": { "sum": "sum.sum" } })";
  };
  EXPECT_EQ(problem_with(with(R"("n": { "kind": "artifact" })", "${n}"), {}),
            "parameter \"n\" is an artifact without \"type\"");
  EXPECT_EQ(problem_with(with(R"("n": { "kind": "number", "default": 1 })", "${n}"), {}),
            "parameter \"n\" is of kind number, an edge needs an artifact");
  EXPECT_EQ(problem_with(with(R"("n": { "kind": "number", "type": "Numbers", "default": 1 })", "${n}"), {}),
            "\"type\" is for the kind artifact, the parameter is of kind number");
  EXPECT_EQ(problem_with(with(R"("n": { "kind": "number", "default": 1 })", "${m}"), {}),
            "the graph has no parameter \"m\"");
}

TEST_F(GivenTest, a_sweep_over_artifacts_computes_each_once_and_looks_for_it_once) {
  Shelf shelf{{{"two", numbers({2})}, {"three", numbers({3})}}};
  const std::string text = R"({
    "params": { "numbers": { "kind": "artifact", "type": "Numbers" }, "by": { "kind": "number", "default": 1 } },
    "sweep": { "axes": { "numbers": ["two", "three"], "by": [1, 2] } },
    "nodes": { "sum": { "type": "Add", "inputs": { "a": "${numbers}" } },
               "step": { "type": "Step", "inputs": { "numbers": "sum.sum" }, "params": { "by": "${by}" } } },
    "outputs": { "step": "step.numbers" } })";
  const Dag dag = parse_graph(text, folder.file("graph.json"), registry, {}, {}, {}, shelf.find());
  EXPECT_EQ(shelf.asked, 2);
  EXPECT_EQ(dag.variants.size(), 4u);
  const RunResult result = run(dag, Store::open({}));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(toy::counters.add, 2);
}

TEST_F(GivenTest, a_failed_node_leaves_its_inputs_in_the_store_even_if_nobody_had_stored_them) {
  const auto cache = store();
  const Dag dag = parse(R"({ "nodes": {
      "much": { "type": "Source", "params": { "count": 3 } },
      "fail": { "type": "Fail", "inputs": { "numbers": "much.numbers" } } },
    "outputs": { "n": "fail.numbers" } })",
                        {});
  events.hear = [&](const Event& event) {
    const bool fail_starts =
        event.kind == Event::Kind::node_started && dag.nodes.at(event.node).path == "fail";
    if (!fail_starts) return;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder.file("cache/cas"))) {
      if (file.is_regular_file()) std::filesystem::remove(file);
    }
  };
  const RunResult result = run(dag, cache);
  events.hear = {};
  const NodeResult& failed = of(dag, result, "fail");
  ASSERT_EQ(failed.status, NodeStatus::failed);
  ASSERT_TRUE(failed.failed_call);
  EXPECT_EQ(failed.failed_call->node, dag.find("fail"));
  const OutputEntry& input = failed.failed_call->inputs.at("numbers");
  EXPECT_EQ(input.digest, of(dag, result, "much").outputs.at(0).digest);
  ASSERT_TRUE(cache->has_blob(input));

  const Dag again = parse(R"({
    "inputs": { "numbers": { "type": "Numbers" } },
    "nodes": { "fail": { "type": "Fail", "inputs": { "numbers": "inputs.numbers" } } },
    "outputs": { "n": "fail.numbers" } })",
                          {{"numbers", cache->load(input)}});
  const RunResult repeated = run(again, cache);
  EXPECT_EQ(of(again, repeated, "fail").cause, failed.cause);
}

TEST_F(GivenTest, a_failure_in_nested_loops_leaves_the_state_of_that_iteration) {
  test::write_file(folder.file("step.json"), R"({
    "inputs": { "n": { "type": "Numbers" } },
    "nodes": { "step": { "type": "Step", "inputs": { "numbers": "inputs.n" }, "params": { "fail_at": 7 } } },
    "outputs": { "n": "step.numbers" } })");
  test::write_file(folder.file("rounds.json"), R"({
    "inputs": { "n": { "type": "Numbers" } },
    "nodes": { "down": { "type": "Round", "inputs": { "numbers": "inputs.n" } },
               "inner": { "loop": "step.json", "inputs": { "n": "down.rounded" }, "until": "n.first >= 20" } },
    "outputs": { "n": "inner.n" } })");
  const auto cache = store();
  const Dag dag = parse(R"({ "nodes": {
      "start": { "type": "Source", "params": { "value": 2.5, "count": 1 } },
      "outer": { "loop": "rounds.json", "inputs": { "n": "start.numbers" }, "until": "n.first >= 10" } },
    "outputs": { "n": "outer.n" } })",
                        {});
  const RunResult result = run(dag, cache);
  const NodeResult& failed = of(dag, result, "outer");
  ASSERT_EQ(failed.status, NodeStatus::failed);
  ASSERT_TRUE(failed.failed_call);
  EXPECT_EQ(failed.failed_call->node->path, "outer/inner/step");
  const ArtifactPtr state = cache->load(failed.failed_call->inputs.at("numbers"));
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(*static_cast<const double*>(state->find("values")->data), 7);
}

}  // namespace
}  // namespace ballflow
