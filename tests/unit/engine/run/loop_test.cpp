// Loops: iterations in memory, one node for the cache and the report.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "ballflow/report.hpp"
#include "ballflow/run.hpp"
#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class LoopListener final : public EventSink {
 public:
  void on(const Event& event) override {
    if (event.kind == Event::Kind::node_message) messages.push_back(event.text);
    if (event.kind == Event::Kind::node_progress) progress.push_back(event.fraction);
  }
  std::vector<std::string> messages;
  std::vector<double> progress;
};

const char* const add_one = R"({
  "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
  "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } } },
  "outputs": { "n": "add.sum" } })";

const char* const step = R"({
  "params": { "by": { "kind": "number", "default": 1 }, "fail_at": { "kind": "number", "default": -1 } },
  "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers", "optional": true } },
  "nodes": { "step": { "type": "Step", "inputs": { "numbers": "inputs.n" },
                       "params": { "by": "${by}", "fail_at": "${fail_at}" } } },
  "outputs": { "n": "step.numbers" } })";

struct LoopTest : testing::Test {
  LoopTest() {
    registry.add_plugin(toy::plugin(), "toy");
    toy::reset();
  }

  /// zero and one -> loop -> out; `fields` of the loop begin with a comma.
  Dag graph(const std::string& body, const std::string& until, const std::string& fields = "",
            const std::vector<Setting>& settings = {}) {
    test::write_file(folder.file("body.json"), body);
    return parse_graph(R"({ "nodes": {
        "zero": { "type": "Source", "params": { "value": 0, "count": 1 } },
        "one": { "type": "Source", "params": { "value": 1, "count": 1 } },
        "loop": { "loop": "body.json", "inputs": { "n": "zero.numbers", "one": "one.numbers" },
                  "until": ")" +
                           until + "\"" + fields + R"( } },
      "outputs": { "n": "loop.n" } })",
                       folder.file("graph.json"), registry, settings);
  }

  std::shared_ptr<Store> store() { return Store::open({folder.path() + "/cache", false}); }

  RunResult run(const Dag& dag, std::shared_ptr<Store> where = nullptr, unsigned threads = 2,
                const std::atomic<bool>* cancel = nullptr) {
    RunOptions options;
    options.threads = threads;
    options.cancel = cancel;
    Runner runner(dag, registry, where ? where : Store::open({}), options, events);
    const RunResult result = runner.run();
    if (result.status == ExitCode::ok) {
      const ArtifactPtr artifact = runner.artifact(dag.outputs.at(0).from);
      last = *static_cast<const double*>(artifact->find("values")->data);
    }
    return result;
  }

  static const NodeResult& of_loop(const Dag& dag, const RunResult& result) {
    for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
      if (dag.nodes[i].path == "loop") return result.nodes[i];
    }
    throw std::runtime_error("no loop");
  }

  ActionKey key(const Dag& dag) { return action_key(*dag.find("loop"), {}, 0, *store()); }

  Registry registry;
  test::TempFolder folder;
  LoopListener events;
  double last = 0;
};

TEST_F(LoopTest, counts_to_a_thousand_in_memory_and_stores_the_last_state_only) {
  const Dag dag = graph(add_one, "n.first == 1000");
  const RunResult result = run(dag, store());
  ASSERT_EQ(result.status, ExitCode::ok) << of_loop(dag, result).cause;
  EXPECT_EQ(last, 1000);
  EXPECT_EQ(toy::counters.add, 1000);
  EXPECT_EQ(of_loop(dag, result).iterations, 1000);
  EXPECT_EQ(run_report("id", dag, result)["nodes"]["loop"]["iterations"], 1000);
  std::size_t blobs = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() + "/cache/cas"))
    blobs += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(blobs, 3u) << "zero, one, and the last state";
}

TEST_F(LoopTest, nodes_of_the_body_are_told_the_memory_of_the_run) {
  const Dag dag = graph(step, "n.first == 2");
  RunOptions options;
  options.threads = 1;
  options.memory_bytes = std::uint64_t{3} << 30;
  Runner runner(dag, registry, Store::open({}), options, events);
  ASSERT_EQ(runner.run().status, ExitCode::ok);
  EXPECT_EQ(toy::granted, options.memory_bytes);
}

