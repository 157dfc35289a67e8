// What crosses the boundary between the engine and a node: only artifacts that are as declared, and no
// exception.
#include <stdexcept>

#include "ballflow/dot.hpp"
#include "ballflow/executor.hpp"
#include "ballflow/key.hpp"
#include "ballflow/schema.hpp"
#include "probe.hpp"
#include "run_fixture.hpp"

namespace ballflow {
namespace {

using BoundaryTest = RunTest;

/// Says that it is a list of numbers, and holds half the bytes of one.
ArtifactPtr forged_numbers() {
  static const std::vector<std::int32_t> values = {1, 2, 3};
  return Artifact::seal("Numbers", 1, {test::array_of("values", BF_I32, {3}, values)},
                        R"({"count":3,"first":1})", nullptr);
}

TEST_F(BoundaryTest, a_cached_artifact_that_is_not_as_declared_is_made_again) {
  Dag dag;
  const auto source = node(dag, "source", "Source", {}, {{"value", 2.5}});
  const auto round = node(dag, "round", "Round", {{"numbers", {source, "numbers"}}});
  dag.outputs.push_back({"rounded", "", {round, "rounded"}});
  const RunResult good = run(dag, Store::open({}));

  const auto where = store();
  const ArtifactPtr forged = forged_numbers();
  ASSERT_TRUE(where->put_blob(*forged, false));
  const ActionKey key = action_key(dag.nodes[source], {}, 0, *where);
  ASSERT_TRUE(where->put_action(key.key, {key.manifest, {test::entry_for(*forged, "numbers")}, {}, 0, 0}));

  const RunResult result = run(dag, where);
  ASSERT_EQ(result.nodes[round].outputs.size(), 1u);
  EXPECT_EQ(result.nodes[round].outputs[0].digest.hex(), good.nodes[round].outputs[0].digest.hex());
  const std::string said =
      "the cached artifact of numbers array \"values\" holds i32, must hold f64; it is made again";
  EXPECT_EQ(std::count(events.messages.begin(), events.messages.end(), said), 1);
}

/// One execution of a toy node, with what it is given.
ExecutionRequest request_for(const DagNode& node, const Registry& registry) {
  ExecutionRequest request;
  request.node = &node;
  request.registry = &registry;
  request.cancelled = [] { return false; };
  request.progress = [](double) {};
  request.message = [](bool, const std::string&) {};
  return request;
}

TEST_F(BoundaryTest, a_node_never_sees_an_artifact_that_is_not_as_declared) {
  Dag dag;
  const auto round = node(dag, "round", "Round");
  ExecutionRequest request = request_for(dag.nodes[round], registry);
  request.inputs["numbers"] = forged_numbers();
  const ExecutionOutcome outcome = in_process_executor()->execute(request);
  EXPECT_EQ(outcome.status, ExecutionOutcome::Status::failed);
  EXPECT_EQ(outcome.cause, "input \"numbers\" array \"values\" holds i32, must hold f64");
  EXPECT_EQ(toy::counters.round, 0);
}

TEST_F(BoundaryTest, an_array_that_a_node_hands_on_as_it_got_it_keeps_no_other_artifact) {
  // Else every state of a loop would keep all those before.
  Dag dag;
  const auto source = node(dag, "source", "Source", {}, {{"value", 2.5}, {"count", 4}});
  const auto hand = node(dag, "hand", "Slow", {}, {{"seconds", 0}});
  ExecutionOutcome outcome = in_process_executor()->execute(request_for(dag.nodes[source], registry));
  ASSERT_EQ(outcome.status, ExecutionOutcome::Status::ok) << outcome.cause;
  ArtifactPtr state = outcome.outputs.at("numbers");
  const void* const data = state->find("values")->data;
  for (int i = 0; i < 3; ++i) {
    const std::weak_ptr<const Artifact> before = state;
    ExecutionRequest request = request_for(dag.nodes[hand], registry);
    request.inputs["numbers"] = std::move(state);
    outcome = in_process_executor()->execute(request);
    ASSERT_EQ(outcome.status, ExecutionOutcome::Status::ok) << outcome.cause;
    state = outcome.outputs.at("numbers");
    request.inputs.clear();
    ASSERT_EQ(state->find("values")->data, data) << "nothing was copied";
    EXPECT_TRUE(before.expired()) << i;
  }
  outcome.outputs.clear();
  const auto* const values = static_cast<const double*>(state->find("values")->data);
  EXPECT_EQ(std::vector<double>(values, values + 4), std::vector<double>(4, 2.5)) << "and it is still there";
}

TEST_F(BoundaryTest, a_node_is_told_the_memory_of_the_run) {
  Dag dag;
  const auto heavy = node(dag, "heavy", "Heavy");
  ExecutionRequest request = request_for(dag.nodes[heavy], registry);
  request.memory_bytes = std::uint64_t{5} << 32;
  ASSERT_EQ(in_process_executor()->execute(request).status, ExecutionOutcome::Status::ok);
  EXPECT_EQ(toy::granted, request.memory_bytes);
}

TEST_F(BoundaryTest, what_a_host_throws_goes_around_the_node) {
  Dag dag;
  const auto babble = node(dag, "babble", "Babble");
  for (const bool in_progress : {true, false}) {
    ExecutionRequest request = request_for(dag.nodes[babble], registry);
    const auto interrupt = [] { throw std::out_of_range("interrupted from the keyboard"); };
    if (in_progress) {
      request.progress = [&](double) { interrupt(); };
    } else {
      request.message = [&](bool, const std::string&) { interrupt(); };
    }
    EXPECT_THROW(in_process_executor()->execute(request), std::out_of_range);
  }
}

/// Graphs with a port that takes a list.
struct ListPorts : RunTest {
  /// Sources "s1" to "s12", and Concat with these inputs.
  std::string text(const std::string& inputs) {
    std::string nodes;
    for (int i = 1; i <= 12; ++i) {
      nodes += R"("s)" + std::to_string(i) + R"(": { "type": "Source", "params": { "count": 1, "value": )" +
               std::to_string(i) + " } },\n";
    }
    return R"({ "nodes": { )" + nodes + R"("all": { "type": "Concat", "inputs": )" + inputs +
           R"( } }, "outputs": { "all": "all.all" } })";
  }
  Dag parse(const std::string& inputs) { return parse_graph(text(inputs), folder.file("g.json"), registry); }
  std::string problem(const std::string& inputs) {
    try {
      parse(inputs);
    } catch (const GraphError& error) {
      for (const Diagnostic& finding : error.findings()) {
        if (finding.severity == Diagnostic::Severity::error) return finding.message;
      }
    }
    return {};
  }
  std::vector<double> values(const Dag& dag, std::shared_ptr<Store> where) {
    Runner runner(dag, registry, std::move(where), {}, events);
    const RunResult result = runner.run();
    EXPECT_EQ(result.status, ExitCode::ok);
    const EdgeRef& from = dag.outputs.at(0).from;
    all = result.nodes.at(from.node);
    const ArtifactPtr numbers = runner.artifact(from);
    const auto* data = static_cast<const double*>(numbers->find("values")->data);
    return {data, data + numbers->find("values")->shape[0]};
  }
  NodeResult all;
};

TEST_F(ListPorts, hand_over_artifacts_in_the_order_of_the_graph) {
  const std::string twelve =
      R"(["s1.numbers", "s2.numbers", "s3.numbers", "s4.numbers", "s5.numbers", "s6.numbers", "s7.numbers",
          "s8.numbers", "s9.numbers", "s10.numbers", "s11.numbers", "s12.numbers"])";
  EXPECT_EQ(values(parse(R"({ "lists": )" + twelve + R"(, "last": "s1.numbers" })"), Store::open({})),
            (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 1}));
  EXPECT_EQ(values(parse(R"({ "lists": ["s2.numbers", "s1.numbers", "s2.numbers"] })"), Store::open({})),
            (std::vector<double>{2, 1, 2}));
  EXPECT_EQ(values(parse(R"({ "lists": "s3.numbers" })"), Store::open({})), (std::vector<double>{3}))
      << "one edge is a list of one";
}

