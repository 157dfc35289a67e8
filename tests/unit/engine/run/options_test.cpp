// What the options of a run change: what runs, what a failure or a disagreement ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "run_fixture.hpp"

namespace ballflow {
namespace {

struct OptionsTest : RunTest {
  RunResult run_with(const Dag& dag, RunOptions options, std::shared_ptr<Store> where = nullptr) {
    Runner runner(dag, registry, where != nullptr ? where : store(), std::move(options), events);
    return runner.run();
  }
  /// source -> fail -> after;  other -> round: two branches, two outputs.
  Dag branches() {
    Dag dag;
    dag.file = "branches.json";
    const auto source = node(dag, "source", "Source");
    const auto other = node(dag, "other", "Source", {}, {{"value", 2.5}});
    const auto fail = node(dag, "fail", "Fail", {{"numbers", {source, "numbers"}}});
    const auto slow = node(dag, "slow", "Slow", {{"numbers", {other, "numbers"}}}, {{"seconds", 0.1}});
    const auto after = node(dag, "after", "Round", {{"numbers", {fail, "numbers"}}});
    const auto round = node(dag, "round", "Round", {{"numbers", {slow, "numbers"}}});
    dag.outputs.push_back({"after", "", {after, "rounded"}});
    dag.outputs.push_back({"round", "", {round, "rounded"}});
    return dag;
  }
  /// noisy -> sum(noisy, other): noisy gives another number at every execution.
  Dag noisy_sum(double value) {
    Dag dag;
    dag.file = "noisy.json";
    const auto noisy = node(dag, "noisy", "Noisy");
    const auto other = node(dag, "other", "Source", {}, {{"value", value}, {"count", 1}});
    const auto sum = node(dag, "sum", "Add", {{"a", {noisy, "numbers"}}, {"b", {other, "numbers"}}});
    dag.outputs.push_back({"sum", "", {sum, "sum"}});
    return dag;
  }
  static double first(const ArtifactPtr& artifact) {
    return static_cast<const double*>(artifact->find("values")->data)[0];
  }
};

/// Holds slow and heavy nodes until an event of one kind, so that no test depends on who is faster.
struct HoldUntil final : EventSink {
  HoldUntil(EventSink& s, Event::Kind k, std::size_t n = any) : sink(s), kind(k), node(n) {
    toy::holding = true;
  }
  ~HoldUntil() override { toy::holding = false; }
  void on(const Event& event) override {
    sink.on(event);
    if (event.kind == kind && (node == any || event.node == node)) toy::holding = false;
  }
  static constexpr std::size_t any = static_cast<std::size_t>(-1);
  EventSink& sink;
  const Event::Kind kind;
  const std::size_t node;
};

constexpr auto failed = NodeStatus::failed;
constexpr auto skipped = NodeStatus::skipped;

TEST_F(OptionsTest, a_failure_ends_the_run_but_keep_going_finishes_what_does_not_need_it) {
  const Dag dag = branches();
  HoldUntil failure(events, Event::Kind::node_finished, 2);
  RunOptions two;
  two.threads = 2;
  const RunResult ended = Runner(dag, registry, store(), two, failure).run();
  EXPECT_EQ(ended.status, ExitCode::node_failed);
  EXPECT_EQ(ended.nodes[5].status, skipped) << "round had not started";

  RunOptions options;
  options.keep_going = true;
  const RunResult result = run_with(branches(), options);
  EXPECT_EQ(result.status, ExitCode::node_failed);
  EXPECT_EQ(result.nodes[2].status, failed);
  EXPECT_EQ(result.nodes[4].status, skipped);
  EXPECT_EQ(result.nodes[4].reason, "needs fail, which failed");
  EXPECT_EQ(result.nodes[5].status, ran);
}

TEST_F(OptionsTest, every_node_that_keep_going_skips_is_told_to_the_listener) {
  RunOptions options;
  options.keep_going = true;
  run_with(branches(), options);
  EXPECT_EQ(events.finished, (std::set<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST_F(OptionsTest, until_runs_a_node_and_what_it_needs) {
  RunOptions options;
  options.until = {2};
  const RunResult result = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, skipped, ran, skipped}));
  EXPECT_EQ(result.nodes[3].reason, "was not asked for");
  EXPECT_EQ(result.status, ExitCode::ok);
}

TEST_F(OptionsTest, only_runs_nothing_but_the_node) {
  RunOptions options;
  options.only = {2};
  const RunResult cold = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(toy::counters.source + toy::counters.round, 0);
  EXPECT_EQ(cold.status, ExitCode::node_failed);
  EXPECT_EQ(cold.nodes[2].cause, "needs source, whose result is not in the cache");
  EXPECT_EQ(cold.nodes[2].hint, "run it with what it needs: --until round");

  RunOptions source_only;
  source_only.only = {0};
  EXPECT_EQ(run_with(diamond(1.5, 2), source_only).status, ExitCode::ok);
  const RunResult warm = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(statuses(warm), (std::vector<NodeStatus>{hit, skipped, ran, skipped}));
  EXPECT_EQ(toy::counters.source, 1);
}

TEST_F(OptionsTest, only_says_which_artifact_is_lost) {
  RunOptions source_only, options;
  source_only.only = {0};
  options.only = {2};
  run_with(diamond(1.5, 2), source_only);
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  const RunResult result = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(result.nodes[2].cause, "needs source.numbers, which is not in the cache");
  EXPECT_EQ(toy::counters.source, 1) << "was not made again";
}

TEST_F(OptionsTest, force_computes_again_and_what_follows_is_cut_off) {
  run(diamond(1.5, 2), store());
  toy::reset();
  RunOptions options;
  options.force = {0};
  const RunResult result = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, hit, hit, hit}));
  EXPECT_EQ(result.nodes[0].reason, "forced");
  EXPECT_EQ(toy::counters.source, 1);
}

