// Keys that another process computes, and results that it leaves meanwhile.
#include <gtest/gtest.h>

#include "scheduler_fixture.hpp"

namespace ballflow {
namespace {

/// A lock of the key that somebody else holds until `free` says so.
struct Elsewhere {
  Elsewhere(SchedulerTest& test, std::size_t i) : lock(test.store()->lock(test.key(i), {})) {}
  std::unique_ptr<KeyLock> lock;
};

TEST_F(SchedulerTest, waiting_for_the_key_of_another_process_holds_neither_worker_nor_memory) {
  for (const unsigned threads : {1u, 4u}) {
    SCOPED_TRACE(threads);
    dag = {};
    executor->started.clear();
    ears.waited.clear();
    node("before", {}, 0, 40);
    const auto busy = node("busy", {}, 1000 + static_cast<int>(threads), 40);
    node("after", {}, 0, 40);
    for (std::size_t i = 0; i < 3; ++i) {
      declarations[declarations.size() - 1 - i]->version += 10 * static_cast<int>(threads);
      output(i);
    }
    Elsewhere other(*this, busy);
    ASSERT_NE(other.lock, nullptr);
    const std::pair<std::size_t, std::string> for_the_key(busy, "another process computes the same");
    std::atomic<bool> cancel{false};
    int others_ended = 0;
    ears.hears = [&](const Event& event) {
      if (event.kind == Event::Kind::node_finished && event.node != busy) ++others_ended;
      const bool waits = std::count(ears.waited.begin(), ears.waited.end(), for_the_key) > 0;
      if (waits && others_ended == 2) other.lock.reset();
    };
    std::mutex mutex;
    std::condition_variable ended;
    bool done = false;
    std::thread watch([&] {  // instead of hanging for ever
      std::unique_lock lock(mutex);
      if (!ended.wait_for(lock, std::chrono::minutes(1), [&] { return done; })) cancel = true;
    });
    RunOptions with = options(threads, 100);
    with.cancel = &cancel;
    const RunResult result = run(with);
    {
      const std::lock_guard lock(mutex);
      done = true;
    }
    ended.notify_all();
    watch.join();
    EXPECT_EQ(result.status, ExitCode::ok);
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::run);
    EXPECT_EQ(executor->started.back(), "busy");
    EXPECT_EQ(executor->started.size(), 3u);
    EXPECT_EQ(std::count(ears.waited.begin(), ears.waited.end(), for_the_key), 1);
  }
}

TEST_F(SchedulerTest, what_the_other_process_leaves_is_a_hit) {
  const auto busy = node("busy");
  const auto after = node("after", {busy});
  output(after);
  for (const unsigned threads : {1u, 3u}) {
    SCOPED_TRACE(threads);
    declarations[busy]->version = static_cast<int>(threads);
    declarations[after]->version = 50 + static_cast<int>(threads);
    executor->started.clear();
    Elsewhere other(*this, busy);
    ears.hears = [&](const Event& event) {
      if (event.kind != Event::Kind::node_waiting) return;
      leave(busy, 7);
      other.lock.reset();
    };
    const RunResult result = run(options(threads));
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::hit);
    EXPECT_EQ(result.nodes[busy].reason, "computed meanwhile by another run");
    EXPECT_EQ(executor->started, std::vector<std::string>{"after"});
  }
}

TEST_F(SchedulerTest, a_run_that_waits_for_another_process_can_be_cancelled_and_a_failure_ends_it) {
  const auto busy = node("busy");
  const auto fail = node("fail");
  output(busy);
  output(fail);
  const Elsewhere other(*this, busy);
  std::atomic<bool> cancel{false};
  ears.hears = [&](const Event& event) {
    if (event.kind == Event::Kind::node_waiting) cancel = true;
  };
  for (const unsigned threads : {1u, 3u}) {
    cancel = false;
    RunOptions with = options(threads);
    with.cancel = &cancel;
    EXPECT_EQ(run(with).nodes[busy].status, NodeStatus::cancelled);
  }
  ears.hears = nullptr;
  declarations[fail]->version = 7;
  executor->during = [](const ExecutionRequest&) { throw Error(ExitCode::node_failed, "no"); };
  for (const unsigned threads : {1u, 3u}) {
    const RunResult result = run(options(threads));
    EXPECT_EQ(result.nodes[fail].status, NodeStatus::failed);
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::skipped);
  }
}