TEST_F(ListPorts, order_and_number_are_in_the_key_and_explain_names_the_place) {
  const auto where = store();
  values(parse(R"({ "lists": ["s1.numbers", "s2.numbers"] })"), where);
  const std::string first = all.manifest;
  values(parse(R"({ "lists": ["s1.numbers", "s2.numbers"] })"), where);
  EXPECT_EQ(all.status, hit);
  values(parse(R"({ "lists": ["s2.numbers", "s1.numbers"] })"), where);
  EXPECT_EQ(all.status, ran);
  EXPECT_EQ(manifest_differences(first, all.manifest),
            (std::vector<std::string>{"input lists[0]: other content", "input lists[1]: other content"}));
  values(parse(R"({ "lists": ["s1.numbers"] })"), where);
  EXPECT_EQ(all.status, ran);
  EXPECT_EQ(manifest_differences(first, all.manifest), (std::vector<std::string>{"input lists[1] is gone"}));
  EXPECT_EQ(key_of(first).hex(), key_of(first).hex());
}

TEST_F(ListPorts, are_checked_edge_by_edge) {
  EXPECT_EQ(problem("{}"), "node \"all\" (Concat) misses its input \"lists\" (Numbers)");
  EXPECT_EQ(problem(R"({ "lists": [] })"), "node \"all\" (Concat) misses its input \"lists\" (Numbers)");
  EXPECT_EQ(problem(R"({ "lists": ["s1.numbers"], "last": ["s1.numbers"] })"),
            "input \"last\" of node \"all\" (Concat) takes one artifact, not a list");
  EXPECT_EQ(problem(R"({ "lists": ["s1.numbers", 7] })"), "an edge must be a text \"node.port\", is 7");
  EXPECT_EQ(problem(R"({ "lists": ["s1.numbers", "s2.nothing"] })"),
            "node \"s2\" (Source) has no output \"nothing\"");
  EXPECT_EQ(problem(R"({ "lists": ["s1.numbers"], "lists[1]": "s2.numbers" })"),
            "node \"all\" (Concat) has no input \"lists[1]\"");
}

TEST_F(ListPorts, are_drawn_and_in_the_schema) {
  const std::string drawn = dot(parse(R"({ "lists": ["s1.numbers", "s2.numbers"] })"), {});
  std::size_t edges = 0;
  for (std::size_t at = 0; (at = drawn.find(":in_lists:w", at)) != std::string::npos; ++at) ++edges;
  EXPECT_EQ(edges, 2u);
  const Json inputs = nodes_schema(registry).at("definitions").at("Concat").at("properties").at("inputs");
  EXPECT_EQ(inputs.at("properties").at("lists").at("anyOf").at(1).at("minItems"), 1);
  EXPECT_EQ(inputs.at("properties").at("last").at("type"), "string");
}

}  // namespace
}  // namespace ballflow
