// What the scheduler asks of an executor.
#include <gtest/gtest.h>

#include "scheduler_fixture.hpp"

namespace ballflow {
namespace {

TEST_F(SchedulerTest, the_executor_is_asked_once_for_every_node_with_its_inputs) {
  const auto a = node("a"), b = node("b"), sum = node("sum", {a, b});
  output(sum);
  executor->values = {{"a", 3}, {"b", 4}};
  executor->during = [](const ExecutionRequest& request) {
    if (request.node->path != "sum") return;
    EXPECT_EQ(*static_cast<const double*>(request.inputs.at("in0")->find("values")->data), 3);
    EXPECT_EQ(*static_cast<const double*>(request.inputs.at("in1")->find("values")->data), 4);
    EXPECT_EQ(request.threads, 2u);
  };
  EXPECT_EQ(run(options(2)).status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 3u);
  EXPECT_EQ(run(options(2)).nodes[sum].status, NodeStatus::hit);
  EXPECT_EQ(executor->started.size(), 3u);
}

TEST_F(SchedulerTest, what_goes_wrong_around_a_node_fails_the_node) {
  output(node("a"));
  executor->during = [](const ExecutionRequest&) {
    throw Error(ExitCode::node_failed, "the other machine is gone", "start it");
  };
  const RunResult thrown = run(options(1));
  EXPECT_EQ(thrown.nodes[0].status, NodeStatus::failed);
  EXPECT_EQ(thrown.nodes[0].cause, "the other machine is gone");
  EXPECT_EQ(thrown.nodes[0].hint, "start it");

  executor->during = nullptr;
  executor->change = [](ExecutionOutcome& outcome) { outcome.outputs.clear(); };
  EXPECT_EQ(run(options(1)).nodes[0].cause, "the executor gave no output \"out\" of type Numbers");
  executor->change = [this](ExecutionOutcome& outcome) {
    outcome.outputs["out"] = numbers(executor->live, 1, 1, 2);
  };
  EXPECT_EQ(run(options(1)).nodes[0].status, NodeStatus::failed) << "another version of the type";
}

}  // namespace
}  // namespace ballflow
