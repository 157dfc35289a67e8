#include "ballflow/run.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <filesystem>
#include <thread>

#include "ballflow/history.hpp"
#include "ballflow/report.hpp"
#include "run_fixture.hpp"

namespace ballflow {
namespace {

TEST_F(RunTest, first_run_executes_every_node_once) {
  const RunResult result = run(diamond(1.5, 2), store());
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, ran, ran, ran}));
  EXPECT_EQ(toy::counters.source, 2);
  EXPECT_EQ(toy::counters.round, 1);
  EXPECT_EQ(toy::counters.add, 1);
}

TEST_F(RunTest, second_run_executes_nothing_and_reads_no_artifact) {
  run(diamond(1.5, 2), store());
  toy::reset();
  std::filesystem::remove_all(folder.path() + "/cache/cas");  // not even needed
  const RunResult result = run(diamond(1.5, 2), store());
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{hit, hit, hit, hit}));
  EXPECT_EQ(toy::counters.source + toy::counters.round + toy::counters.add, 0);
  EXPECT_TRUE(events.started.size() == 4u) << "only the first run started nodes";
}

TEST_F(RunTest, a_changed_parameter_reruns_only_its_descendants) {
  run(diamond(1.5, 2), store());
  toy::reset();
  const RunResult result = run(diamond(1.5, 3), store());
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{hit, ran, hit, ran}));
}

TEST_F(RunTest, equal_content_from_a_changed_node_cuts_off_early) {
  run(diamond(1.5, 2), store());
  toy::reset();
  const RunResult result = run(diamond(1.25, 2), store());  // rounds to the same
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, hit, ran, hit}));
}

TEST_F(RunTest, digests_do_not_depend_on_threads_or_cache) {
  const RunResult one = run(diamond(1.5, 2), store(), 1);
  const RunResult four = run(diamond(1.5, 2), Store::open({}), 4);
  for (std::size_t i = 0; i < one.nodes.size(); ++i) {
    EXPECT_EQ(one.nodes[i].outputs.at(0).digest, four.nodes[i].outputs.at(0).digest);
  }
}

TEST_F(RunTest, equal_computations_run_once) {
  Dag dag;
  const auto a = node(dag, "a", "Source");
  const auto b = node(dag, "b", "Source");
  const auto sum = node(dag, "sum", "Add", {{"a", {a, "numbers"}}, {"b", {b, "numbers"}}});
  dag.outputs.push_back({"sum", "", {sum, "sum"}});
  for (int i = 0; i < 20; ++i) {
    toy::reset();
    const RunResult result = run(dag, Store::open({folder.path() + "/c" + std::to_string(i), false}));
    EXPECT_EQ(result.status, ExitCode::ok);
    EXPECT_EQ(toy::counters.source, 1);
  }
}

TEST_F(RunTest, works_without_a_store) {
  Dag dag = diamond(1.5, 2);
  Silent sink;
  Runner runner(dag, registry, Store::open({}), {}, sink);
  EXPECT_EQ(runner.run().status, ExitCode::ok);
  const ArtifactPtr sum = runner.artifact(dag.outputs[0].from);
  const auto* values = static_cast<const double*>(sum->find("values")->data);
  EXPECT_EQ(values[0], 3);
}

TEST_F(RunTest, nodes_that_no_output_needs_do_not_run) {
  Dag dag = diamond(1, 2);
  node(dag, "extra", "Source", {}, {{"value", 9}});
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.nodes[4].status, NodeStatus::skipped);
  EXPECT_EQ(toy::counters.source, 2);
}

TEST_F(RunTest, a_failing_node_names_cause_and_hint_and_keeps_what_was_computed) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto fail = node(dag, "fail", "Fail", {{"numbers", {source, "numbers"}}});
  const auto after = node(dag, "after", "Round", {{"numbers", {fail, "numbers"}}});
  dag.outputs.push_back({"out", "", {after, "rounded"}});
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.status, ExitCode::node_failed);
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, NodeStatus::failed, NodeStatus::skipped}));
  EXPECT_EQ(result.nodes[fail].cause, "number 7 is odd");
  EXPECT_EQ(result.nodes[fail].hint, "use even numbers");
  const RunResult again = run(dag, store());
  EXPECT_EQ(again.nodes[source].status, hit);
}