TEST_F(LoopTest, a_thousand_iterations_of_three_nodes_cost_less_than_50_ms) {
  const Dag dag = graph(R"({
    "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } },
               "round": { "type": "Round", "inputs": { "numbers": "add.sum" } },
               "again": { "type": "Round", "inputs": { "numbers": "round.rounded" } } },
    "outputs": { "n": "again.rounded" } })",
                        "n.first == 1000");
  double seconds = 1e9;
  for (int i = 0; i < 3; ++i) seconds = std::min(seconds, of_loop(dag, run(dag)).cpu_seconds);
  RecordProperty("cpu_milliseconds", std::to_string(seconds * 1e3));
  std::printf("1000 iterations of three nodes: %.1f ms of CPU time\n", seconds * 1e3);
  EXPECT_EQ(toy::counters.round, 6000);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(seconds, 0.05);
#endif
}

TEST_F(LoopTest, a_second_run_executes_nothing) {
  run(graph(add_one, "n.first == 7"), store());
  toy::reset();
  const Dag dag = graph(add_one, "n.first == 7");
  const RunResult again = run(dag, store());
  EXPECT_EQ(of_loop(dag, again).status, NodeStatus::hit);
  EXPECT_EQ(toy::counters.add, 0);
  EXPECT_EQ(last, 7);
  EXPECT_EQ(plan(dag, *store(), 0, {}).back().verdict, NodePlan::Verdict::hit);
}

TEST_F(LoopTest, a_lost_final_state_is_made_again_when_it_is_needed) {
  const Dag dag = graph(add_one, "n.first == 7");
  run(dag, store());
  std::filesystem::remove_all(folder.path() + "/cache/cas");
  toy::reset();
  EXPECT_EQ(run(dag, store()).status, ExitCode::ok);
  EXPECT_EQ(last, 7);
  EXPECT_EQ(toy::counters.add, 7);
}

TEST_F(LoopTest, a_condition_that_holds_at_once_passes_the_first_state_through) {
  const Dag dag = graph(add_one, "n.first < 1");
  const RunResult result = run(dag, store());
  EXPECT_EQ(of_loop(dag, result).iterations, 0);
  EXPECT_EQ(toy::counters.add, 0);
  EXPECT_EQ(last, 0);
}

TEST_F(LoopTest, every_comparison_and_its_joints_mean_what_they_say) {
  const std::vector<std::pair<std::string, double>> cases = {
      {"n.first == 3", 3},
      {"n.first != 0", 1},
      {"n.first > 3", 4},
      {"n.first >= 3.5", 4},
      {"n.first < -1 or n.first >= 2", 2},
      {"n.first <= 0 and n.first > 5 or n.first == 4", 4},
      {"n.first == 9 or n.first > 2 and n.count == 1", 3},
      {"n.first>=3", 3},
      {"  n.first   ==   1e1  ", 10},
  };
  for (const auto& [until, expected] : cases) {
    EXPECT_EQ(run(graph(add_one, until)).status, ExitCode::ok) << until;
    EXPECT_EQ(last, expected) << until;
  }
}

TEST_F(LoopTest, a_field_that_is_null_fulfils_no_comparison) {
  Dag dag = graph(add_one, "n.first != 0 or n.first == 0", R"(, "max_iterations": 4)",
                  {{"zero.count", "0"}, {"one.count", "0"}});
  EXPECT_EQ(of_loop(dag, run(dag)).cause, "4 iterations ended before n.first != 0 or n.first == 0");
}

TEST_F(LoopTest, the_limit_is_an_error_or_the_end) {
  const Dag strict = graph(add_one, "n.first == 1000", R"(, "max_iterations": 5)");
  const RunResult failed = run(strict, store());
  EXPECT_EQ(failed.status, ExitCode::node_failed);
  EXPECT_EQ(of_loop(strict, failed).cause, "5 iterations ended before n.first == 1000");
  EXPECT_NE(of_loop(strict, failed).hint.find("max_iterations"), std::string::npos);

  const Dag patient = graph(add_one, "n.first == 1000", R"(, "max_iterations": 5, "at_limit": "stop")");
  const RunResult stopped = run(patient, store());
  EXPECT_EQ(stopped.status, ExitCode::ok);
  EXPECT_EQ(last, 5);
  const std::vector<std::string> warned{"stopped at the limit: 5 iterations ended before n.first == 1000"};
  EXPECT_EQ(of_loop(patient, stopped).warnings, warned);
  EXPECT_EQ(of_loop(patient, run(patient, store())).warnings, warned) << "also when it is a hit";

  const Dag enough = graph(add_one, "n.first == 5", R"(, "max_iterations": 5)");
  EXPECT_EQ(run(enough).status, ExitCode::ok) << "it holds after the last iteration";
}