TEST_F(OptionsTest, a_forced_node_that_waits_for_memory_is_still_forced) {
  Dag dag;
  std::set<std::size_t> all;
  for (int i = 0; i < 4; ++i) {
    const auto heavy = node(dag, "h" + std::to_string(i), "Heavy", {}, {{"value", static_cast<double>(i)}});
    dag.outputs.push_back({"h" + std::to_string(i), "", {heavy, "numbers"}});
    all.insert(heavy);
  }
  run(dag, store());
  toy::reset();
  RunOptions options;
  options.threads = 4;
  options.memory_bytes = 100;
  options.force = all;
  HoldUntil waiting(events, Event::Kind::node_waiting);
  EXPECT_EQ(statuses(Runner(dag, registry, store(), options, waiting).run()),
            (std::vector<NodeStatus>{ran, ran, ran, ran}));
  EXPECT_EQ(toy::counters.heavy, 4);
  EXPECT_EQ(toy::counters.heavy_most, 1);
  EXPECT_FALSE(events.waiting.empty());
}

TEST_F(OptionsTest, a_lost_artifact_is_made_again_within_the_budget) {
  Dag dag;  // two sums, each of which needs a heavy node again, beside nothing else
  for (int i = 0; i < 2; ++i) {
    const auto heavy = node(dag, "h" + std::to_string(i), "Heavy", {}, {{"value", static_cast<double>(i)}});
    const auto sum = node(dag, "sum" + std::to_string(i), "Add", {{"a", {heavy, "numbers"}}});
    dag.outputs.push_back({"h" + std::to_string(i), "", {heavy, "numbers"}});
    dag.outputs.push_back({"sum" + std::to_string(i), "", {sum, "sum"}});
  }
  RunOptions first;
  first.until = {0, 2};
  run_with(dag, first);
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  toy::reset();
  RunOptions options;
  options.threads = 4;
  options.memory_bytes = 100;
  EXPECT_EQ(run_with(dag, options).status, ExitCode::ok);
  EXPECT_EQ(toy::counters.heavy, 2);
  EXPECT_EQ(toy::counters.heavy_most, 1);
}