TEST_F(SchedulerTest, a_result_that_another_process_left_meanwhile_is_compared) {
  const auto a = node("a");
  output(a);
  // As where a file system does not lock: the entry appears while the node runs.
  executor->during = [&](const ExecutionRequest&) { leave(a, 5); };
  RunOptions strict = options(1);
  strict.strict = true;
  const RunResult refused = run(strict);
  EXPECT_EQ(refused.nodes[a].status, NodeStatus::failed);
  EXPECT_NE(refused.nodes[a].cause.find("not deterministic"), std::string::npos) << refused.nodes[a].cause;

  declarations[a]->version = 2;
  ears.messages.clear();
  const RunResult told_of = run(options(1));
  EXPECT_EQ(told_of.nodes[a].status, NodeStatus::run);
  EXPECT_FALSE(told_of.nodes[a].deterministic);
  EXPECT_TRUE(told("not deterministic"));

  declarations[a]->version = 3;
  ears.messages.clear();
  executor->during = [&](const ExecutionRequest&) { leave(a, 1); };  // the same
  EXPECT_TRUE(run(options(1)).nodes[a].deterministic);
  EXPECT_TRUE(ears.messages.empty());
}

TEST_F(SchedulerTest, an_artifact_made_again_is_compared_with_what_another_process_left_as_well) {
  const auto a = node("a"), after = node("after", {a});
  output(a);
  run(options(1));
  std::filesystem::remove_all(folder.file("cache/cas"));
  dag.outputs.clear();
  output(after);
  executor->during = [&](const ExecutionRequest& request) {
    if (request.node->path == "a") leave(a, 5);
  };
  const RunResult result = run(options(1));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_FALSE(result.nodes[a].deterministic);
  EXPECT_TRUE(told("not deterministic"));
}

TEST_F(SchedulerTest, an_entry_of_another_version_of_a_type_is_replaced_and_told) {
  const auto a = node("a");
  output(a);
  leave(a, 1, 2);
  const RunResult result = run(options(1));
  EXPECT_EQ(result.nodes[a].status, NodeStatus::run);
  EXPECT_TRUE(result.nodes[a].deterministic) << "it is the author who forgot something";
  EXPECT_TRUE(told("the author has not raised the behaviour version"));
}

TEST_F(SchedulerTest, equal_nodes_of_which_one_is_forced_never_keep_two_results) {
  for (const unsigned threads : {1u, 4u}) {
    for (const bool first : {true, false}) {
      SCOPED_TRACE(testing::Message() << threads << ' ' << first);
      dag = {};
      declarations.clear();
      const int version = static_cast<int>(threads) * 2 + (first ? 1 : 0);
      const auto a = node("a", {}, version), b = node("b", {}, version);
      const auto of_a = node("of a", {a}), of_b = node("of b", {b});
      output(of_a);
      output(of_b);
      leave(a, 5);
      executor->values = {{"a", 6}, {"b", 6}};
      RunOptions with = options(threads);
      with.force = {first ? a : b};
      const RunResult result = run(with);
      EXPECT_EQ(result.status, ExitCode::ok);
      EXPECT_EQ(result.nodes[a].outputs.at(0).digest, result.nodes[b].outputs.at(0).digest);
      EXPECT_EQ(result.nodes[a].outputs.at(0).digest, numbers(executor->live, 1, 6)->digest());
      EXPECT_FALSE(result.nodes[a].deterministic && result.nodes[b].deterministic);
    }
  }
}

TEST_F(SchedulerTest, equal_nodes_that_are_both_forced_run_once) {
  const auto a = node("a", {}, 1), b = node("b", {}, 1);
  output(node("sum", {a, b}));
  run(options(1));
  executor->started.clear();
  RunOptions with = options(4);
  with.force = {a, b};
  EXPECT_EQ(run(with).status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 1u);
}

}  // namespace
}  // namespace ballflow