TEST_F(LoopTest, settings_can_be_overridden_and_parametrised) {
  run(graph(add_one, "n.first == 1000", R"(, "at_limit": "stop")", {{"loop.max_iterations", "6"}}));
  EXPECT_EQ(last, 6);
  run(graph(add_one, "n.first == 1000", "", {{"loop.until", "n.first > 8"}}));
  EXPECT_EQ(last, 9);
  run(graph(step, "n.first >= 3", R"(, "params": { "by": 2 })"));
  EXPECT_EQ(last, 4);
  run(graph(step, "n.first >= 3", "", {{"loop/step.by", "5"}}));
  EXPECT_EQ(last, 5);
}

TEST_F(LoopTest, a_failure_inside_names_the_node_and_the_iteration) {
  const Dag dag = graph(step, "n.first == 100", R"(, "params": { "fail_at": 3 })");
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.status, ExitCode::node_failed);
  EXPECT_EQ(of_loop(dag, result).cause, "loop/step (Step) failed in iteration 4: cannot count on");
  EXPECT_EQ(of_loop(dag, result).hint, "start at another number");
}

TEST_F(LoopTest, cancelling_ends_it_inside_an_iteration_and_between_two) {
  const std::string slow = R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } },
               "slow": { "type": "Slow", "inputs": { "numbers": "add.sum" }, "params": { "seconds": SECONDS } } },
    "outputs": { "n": "slow.numbers" } })";
  for (const std::string seconds : {"30", "0"}) {
    std::string body = slow;
    body.replace(body.find("SECONDS"), 7, seconds);
    const Dag dag = graph(body, "n.first < 0", R"(, "max_iterations": 1000000000)");
    toy::reset();
    std::atomic<bool> cancel{false};
    std::thread canceller([&] {
      while (toy::counters.slow == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      cancel = true;
    });
    const auto start = std::chrono::steady_clock::now();
    const RunResult result = run(dag, store(), 2, &cancel);
    canceller.join();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_EQ(result.status, ExitCode::cancelled);
    EXPECT_EQ(of_loop(dag, result).status, NodeStatus::cancelled);
  }
}

TEST_F(LoopTest, equal_messages_are_passed_on_once_and_different_ones_up_to_a_bound) {
  const Dag same = graph(R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } },
               "warns": { "type": "Add", "inputs": { "a": "add.sum" } } },
    "outputs": { "n": "warns.sum" } })",
                         "n.first == 50");
  EXPECT_EQ(of_loop(same, run(same)).warnings, std::vector<std::string>{"loop/warns: nothing to add"});
  EXPECT_EQ(events.messages, std::vector<std::string>{"loop/warns: nothing to add"});

  const Dag different = graph(step, "n.first == 50");
  const std::vector<std::string> warnings = of_loop(different, run(different)).warnings;
  ASSERT_EQ(warnings.size(), 21u);
  EXPECT_EQ(warnings[19], "loop/step: reached 20");
  EXPECT_EQ(warnings[20], "there were more messages in this loop");
}

TEST_F(LoopTest, states_may_change_places) {
  test::write_file(folder.file("fibonacci.json"), R"({
    "inputs": { "a": { "type": "Numbers" }, "b": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.a", "b": "inputs.b" } } },
    "outputs": { "a": "inputs.b", "b": "add.sum" } })");
  const Dag dag = parse_graph(R"({ "nodes": {
      "zero": { "type": "Source", "params": { "value": 0 } }, "one": { "type": "Source" },
      "loop": { "loop": "fibonacci.json", "inputs": { "a": "zero.numbers", "b": "one.numbers" },
                "until": "a.first >= 100" } },
    "outputs": { "a": "loop.a", "b": "loop.b" } })",
                              folder.file("graph.json"), registry);
  const RunResult one = run(dag, nullptr, 1);
  EXPECT_EQ(last, 144);
  const RunResult four = run(dag, nullptr, 4);
  EXPECT_EQ(of_loop(dag, one).outputs.at(1).digest, of_loop(dag, four).outputs.at(1).digest);
}

TEST_F(LoopTest, loops_nest_and_failures_name_every_level) {
  test::write_file(folder.file("inner.json"), step);
  const std::string outer = R"({
    "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "inner": { "loop": "inner.json", "inputs": { "n": "inputs.n" }, "params": { "fail_at": FAIL },
                          "until": "n.first >= 10", "max_iterations": 10 },
               "add": { "type": "Add", "inputs": { "a": "inner.n", "b": "inputs.one" } } },
    "outputs": { "n": "add.sum" } })";
  const auto with = [&](const std::string& fail_at) {
    std::string body = outer;
    body.replace(body.find("FAIL"), 4, fail_at);
    return graph(body, "n.first == 13");
  };
  const Dag dag = with("-1");
  const RunResult result = run(dag);
  EXPECT_EQ(last, 13);
  EXPECT_EQ(of_loop(dag, result).iterations, 3);
  const Dag failing = with("2");
  EXPECT_EQ(of_loop(failing, run(failing)).cause,
            "loop/inner (loop) failed in iteration 1: loop/inner/step (Step) failed in iteration 3: cannot "
            "count on");
}