TEST_F(RunTest, an_output_that_breaks_its_type_is_a_failure_of_the_node) {
  Dag dag;
  const auto bad = node(dag, "bad", "Negative");
  dag.outputs.push_back({"out", "", {bad, "numbers"}});
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.nodes[bad].status, NodeStatus::failed);
  EXPECT_NE(result.nodes[bad].cause.find("number 1 is negative"), std::string::npos)
      << result.nodes[bad].cause;
}

TEST_F(RunTest, cancelling_ends_the_run_soon_and_keeps_what_is_complete) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto slow = node(dag, "slow", "Slow", {{"numbers", {source, "numbers"}}});
  dag.outputs.push_back({"out", "", {slow, "numbers"}});
  std::atomic<bool> cancel{false};
  RunOptions options;
  options.cancel = &cancel;
  events.on_start = [&] {
    if (events.started.size() == 2) cancel = true;
  };
  Runner runner(dag, registry, store(), options, events);
  const auto start = std::chrono::steady_clock::now();
  const RunResult result = runner.run();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_EQ(result.status, ExitCode::cancelled);
  EXPECT_EQ(result.nodes[slow].status, NodeStatus::cancelled);
  Dag only_source;
  only_source.nodes = {dag.nodes[0]};
  only_source.outputs.push_back({"n", "", {0, "numbers"}});
  EXPECT_EQ(run(only_source, store()).nodes[0].status, hit);
}

TEST_F(RunTest, a_lost_artifact_is_made_again_when_it_is_needed) {
  run(diamond(1.5, 2), store());
  toy::reset();
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  const RunResult result = run(diamond(1.5, 3), store());
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, ran, ran, ran}));
  EXPECT_EQ(toy::counters.source, 2) << "both sources: one changed, one lost";
}

