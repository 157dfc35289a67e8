// What crosses the boundary between the engine and a node: only artifacts that are as declared, and no
// exception.
#include <stdexcept>

#include "ballflow/executor.hpp"
#include "ballflow/key.hpp"
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
  const RunResult good = run(dag, nullptr);

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

}  // namespace
}  // namespace ballflow