TEST_F(LoopTest, what_no_state_needs_does_not_run) {
  const Dag dag = graph(R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "extra": { "type": "Round", "inputs": { "numbers": "inputs.n" } },
               "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } } },
    "outputs": { "n": "add.sum" } })",
                        "n.first == 3");
  run(dag);
  EXPECT_EQ(toy::counters.round, 0);
  EXPECT_EQ(key(dag).key, key(graph(add_one, "n.first == 3")).key);
}

TEST_F(LoopTest, everything_that_may_change_the_result_changes_the_key_and_names_do_not) {
  const ActionKey base = key(graph(step, "n.first == 7"));
  const auto expect_change = [&](const Dag& dag, const std::string& named) {
    const ActionKey other = key(dag);
    EXPECT_NE(other.key, base.key) << named;
    const auto differences = manifest_differences(base.manifest, other.manifest);
    ASSERT_EQ(differences.size(), 1u) << named;
    EXPECT_NE(differences[0].find(named), std::string::npos) << differences[0];
  };
  expect_change(graph(step, "n.first == 8"), "params.until");
  expect_change(graph(step, "n.first == 7", R"(, "max_iterations": 9)"), "params.max_iterations 10000 -> 9");
  expect_change(graph(step, "n.first == 7", R"(, "at_limit": "stop")"), "params.at_limit");
  expect_change(graph(step, "n.first == 7", R"(, "params": { "by": 2 })"),
                "body.nodes.0:Step.params.by 1.0 -> 2.0");

  std::string renamed = step;
  for (std::size_t at = renamed.find("\"step"); at != std::string::npos; at = renamed.find("\"step", at + 1))
    renamed.replace(at, 5, "\"other");
  EXPECT_EQ(key(graph(renamed, "n.first == 7")).key, base.key);

  const auto wired = [&](const std::string& a, const std::string& b) {
    return key(graph(R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
      "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.)" +
                         a + R"(", "b": "inputs.)" + b + R"(" } } }, "outputs": { "n": "add.sum" } })",
                     "n.first == 7"))
        .key;
  };
  EXPECT_NE(wired("n", "one"), wired("one", "n"));
  EXPECT_NE(wired("n", "one"), wired("n", "n"));

  Dag dag = graph(step, "n.first == 7");
  Loop changed = *dag.find("loop")->kind.loop();
  NodeDeclaration decl = *changed.body.nodes[0].kind.declared();
  decl.version = 2;
  changed.body.nodes[0].kind = decl;
  for (DagNode& node : dag.nodes) {
    if (node.path == "loop") node.kind = std::make_shared<const Loop>(changed);
  }
  expect_change(dag, "body.nodes.0:Step.version 1 -> 2");
}

TEST_F(LoopTest, a_file_that_changes_while_the_body_reads_it_is_a_failure) {
  const std::string file = folder.file("number");
  test::write_file(file, "1");
  const Dag dag = graph(R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "read": { "type": "FromFile", "params": { "file": ")" +
                            file + R"(" } },
               "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "read.numbers" } } },
    "outputs": { "n": "add.sum" } })",
                        "n.first >= 3");
  EXPECT_EQ(run(dag, store()).status, ExitCode::ok);
  EXPECT_EQ(last, 3);
  test::write_file(file, "2");
  EXPECT_EQ(run(dag, store()).status, ExitCode::ok);
  EXPECT_EQ(last, 4) << "its content is part of the key";
  toy::before_reading = [](const std::string& path) { test::write_file(path, "5.5"); };
  test::write_file(file, "3");
  const RunResult changed = run(dag, store());
  toy::before_reading = nullptr;
  EXPECT_EQ(of_loop(dag, changed).cause, file + " changed while the run was reading it");
}

TEST_F(LoopTest, progress_is_how_far_the_first_field_has_come) {
  const Dag dag = graph(R"({ "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
    "nodes": { "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "inputs.one" } },
               "slow": { "type": "Slow", "inputs": { "numbers": "add.sum" }, "params": { "seconds": 0.06 } } },
    "outputs": { "n": "slow.numbers" } })",
                        "n.first == 4");
  run(dag);
  ASSERT_GE(events.progress.size(), 2u);
  for (std::size_t i = 1; i < events.progress.size(); ++i)
    EXPECT_GT(events.progress[i], events.progress[i - 1]);
}

}  // namespace
}  // namespace ballflow
