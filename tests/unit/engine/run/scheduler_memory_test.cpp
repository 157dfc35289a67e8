// Nodes and outputs under a budget of memory.
#include <gtest/gtest.h>

#include "scheduler_fixture.hpp"

namespace ballflow {
namespace {

TEST_F(SchedulerTest, producers_of_large_outputs_wait_while_slow_consumers_hold_them) {
  // 24 MB in all, every consumer also reads a node that ends only when all producers have ended or one has to
  // wait.
  constexpr std::size_t producers = 24;
  constexpr std::uint64_t budget = megabytes(10);
  const auto slow = node("slow");
  std::size_t ended = 0;
  for (std::size_t i = 0; i < producers; ++i) {
    const auto producer = node("producer" + std::to_string(i));
    executor->sizes["producer" + std::to_string(i)] = megabyte;
    output(node("consumer" + std::to_string(i), {producer, slow}));
  }
  ears.hears = [&](const Event& event) {
    if (event.kind == Event::Kind::node_finished && dag.nodes[event.node].path.rfind("producer", 0) == 0)
      ++ended;
  };
  executor->during = [&](const ExecutionRequest& request) {
    if (request.node->path == "slow") ears.wait([&] { return ended == producers || !ears.waited.empty(); });
  };
  const RunResult result = run(options(4, budget), Store::open({}));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 2 * producers + 1) << "nothing runs twice";
  EXPECT_LE(executor->live.most(), budget);
  EXPECT_GE(executor->live.most(), megabytes(5)) << "the budget is used";
  std::uint64_t outputs = 0;
  for (const DagOutput& one : dag.outputs) outputs += result.nodes[one.from.node].outputs.at(0).bytes;
  EXPECT_EQ(ears.memory_at_end, outputs) << "outputs of the graph are held to the end, and nothing else";
}

TEST_F(SchedulerTest, outputs_of_the_graph_that_only_memory_has_count_to_the_end) {
  constexpr std::size_t count = 8;
  for (std::size_t i = 0; i < count; ++i) {
    output(node("n" + std::to_string(i)));
    executor->sizes["n" + std::to_string(i)] = megabyte;
  }
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, int>> seen;  // held, running
  executor->during = [&](const ExecutionRequest&) {
    // Another one runs beside this one, or has to wait, or none is left.
    ears.wait([&] { return ears.most_running > 1 || !ears.waited.empty(); });
    const std::scoped_lock lock(mutex, executor->mutex);
    seen.emplace_back(executor->live.now(), executor->running);
  };
  EXPECT_EQ(run(options(2, megabytes(4)), Store::open({})).status, ExitCode::ok);
  for (const auto& [held, running] : seen) {
    if (held >= megabytes(4)) {
      EXPECT_EQ(running, 1) << held << " bytes were held: one at a time, or nothing would ever end";
    }
  }
  EXPECT_EQ(executor->live.now(), 0u) << "the runner is gone";
  EXPECT_EQ(executor->live.most(), megabytes(count));
}

TEST_F(SchedulerTest, nodes_that_wait_for_memory_are_looked_up_once) {
  const auto opens_per_node = [this](std::size_t count) {
    dag = {};
    for (std::size_t i = 0; i < count; ++i) output(node("n" + std::to_string(i), {}, 0, 60));
    ears.waited.clear();
    // The first holds the budget until all others wait for it.
    executor->during = [&](const ExecutionRequest&) {
      ears.wait([&] { return ears.waited.size() >= count - 1; });
    };
    const auto files = std::make_shared<test::FaultyFileSystem>();
    const auto cache = Store::open({folder.file("cache" + std::to_string(count)), false}, files);
    files->reset_counts();
    EXPECT_EQ(run(options(4, 100), cache).status, ExitCode::ok);
    return static_cast<double>(files->count("open")) / static_cast<double>(count);
  };
  const double few = opens_per_node(8);
  EXPECT_LE(opens_per_node(64), 1.5 * few + 1);
}

TEST_F(SchedulerTest, the_executor_is_told_the_budget_of_the_run) {
  output(node("a"));
  std::uint64_t told = 0;
  executor->during = [&](const ExecutionRequest& request) { told = request.memory_bytes; };
  EXPECT_EQ(run(options(1, megabytes(64))).status, ExitCode::ok);
  EXPECT_EQ(told, megabytes(64));
  RunOptions unlimited = options(1);
  unlimited.force = {0};
  EXPECT_EQ(run(unlimited).status, ExitCode::ok);
  EXPECT_NEAR(static_cast<double>(told), static_cast<double>(*parse_memory("80%")), 1e3) << "the default";
}

}  // namespace
}  // namespace ballflow
