// Maps when they run: what is computed again when a list changes.
#include <gtest/gtest.h>

#include "ballflow/explain.hpp"
#include "ballflow/run.hpp"
#include "run_fixture.hpp"

namespace ballflow {
namespace {

struct MapRun : RunTest {
  Dag graph(const std::string& names, const std::string& file = "g.json") {
    test::write_file(folder.file("body.json"), R"({"params":{"value":{"kind":"number"}},
      "nodes":{"source":{"type":"Source","params":{"value":"${value}","count":1}},
               "add":{"type":"Add","inputs":{"a":"source.numbers","b":"source.numbers"}}},
      "outputs":{"sum":"add.sum"}})");
    return parse_graph(R"({"params":{"values":{"kind":"list"}},
      "nodes":{"each":{"map":"body.json","over":{"value":"${values}"}},
               "all":{"type":"Concat","inputs":{"lists":"each.sum"}}},
      "outputs":{"all":"all.all"}})",
                       folder.file(file), registry, {{"values", names}});
  }
  std::shared_ptr<Store> fresh() {
    return Store::open({folder.path() + "/other cache" + std::to_string(++caches_), false});
  }
  static Digest result_of(const Dag& dag, const RunResult& result) {
    return result.nodes[dag.outputs[0].from.node].outputs.at(0).digest;
  }
  int caches_ = 0;
};

TEST_F(MapRun, a_changed_list_computes_what_is_new_and_no_more) {
  const auto cache = store();
  run(graph("1,2,3"), cache);
  EXPECT_EQ(toy::counters.add, 3);
  run(graph("3,1"), cache);
  EXPECT_EQ(toy::counters.add, 3);
  run(graph("4,3,2,1"), cache);
  EXPECT_EQ(toy::counters.add, 4);
  EXPECT_EQ(toy::counters.source, 4);
}

TEST_F(MapRun, order_is_that_of_the_list_for_any_number_of_threads) {
  const Dag one = graph("3,1,2"), other = graph("1,2,3");
  const Digest first = result_of(one, run(one, store(), 1));
  EXPECT_EQ(first, result_of(one, run(one, fresh(), 4)));
  EXPECT_NE(first, result_of(other, run(other, fresh(), 4)));
}

TEST_F(MapRun, entries_that_say_the_same_are_computed_once) {
  const Dag dag = graph("1,1.0,1e0");
  EXPECT_EQ(dag.nodes.size(), 7U);
  run(dag, store());
  EXPECT_EQ(toy::counters.add, 1);
}

TEST_F(MapRun, a_plan_knows_every_copy) {
  const auto cache = store();
  const Dag before = graph("1,2");
  run(before, cache);
  const Dag now = graph("1,5");
  const std::vector<NodePlan> plans = plan(now, *cache, 0, {});
  ASSERT_EQ(plans.size(), now.nodes.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const bool known = now.nodes[i].path.starts_with("each[1]");
    if (known) {
      EXPECT_EQ(to_string(plans[i].verdict), "HIT");
    }
    if (now.nodes[i].path == "each[5]/source") {
      EXPECT_EQ(to_string(plans[i].verdict), "RUN");
    }
  }
}

}  // namespace
}  // namespace ballflow