TEST_F(OptionsTest, a_ladder_of_lost_artifacts_is_made_again_in_linear_time) {
  Dag dag;  // every node reads both of the level before
  std::size_t a = node(dag, "a", "Source"), b = node(dag, "b", "Source", {}, {{"value", 2.0}});
  std::string port = "numbers";
  for (int level = 0; level < 40; ++level) {
    const std::string number = std::to_string(level);
    const auto left = node(dag, "l" + number, "Add", {{"a", {a, port}}, {"b", {b, port}}});
    const auto right = node(dag, "r" + number, "Add", {{"a", {b, port}}, {"b", {left, "sum"}}});
    a = left;
    b = right;
    port = "sum";
  }
  const auto round = node(dag, "round", "Round", {{"numbers", {b, "sum"}}});
  dag.outputs.push_back({"sum", "", {b, "sum"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  toy::reset();
  dag.outputs = {{"round", "", {round, "rounded"}}};
  EXPECT_EQ(run(dag, store()).status, ExitCode::ok);
  EXPECT_EQ(toy::counters.add, 80);
}

TEST_F(OptionsTest, another_result_of_a_forced_node_replaces_its_entry_with_a_warning) {
  run(noisy_sum(2), store());
  RunOptions options;
  options.force = {0};
  const Dag dag = noisy_sum(2);
  const RunResult result = run_with(dag, options);
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_FALSE(result.nodes[0].deterministic);
  ASSERT_FALSE(events.messages.empty());
  EXPECT_NE(events.messages.back().find("not deterministic"), std::string::npos);
  EXPECT_EQ(result.nodes[2].status, ran) << "was computed anew";
  Runner again(dag, registry, store(), {}, events);
  EXPECT_EQ(statuses(again.run()), (std::vector<NodeStatus>{hit, hit, hit}));
  EXPECT_EQ(first(again.artifact(dag.outputs[0].from)), 4) << "2 from the second execution + 2";
}

TEST_F(OptionsTest, a_lost_artifact_that_comes_out_different_replaces_its_entry_or_fails_when_strict) {
  run(noisy_sum(2), store());  // noisy gave 1
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  RunOptions strict;
  strict.strict = true;
  const RunResult refused = run_with(noisy_sum(5), strict);  // noisy gave 2
  EXPECT_EQ(refused.status, ExitCode::node_failed);
  EXPECT_EQ(refused.nodes[2].cause,
            "noisy is not deterministic: equal inputs and parameters gave another result than the one in the "
            "cache");

  const Dag dag = noisy_sum(5);
  Runner runner(dag, registry, store(), {}, events);  // noisy gives 3: the entry still has 1
  const RunResult& result = runner.run();
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_FALSE(result.nodes[0].deterministic);
  EXPECT_TRUE(result.nodes[1].deterministic);
  EXPECT_EQ(first(runner.artifact(dag.outputs[0].from)), 8) << "3 + 5, not 1 + 5";

  const Dag other = noisy_sum(7);
  Runner next(other, registry, store(), strict, events);  // what was replaced is now the entry
  EXPECT_EQ(next.run().status, ExitCode::ok);
  EXPECT_EQ(first(next.artifact(other.outputs[0].from)), 10) << "3 + 7";
  EXPECT_EQ(toy::counters.noisy, 3);
}

TEST_F(OptionsTest, the_determinism_check_passes_good_nodes_and_names_what_differs) {
  RunOptions options;
  options.check_determinism = true;
  const RunResult good = run_with(diamond(1.5, 2), options);
  EXPECT_EQ(good.status, ExitCode::ok) << good.nodes[0].cause;
  EXPECT_EQ(toy::counters.round, 3) << "the run, 1 thread, 2 threads";
  EXPECT_EQ(run_with(diamond(1.5, 2), options).status, ExitCode::ok);
  EXPECT_EQ(toy::counters.round, 5) << "hits are run again as well";

  const RunResult bad = run_with(noisy_sum(2), options);
  EXPECT_EQ(bad.status, ExitCode::node_failed);
  EXPECT_EQ(bad.nodes[0].status, failed);
  EXPECT_EQ(bad.nodes[0].cause,
            "not deterministic: with 1 thread and with 2 threads output numbers: array values[0] is 2 and 3");
  EXPECT_FALSE(bad.nodes[0].deterministic);
}

TEST_F(OptionsTest, the_determinism_check_runs_with_different_numbers_of_threads) {
  Dag dag;
  const auto node_ = node(dag, "threads", "Threads");
  dag.outputs.push_back({"numbers", "", {node_, "numbers"}});
  RunOptions options;
  options.threads = 4;
  options.check_determinism = true;
  const RunResult result = run_with(dag, options);
  EXPECT_EQ(result.nodes[0].cause,
            "not deterministic: with 1 thread and with 4 threads output numbers: array values[0] is 1 and 4");
}

TEST_F(OptionsTest, the_determinism_check_sees_a_cached_result_that_nobody_can_reproduce) {
  run(noisy_sum(2), store());
  toy::counters.noisy = 7;
  toy::steady_noise = true;
  RunOptions options;
  options.check_determinism = true;
  const RunResult result = run_with(noisy_sum(2), options);
  toy::steady_noise = false;
  EXPECT_EQ(result.nodes[0].cause,
            "not deterministic: before and now output numbers: array values[0] is 1 and 7");
}

TEST_F(OptionsTest, the_determinism_check_works_without_a_cache) {
  RunOptions options;
  options.check_determinism = true;
  EXPECT_EQ(run_with(diamond(1.5, 2), options, Store::open({})).status, ExitCode::ok);
  EXPECT_EQ(toy::counters.source, 6) << "twice more each: inputs are kept";
}

TEST_F(OptionsTest, a_node_whose_outputs_are_being_hashed_when_the_run_is_cancelled_is_cancelled) {
  Dag dag;
  const auto source = node(dag, "source", "Source", {}, {{"count", 4'000'000}});
  dag.outputs.push_back({"numbers", "", {source, "numbers"}});
  std::atomic<bool> cancel{false};
  events.on_start = [&] { cancel = true; };  // the node itself does not look
  RunOptions options;
  options.cancel = &cancel;
  const RunResult result = run_with(dag, options);
  EXPECT_EQ(result.status, ExitCode::cancelled);
  EXPECT_EQ(result.nodes[source].status, NodeStatus::cancelled);
  EXPECT_TRUE(result.nodes[source].outputs.empty());
}

TEST_F(OptionsTest, events_tell_reads_writes_and_times_that_never_go_back) {
  run(diamond(1.5, 2), store());
  EXPECT_TRUE(std::is_sorted(events.times.begin(), events.times.end()));
  EXPECT_EQ(events.written,
            (std::set<std::string>{"source.numbers", "other.numbers", "round.rounded", "sum.sum"}));
  events.read.clear();
  run(diamond(1.5, 3), store());
  EXPECT_EQ(events.read, (std::set<std::string>{"round.rounded"}));
}

TEST_F(OptionsTest, names_of_nodes_and_subgraphs_are_found_and_others_are_refused_with_the_nearest) {
  Dag dag;
  dag.file = "g.json";
  node(dag, "source", "Source");
  node(dag, "prune/first", "Source");
  node(dag, "prune/second", "Source");
  EXPECT_EQ(nodes_named(dag, "source"), (std::set<std::size_t>{0}));
  EXPECT_EQ(nodes_named(dag, "prune"), (std::set<std::size_t>{1, 2}));
  EXPECT_EQ(nodes_named(dag, "prune/second"), (std::set<std::size_t>{2}));
  try {
    nodes_named(dag, "sorce");
    FAIL() << "there is no such node";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(error.hint(), "did you mean \"source\"?");
  }
}

/// source(count) -> slow
Dag slow_chain(OptionsTest& test, double count) {
  Dag dag;
  const auto source = test.node(dag, "source", "Source", {}, {{"count", static_cast<std::int64_t>(count)}});
  const auto slow = test.node(dag, "slow", "Slow", {{"numbers", {source, "numbers"}}}, {{"seconds", 0.05}});
  dag.outputs.push_back({"numbers", "", {slow, "numbers"}});
  return dag;
}

TEST_F(OptionsTest, plan_guesses_from_executions_with_the_same_parameters_scaled_by_the_size_of_the_inputs) {
  const auto cache = store();
  EXPECT_FALSE(plan(slow_chain(*this, 100), *cache, 0, {})[1].seconds) << "it never ran";
  const RunResult small = run(slow_chain(*this, 100), cache);

  const Dag large = slow_chain(*this, 1000);
  const std::vector<NodePlan> unknown = plan(large, *cache, 0, {});
  EXPECT_EQ(unknown[0].seconds_from, "other parameters");
  EXPECT_EQ(unknown[1].verdict, NodePlan::Verdict::maybe);
  EXPECT_EQ(unknown[1].seconds_from, "same parameters");
  EXPECT_DOUBLE_EQ(unknown[1].seconds.value(), small.nodes[1].seconds);

  RunOptions options;
  options.until = {0};
  const RunResult source = run_with(large, options, cache);
  const std::vector<NodePlan> known = plan(large, *cache, 0, {});
  EXPECT_EQ(known[0].verdict, NodePlan::Verdict::hit);
  EXPECT_EQ(known[1].verdict, NodePlan::Verdict::run);
  const double ratio = static_cast<double>(source.nodes[0].outputs[0].bytes) /
                       static_cast<double>(small.nodes[0].outputs[0].bytes);
  EXPECT_GT(ratio, 4);
  EXPECT_DOUBLE_EQ(known[1].seconds.value(), small.nodes[1].seconds * ratio);
  EXPECT_EQ(known[1].seconds_from.rfind("same parameters, scaled from ", 0), 0u) << known[1].seconds_from;
}

TEST_F(OptionsTest, plan_foretells_the_estimate_of_the_memory) {
  Dag dag;
  const auto heavy = node(dag, "heavy", "Heavy");
  dag.outputs.push_back({"numbers", "", {heavy, "numbers"}});
  EXPECT_EQ(plan(dag, *store(), 0, {})[0].memory, 60u);
}

TEST(Memory, budgets_are_sizes_or_shares) {
  EXPECT_EQ(parse_memory("4096"), 4096u);
  EXPECT_EQ(parse_memory("2G"), 2ull << 30);
  const auto half = parse_memory("50%"), whole = parse_memory("100%");
  ASSERT_TRUE(half && whole);
  EXPECT_NEAR(static_cast<double>(*whole), 2.0 * static_cast<double>(*half), 200);
  for (const char* wrong : {"", "0", "0%", "101%", "%", "-5%", "1.5%x", "lots", "none"})
    EXPECT_FALSE(parse_memory(wrong)) << wrong;
}

}  // namespace
}  // namespace ballflow