TEST_F(RunTest, a_node_that_is_not_deterministic_is_reported_and_its_descendants_are_computed_anew) {
  Dag dag;
  const auto noisy = node(dag, "noisy", "Noisy");
  const auto other = node(dag, "other", "Source", {}, {{"value", 2.0}, {"count", 1}});
  const auto sum = node(dag, "sum", "Add", {{"a", {noisy, "numbers"}}, {"b", {other, "numbers"}}});
  dag.outputs.push_back({"sum", "", {sum, "sum"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  dag.nodes[other].params["value"] = 5.0;  // sum must run: it needs the lost numbers of noisy
  events.messages.clear();
  Runner runner(dag, registry, store(), {}, events);
  EXPECT_EQ(runner.run().status, ExitCode::ok);
  ASSERT_FALSE(events.messages.empty());
  EXPECT_NE(events.messages[0].find("not deterministic"), std::string::npos);
  const ArtifactPtr result = runner.artifact(dag.outputs[0].from);
  EXPECT_EQ(static_cast<const double*>(result->find("values")->data)[0], 7)
      << "2 from the second execution + 5";
}

TEST_F(RunTest, a_node_that_is_never_deterministic_ends_as_a_failure_when_its_result_cannot_be_kept) {
  Dag dag;
  const auto noisy = node(dag, "noisy", "Noisy");
  const auto sum = node(dag, "sum", "Add", {{"a", {noisy, "numbers"}}});
  dag.outputs.push_back({"noisy", "", {noisy, "numbers"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  dag.outputs = {{"sum", "", {sum, "sum"}}};
  EXPECT_EQ(run(dag, Store::open({folder.path() + "/cache", true})).status, ExitCode::node_failed);
}

TEST_F(RunTest, giving_up_keeps_the_verdict_on_nodes_that_nothing_needs) {
  Dag dag;
  const auto noisy = node(dag, "noisy", "Noisy");
  const auto sum = node(dag, "sum", "Add", {{"a", {noisy, "numbers"}}});
  const auto extra = node(dag, "extra", "Source");
  dag.outputs.push_back({"noisy", "", {noisy, "numbers"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  dag.outputs = {{"sum", "", {sum, "sum"}}};
  const RunResult result = run(dag, Store::open({folder.path() + "/cache", true}));
  EXPECT_EQ(result.nodes[sum].status, NodeStatus::failed);
  EXPECT_EQ(result.nodes[extra].status, NodeStatus::skipped);
}

TEST_F(RunTest, cancelling_while_a_lost_artifact_is_made_again_is_no_failure) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto slow = node(dag, "slow", "Slow", {{"numbers", {source, "numbers"}}}, {{"seconds", 0.01}});
  const auto sum = node(dag, "sum", "Add", {{"a", {slow, "numbers"}}});
  dag.outputs.push_back({"slow", "", {slow, "numbers"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  dag.outputs = {{"sum", "", {sum, "sum"}}};
  std::atomic<bool> cancel{false};
  events.started.clear();
  events.on_start = [&] {
    if (events.started.back() == slow) cancel = true;
  };
  RunOptions options;
  options.cancel = &cancel;
  Runner runner(dag, registry, store(), options, events);
  const RunResult& result = runner.run();
  EXPECT_EQ(result.nodes[sum].status, NodeStatus::cancelled) << result.nodes[sum].cause;
  EXPECT_EQ(result.status, ExitCode::cancelled);
}

TEST_F(RunTest, cancelling_while_an_output_is_made_again_says_so) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto slow = node(dag, "slow", "Slow", {{"numbers", {source, "numbers"}}}, {{"seconds", 0.01}});
  dag.outputs.push_back({"slow", "", {slow, "numbers"}});
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  std::atomic<bool> cancel{false};
  RunOptions options;
  options.cancel = &cancel;
  Runner runner(dag, registry, store(), options, events);
  ASSERT_EQ(runner.run().status, ExitCode::ok);
  cancel = true;
  try {
    runner.artifact(dag.outputs[0].from);
    FAIL() << "the node was not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::cancelled) << error.what();
  }
}

TEST_F(RunTest, an_entry_without_a_declared_output_is_a_miss) {
  // As when the author of a node adds an output and forgets to raise its behaviour version.
  const Dag dag = diamond(1.5, 2);
  auto cache = store();
  const RunResult first = run(dag, cache);
  const ActionKey key = action_key(dag.nodes[0], {}, 0, *cache);
  ActionEntry entry = cache->find_action(key.key).value();
  entry.outputs[0].port = "former_name";
  ASSERT_TRUE(cache->put_action(key.key, entry));
  EXPECT_EQ(plan(dag, *cache, 0, {})[0].verdict, NodePlan::Verdict::run);
  const RunResult second = run(dag, cache);
  EXPECT_EQ(second.status, ExitCode::ok);
  EXPECT_EQ(statuses(second), (std::vector<NodeStatus>{ran, hit, hit, hit}));
  entry.outputs[0] = first.nodes[0].outputs[0];
  entry.outputs[0].type_version = 7;
  ASSERT_TRUE(cache->put_action(key.key, entry));
  EXPECT_EQ(run(dag, cache).nodes[0].status, ran);
}

TEST_F(RunTest, equal_computations_run_once_without_a_store_too) {
  Dag dag;
  const auto a = node(dag, "a", "Source");
  const auto wait = node(dag, "wait", "Slow", {{"numbers", {a, "numbers"}}}, {{"seconds", 0.01}});
  // Its key is that of "first", which has ended long before.
  const auto first = node(dag, "first", "Round", {{"numbers", {a, "numbers"}}});
  const auto later = node(dag, "later", "Round", {{"numbers", {wait, "numbers"}}});
  const auto sum = node(dag, "sum", "Add", {{"a", {first, "rounded"}}, {"b", {later, "rounded"}}});
  dag.outputs.push_back({"sum", "", {sum, "sum"}});
  const RunResult result = run(dag, Store::open({}));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(toy::counters.round, 1);
  EXPECT_EQ(result.nodes[later].status, hit);
}

TEST_F(RunTest, a_part_of_the_graph_that_is_there_twice_runs_once_without_a_store) {
  for (const unsigned threads : {1U, 4U}) {
    for (const bool of_first : {false, true}) {
      Dag dag;
      std::vector<std::size_t> sources, rounded;
      for (const char* part : {"a", "b"}) {
        sources.push_back(node(dag, std::string(part) + "_source", "Source"));
        rounded.push_back(
            node(dag, std::string(part) + "_round", "Round", {{"numbers", {sources.back(), "numbers"}}}));
      }
      // What one of the sources made is read again after all that reads the other has ended.
      const std::size_t read = sources[of_first ? 0 : 1], done = rounded[of_first ? 1 : 0];
      const auto wait = node(dag, "wait", "Slow", {{"numbers", {done, "rounded"}}}, {{"seconds", 0.01}});
      const auto sum = node(dag, "sum", "Add", {{"a", {wait, "numbers"}}, {"b", {read, "numbers"}}});
      dag.outputs.push_back({"sum", "", {sum, "sum"}});
      toy::reset();
      const RunResult result = run(dag, Store::open({}), threads);
      EXPECT_EQ(result.status, ExitCode::ok);
      EXPECT_EQ(toy::counters.source, 1) << threads << ' ' << of_first;
    }
  }
}

TEST_F(RunTest, a_file_that_changes_before_it_is_read_leaves_no_entry) {
  Dag dag;
  test::write_file(folder.file("number.txt"), "1");
  const auto read = node(dag, "read", "FromFile", {}, {{"file", folder.file("number.txt")}});
  dag.outputs.push_back({"numbers", "", {read, "numbers"}});
  toy::before_reading = [](const std::string& path) { test::write_file(path, "2"); };
  const RunResult changed = run(dag, store());
  toy::before_reading = nullptr;
  EXPECT_EQ(changed.nodes[read].status, NodeStatus::failed);
  EXPECT_NE(changed.nodes[read].cause.find("number.txt"), std::string::npos) << changed.nodes[read].cause;
  test::write_file(folder.file("number.txt"), "1");
  const RunResult again = run(dag, store());
  EXPECT_EQ(again.nodes[read].status, ran);
  test::write_file(folder.file("other.txt"), "1");
  dag.nodes[read].params["file"] = folder.file("other.txt");
  EXPECT_EQ(run(dag, store()).nodes[read].outputs.at(0).digest, again.nodes[read].outputs.at(0).digest);
}

TEST_F(RunTest, nonsense_of_a_node_reaches_nobody_raw) {
  Dag dag;
  const auto babble = node(dag, "babble", "Babble");
  dag.outputs.push_back({"numbers", "", {babble, "numbers"}});
  auto cache = store();
  const RunResult result = run(dag, cache);
  EXPECT_EQ(result.status, ExitCode::ok);
  for (const double fraction : events.fractions) EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
  const std::string id = new_run_id("babble.json");
  EXPECT_TRUE(save_run(*cache, id, manifests_of(dag, result), run_report(id, dag, result)));
  EXPECT_FALSE(latest_manifests(*cache, "babble.json").empty());
}

TEST_F(RunTest, a_display_that_throws_costs_no_result) {
  events.on_start = [] { throw std::runtime_error("the terminal is gone"); };
  const RunResult result = run(diamond(1.5, 2), store());
  EXPECT_EQ(result.status, ExitCode::ok);
}

TEST_F(RunTest, warnings_are_shown_again_on_a_hit) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto sum = node(dag, "sum", "Add", {{"a", {source, "numbers"}}});
  dag.outputs.push_back({"sum", "", {sum, "sum"}});
  run(dag, store());
  events.messages.clear();
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.nodes[sum].status, hit);
  EXPECT_EQ(result.nodes[sum].warnings, std::vector<std::string>{"nothing to add"});
  EXPECT_EQ(events.messages, std::vector<std::string>{"nothing to add"});
}

TEST_F(RunTest, nodes_whose_estimates_exceed_the_budget_together_never_run_together) {
  Dag dag;
  for (int i = 0; i < 6; ++i) {
    const auto heavy =
        node(dag, "heavy" + std::to_string(i), "Heavy", {}, {{"value", static_cast<double>(i)}});
    dag.outputs.push_back({"h" + std::to_string(i), "", {heavy, "numbers"}});
  }
  RunOptions options;
  options.threads = 4;
  options.memory_bytes = 100;
  Runner runner(dag, registry, store(), options, events);
  EXPECT_EQ(runner.run().status, ExitCode::ok);
  EXPECT_EQ(toy::counters.heavy, 6);
  EXPECT_EQ(toy::counters.heavy_most, 1);
}

TEST_F(RunTest, a_node_takes_the_cpu_time_of_all_its_threads) {
  Dag dag;
  const auto busy = node(dag, "busy", "Busy");
  dag.outputs.push_back({"out", "", {busy, "numbers"}});
  for (const unsigned count : {1u, 2u, 4u}) {
    RunOptions options;
    options.threads = count;
    options.force = {busy};
    Runner runner(dag, registry, store(), options, events);
    const RunResult& result = runner.run();
    ASSERT_EQ(result.status, ExitCode::ok);
    double burnt = 0;
    const ArtifactPtr numbers = runner.artifact({busy, "numbers"});
    const auto* const parts = static_cast<const double*>(numbers->arrays()[0].data);
    for (std::size_t i = 0; i < 4; ++i) burnt += parts[i];
    EXPECT_GE(burnt, 0.04);
    EXPECT_GE(result.nodes[busy].cpu_seconds, burnt - 1e-3) << count;
    EXPECT_LE(result.nodes[busy].cpu_seconds, 2 * burnt + 0.05)
        << count;  // threads may look for work in vain
    EXPECT_LE(result.nodes[busy].cpu_seconds, result.cpu_seconds + 1e-3) << count;
    if (count == 1) {
      EXPECT_LE(result.nodes[busy].cpu_seconds, result.nodes[busy].seconds + 1e-3);
    }
  }
}

TEST_F(RunTest, two_runs_at_once_on_one_store_compute_everything_once) {
  Dag dag;
  const auto source = node(dag, "source", "Source");
  const auto slow = node(dag, "slow", "Slow", {{"numbers", {source, "numbers"}}}, {{"seconds", 0.3}});
  dag.outputs.push_back({"out", "", {slow, "numbers"}});
  RunResult results[2];
  std::thread threads[2];
  for (int i = 0; i < 2; ++i) {
    threads[i] = std::thread([&, i] {
      Silent sink;
      Runner runner(dag, registry, store(), {}, sink);
      results[i] = runner.run();
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(toy::counters.slow, 1);
  EXPECT_EQ(results[0].nodes[slow].outputs[0].digest, results[1].nodes[slow].outputs[0].digest);
}

TEST_F(RunTest, reasons_name_the_field_that_changed) {
  const RunResult first = run(diamond(1.5, 2), store());
  const Dag dag = diamond(1.5, 3);
  Manifests earlier;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) earlier[dag.nodes[i].path] = first.nodes[i].manifest;
  const RunResult second = run(dag, store(), 2, earlier);
  EXPECT_EQ(second.nodes[1].reason, "params.value 2.0 -> 3.0");
  EXPECT_EQ(second.nodes[3].reason, "input b: other content");
}

TEST_F(RunTest, plan_foretells_hit_run_and_maybe) {
  using V = NodePlan::Verdict;
  const auto verdicts = [](const std::vector<NodePlan>& plans) {
    std::vector<V> out;
    for (const NodePlan& p : plans) out.push_back(p.verdict);
    return out;
  };
  auto cache = store();
  EXPECT_EQ(verdicts(plan(diamond(1.5, 2), *cache, 0, {})),
            (std::vector<V>{V::run, V::run, V::maybe, V::maybe}));
  run(diamond(1.5, 2), cache);
  EXPECT_EQ(verdicts(plan(diamond(1.5, 2), *cache, 0, {})), (std::vector<V>{V::hit, V::hit, V::hit, V::hit}));
  EXPECT_EQ(verdicts(plan(diamond(1.5, 3), *cache, 0, {})),
            (std::vector<V>{V::hit, V::run, V::hit, V::maybe}));
}

TEST_F(RunTest, the_report_holds_status_summary_and_times) {
  const Dag dag = diamond(1.5, 2);
  const RunResult result = run(dag, store());
  const Json report = run_report("id", dag, result);
  EXPECT_EQ(report["status"], "ok");
  EXPECT_EQ(report["nodes"]["sum"]["status"], "run");
  EXPECT_EQ(report["nodes"]["source"]["params"]["value"], 1.5);
  EXPECT_EQ(report["outputs"]["sum"]["summary"]["count"], 3);
  EXPECT_EQ(report["outputs"]["sum"]["from"], "sum.sum");
}

}  // namespace
}  // namespace ballflow
