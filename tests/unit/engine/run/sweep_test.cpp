// Sweeps when they run: what is executed, and how often.
#include <gtest/gtest.h>

#include <ctime>
#include <utility>

#include "ballflow/history.hpp"
#include "ballflow/report.hpp"
#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class Silent final : public EventSink {
 public:
  void on(const Event&) override {}
};

struct SweepRun : testing::Test {
  SweepRun() {
    registry.add_plugin(toy::plugin(), "toy");
    toy::reset();
  }

  /// source -> round -> step -> step
  Dag graph(const std::string& sections, const std::vector<Setting>& settings = {}) {
    return parse_graph("{" + sections + R"(
      "params": { "value": { "kind": "number", "default": 1.5 }, "by": { "kind": "number", "default": 1 },
                  "fail_at": { "kind": "number", "default": -1 } },
      "nodes": {
        "source": { "type": "Source", "params": { "value": "${value}" } },
        "round":  { "type": "Round", "inputs": { "numbers": "source.numbers" } },
        "step":   { "type": "Step", "inputs": { "numbers": "round.rounded" }, "params": { "by": "${by}" } },
        "last":   { "type": "Step", "inputs": { "numbers": "step.numbers" }, "params": { "fail_at": "${fail_at}" } }
      },
      "outputs": { "numbers": "last.numbers" } })",
                       "g.json", registry, settings);
  }
  RunResult run(const Dag& dag, std::shared_ptr<Store> store, bool keep_going = false) {
    RunOptions options;
    options.threads = 2;
    options.keep_going = keep_going;
    Silent silent;
    Runner runner(dag, registry, std::move(store), options, silent);
    return runner.run();
  }
  std::shared_ptr<Store> store() { return Store::open({folder.path() + "/cache", false}); }
  static std::size_t count(const RunResult& result, NodeStatus status) {
    return static_cast<std::size_t>(
        std::count_if(result.nodes.begin(), result.nodes.end(),
                      [status](const auto& node) { return node.status == status; }));
  }

  Registry registry;
  test::TempFolder folder;
};

TEST_F(SweepRun, shared_prefixes_run_once_and_results_are_those_of_single_runs) {
  const Dag dag = graph(R"("sweep": {"axes": {"value": [1, 2], "by": [1, 2, 3]}},)");
  const RunResult result = run(dag, store());
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(toy::counters.source, 2);
  EXPECT_EQ(toy::counters.round, 2);
  EXPECT_EQ(dag.nodes.size(), 2u + 2u + 6u + 6u);
  for (const Variant& variant : dag.variants) {
    const Dag alone =
        graph("", {{"value", variant.values[0].second.dump()}, {"by", variant.values[1].second.dump()}});
    const RunResult single = run(alone, Store::open({}));
    for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
      EXPECT_EQ(result.nodes[variant.nodes[i]].outputs.at(0).digest, single.nodes[i].outputs.at(0).digest);
      EXPECT_EQ(result.nodes[variant.nodes[i]].manifest, single.nodes[i].manifest);
    }
  }
}

TEST_F(SweepRun, variants_that_turn_out_equal_are_computed_once) {
  // 1.25 and 1.5 round to the same number: what follows has the same keys.
  const Dag dag = graph(R"("sweep": {"axes": {"value": [1.25, 1.5]}},)");
  const RunResult result = run(dag, store());
  EXPECT_EQ(toy::counters.source, 2);
  EXPECT_EQ(count(result, NodeStatus::run), 2u + 2u + 2u);
  EXPECT_EQ(count(result, NodeStatus::hit), 2u);
}

TEST_F(SweepRun, a_new_value_costs_only_what_is_new) {
  run(graph(R"("sweep": {"axes": {"value": [1, 2], "by": [1, 2]}},)"), store());
  toy::reset();
  const Dag dag = graph(R"("sweep": {"axes": {"value": [1, 2], "by": [1, 2, 7]}},)");
  const RunResult result = run(dag, store());
  EXPECT_EQ(toy::counters.source + toy::counters.round, 0);
  EXPECT_EQ(count(result, NodeStatus::run), 4u) << "two steps for each of two values";
  EXPECT_EQ(count(result, NodeStatus::hit), dag.nodes.size() - 4);
}

TEST_F(SweepRun, a_variant_that_fails_does_not_void_the_others) {
  const Dag dag = graph(R"("sweep": {"axes": {"by": [1, 2, 3], "fail_at": [-1, 3]}},)");
  const RunResult result = run(dag, store(), true);
  EXPECT_EQ(result.status, ExitCode::node_failed);
  EXPECT_EQ(count(result, NodeStatus::failed), 1u);
  const Json report = run_report(new_run_id("g.json"), dag, result);
  ASSERT_EQ(report["variants"].size(), 6u);
  for (const Json& variant : report["variants"]) {
    const bool fails = variant["params"]["by"] == 2.0 && variant["params"]["fail_at"] == 3.0;
    EXPECT_EQ(variant["status"], fails ? "failed" : "ok") << variant["name"];
    EXPECT_EQ(report["outputs"].contains(variant["name"].get<std::string>() + "/numbers"), !fails);
    for (const Json& path : variant["nodes"])
      EXPECT_TRUE(report["nodes"].contains(path.get<std::string>())) << path;
  }
}

TEST_F(SweepRun, parts_of_a_sweep_have_names) {
  const Dag dag = graph(R"("sweep": {"axes": {"value": [1, 2], "by": [1, 2]}},)");
  EXPECT_EQ(nodes_named(dag, "step").size(), 4u);
  EXPECT_EQ(nodes_named(dag, "[value=1]/source").size(), 1u);
  EXPECT_EQ(nodes_named(dag, "value=1,by=2").size(), 4u);
  EXPECT_THROW(nodes_named(dag, "value=1,by=3"), Error);
}

TEST_F(SweepRun, costs_are_known_for_hits_too) {
  const Dag dag = graph(R"("sweep": {"axes": {"by": [1, 2]}},)");
  const RunResult first = run(dag, store());
  const RunResult second = run(dag, store());
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    EXPECT_EQ(second.nodes[i].seconds, 0);
    EXPECT_EQ(second.nodes[i].cost_seconds, first.nodes[i].seconds);
  }
}

TEST_F(SweepRun, a_thousand_variants_cost_milliseconds) {
  std::string values = "1";
  for (int i = 2; i <= 1000; ++i) values += "," + std::to_string(i);
  const std::string sections = R"("sweep": {"axes": {"by": [)" + values + "]}},";
  auto cpu = [last = std::clock()]() mutable {
    const std::clock_t now = std::clock();
    const double seconds = static_cast<double>(now - std::exchange(last, now)) / CLOCKS_PER_SEC;
    return seconds * 1e3;
  };
  const Dag dag = graph(sections);
  const double expanded = cpu();
  run(dag, Store::open({}));
  const double without_store = cpu();
  const RunResult first = run(dag, store());
  const double ran = cpu();
  const RunResult second = run(dag, store());
  const double again = cpu();
  const std::string id = new_run_id("g.json");
  EXPECT_TRUE(save_run(*store(), id, manifests_of(dag, second), run_report(id, dag, second)));
  const double recorded = cpu();
  EXPECT_EQ(count(first, NodeStatus::run), 2002u);
  EXPECT_EQ(count(second, NodeStatus::hit), 2002u);
  std::printf(
      "1000 variants, 2002 nodes, CPU ms: expanded %.1f, run without a cache %.1f, with one %.1f, from the "
      "cache "
      "%.1f, recorded %.1f\n",
      expanded, without_store, ran, again, recorded);
  EXPECT_LT(expanded + again + recorded, 3000);
}

}  // namespace
}  // namespace ballflow
