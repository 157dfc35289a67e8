// Units: written and read again, and how nodes are packed into them.
#include "ballflow/units.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

struct UnitsTest : testing::Test {
  UnitsTest() { registry.add_plugin(toy::plugin(), "toy"); }

  std::size_t node(const std::string& path, const std::string& type, std::vector<EdgeRef> from = {},
                   const std::map<std::string, Json>& params = {}) {
    DagNode n{path, *registry.node(type)};
    for (const ParamDecl& param : n.kind.params()) n.params[param.name] = param.default_value;
    for (const auto& [name, value] : params) n.params[name] = value;
    for (std::size_t i = 0; i < from.size(); ++i) n.inputs[n.kind.inputs()[i].name] = from[i];
    dag.nodes.push_back(std::move(n));
    NodePlan& plan = plans.emplace_back();
    plan.verdict = NodePlan::Verdict::run;
    plan.seconds = 1;
    return dag.nodes.size() - 1;
  }
  std::size_t source(const std::string& path) { return node(path, "Source"); }
  std::size_t round(const std::string& path, std::size_t from) {
    return node(path, "Round", {{from, port(from)}});
  }
  std::size_t add(const std::string& path, std::size_t a, std::size_t b) {
    return node(path, "Add", {{a, port(a)}, {b, port(b)}});
  }
  std::string port(std::size_t i) const { return dag.nodes[i].kind.outputs()[0].name; }
  /// models: a source, then `variants` chains of two, then a sum of the first two.
  void sweep(int models, int variants) {
    for (int m = 0; m < models; ++m) {
      const std::string name = "m" + std::to_string(m);
      const auto load = source(name + "/load");
      std::vector<std::size_t> ends;
      for (int v = 0; v < variants; ++v) {
        const std::string path = name + "/v" + std::to_string(v);
        ends.push_back(round(path + "/metric", round(path + "/prune", load)));
      }
      add(name + "/report", ends[0], ends[1]);
    }
  }

  Registry registry;
  Dag dag;
  std::vector<NodePlan> plans;
};

TEST_F(UnitsTest, a_unit_that_was_written_is_read_with_the_same_keys) {
  const auto a = node("a", "Source", {}, {{"value", 0.1 + 0.2}, {"count", 7}});
  const auto b = node("b", "Source", {}, {{"value", 3.0}});
  const auto sum = add("sum", a, b);
  const auto last = round("last", sum);
  plans[a].verdict = NodePlan::Verdict::hit;
  const auto store = Store::open({});
  plans[a].manifest = action_key(dag.nodes[a], {}, 0, *store).manifest;
  std::vector<std::string> unit_of(dag.nodes.size());
  unit_of[b] = "0-0";
  unit_of[sum] = unit_of[last] = "1-0";
  Unit unit = make_unit(dag, plans, {sum, last}, unit_of);
  unit.run = "run";
  unit.name = "1-0";
  unit.seed = (std::uint64_t{1} << 63) + 5;
  const Unit read = read_unit(unit_text(unit), registry);
  EXPECT_EQ(unit_text(read), unit_text(unit));
  EXPECT_EQ(read.seed, unit.seed);
  ASSERT_EQ(read.outside.size(), 2u);
  EXPECT_EQ(read.outside[0].key, key_of(plans[a].manifest));
  EXPECT_EQ(read.outside[1].unit, "0-0");
  EXPECT_EQ(read.outside[1].path, "b");
  ASSERT_EQ(read.nodes.size(), 2u);
  EXPECT_EQ(read.nodes[1].inputs.at("numbers").node, 0u);
  EXPECT_EQ(read.nodes[0].inputs.at("a").node, 2u);
  EXPECT_EQ(read.nodes[0].inputs.at("b").node, 3u);

  const Unit sources = read_unit(unit_text(make_unit(dag, plans, {a, b}, unit_of)), registry);
  for (const auto& [i, j] : {std::pair(a, 0), std::pair(b, 1)}) {
    EXPECT_EQ(action_key(sources.nodes[static_cast<std::size_t>(j)], {}, 0, *store).key,
              action_key(dag.nodes[i], {}, 0, *store).key);
  }
}

TEST_F(UnitsTest, a_loop_keeps_its_key) {
  const test::TempFolder folder;
  test::write_file(folder.file("body.json"),
                   R"({"inputs": {"sum": {"type": "Numbers"}, "b": {"type": "Numbers"}},
    "nodes": {"add": {"type": "Add", "inputs": {"a": "inputs.sum", "b": "inputs.b"}}},
    "outputs": {"sum": "add.sum"}})");
  test::write_file(folder.file("graph.json"), R"({"nodes": {
    "a": {"type": "Source"},
    "loop": {"loop": "body.json", "inputs": {"sum": "a.numbers", "b": "a.numbers"},
             "until": "sum.first >= 4.5 or sum.count == 0 and sum.first > 1", "max_iterations": 50, "at_limit": "stop"}},
    "outputs": {"sum": "loop.sum"}})");
  dag = load_graph(folder.file("graph.json"), registry);
  plans.resize(2);
  const Unit read = read_unit(unit_text(make_unit(dag, plans, {0, 1}, {"", ""})), registry);
  const auto store = Store::open({});
  const auto numbers = [](const char* content) {
    OutputEntry entry;
    entry.port = "numbers";
    entry.type = "Numbers";
    entry.type_version = 1;
    entry.digest = sha256(content);
    return entry;
  };
  const std::map<std::string, OutputEntry> inputs{{"sum", numbers("a")}, {"b", numbers("b")}};
  EXPECT_EQ(action_key(read.nodes[1], inputs, 0, *store).key,
            action_key(dag.nodes[1], inputs, 0, *store).key);
  const Loop &before = *dag.nodes[1].kind.loop(), &after = *read.nodes[1].kind.loop();
  EXPECT_EQ(after.conditions.size(), before.conditions.size());
  EXPECT_EQ(after.conditions[1][1].number, 1);
  EXPECT_EQ(after.max_iterations, 50);
  EXPECT_TRUE(after.stop_at_limit);
  EXPECT_EQ(after.body.outputs[0].from.node, 0u);
}

TEST_F(UnitsTest, what_is_no_unit_is_refused_with_words) {
  const auto refusal = [this](const std::string& text) {
    try {
      read_unit(text, registry);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  const auto a = source("a");
  round("b", a);
  const std::string good = unit_text(make_unit(dag, plans, {0, 1}, {"", ""}));
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    return at == std::string::npos ? "not found" : text.replace(at, from.size(), to);
  };
  EXPECT_EQ(refusal(good), "read");
  EXPECT_NE(refusal("{}").find("no unit"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("no unit"), std::string::npos);
  EXPECT_NE(refusal(with("\"format\":1", "\"format\":9")).find("format 9"), std::string::npos);
  EXPECT_NE(refusal(with("\"Round\"", "\"Square\"")).find("no node library here has a node Square"),
            std::string::npos);
  EXPECT_NE(refusal(with("\"version\":1", "\"version\":2")).find("behaviour version"), std::string::npos);
  EXPECT_NE(refusal(with("[0,\"numbers\"]", "[1,\"numbers\"]")).find("an edge leads to node 1"),
            std::string::npos);
  EXPECT_NE(refusal(with("[0,\"numbers\"]", "[-1,\"numbers\"]")).find("an edge leads to node -1"),
            std::string::npos);
}

TEST_F(UnitsTest, every_node_that_has_to_run_is_in_one_unit_and_reads_from_earlier_arrays_alone) {
  sweep(7, 5);
  plans[0].verdict = NodePlan::Verdict::hit;
  PackOptions options;
  options.unit_seconds = 4;
  options.most_units = 3;
  const auto arrays = pack(dag, plans, options);
  std::vector<std::pair<std::size_t, std::size_t>> place(dag.nodes.size(), {99, 99});
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    EXPECT_LE(arrays[a].units.size(), 3u);
    for (std::size_t u = 0; u < arrays[a].units.size(); ++u) {
      EXPECT_TRUE(std::is_sorted(arrays[a].units[u].nodes.begin(), arrays[a].units[u].nodes.end()));
      for (const std::size_t i : arrays[a].units[u].nodes) {
        EXPECT_EQ(place[i].first, 99u) << "twice";
        place[i] = {a, u};
      }
    }
  }
  EXPECT_EQ(place[0].first, 99u) << "is done";
  for (std::size_t i = 1; i < dag.nodes.size(); ++i) {
    ASSERT_NE(place[i].first, 99u);
    for (const auto& [slot, edge] : dag.nodes[i].inputs) {
      if (edge.node == 0 || place[edge.node] == place[i]) continue;
      const auto& needs = arrays[place[i].first].needs;
      EXPECT_LT(place[edge.node].first, place[i].first);
      EXPECT_TRUE(std::count(needs.begin(), needs.end(), place[edge.node].first) == 1);
    }
  }
}

TEST_F(UnitsTest, chains_are_one_piece_and_short_pieces_are_packed) {
  sweep(4, 3);
  PackOptions options;
  options.unit_seconds = 1000;
  const auto arrays = pack(dag, plans, options);
  ASSERT_EQ(arrays.size(), 3u) << "loads, chains of two, reports";
  EXPECT_EQ(arrays[0].units.size(), 1u);
  EXPECT_EQ(arrays[1].units[0].nodes.size(), 4u * 3 * 2);
  EXPECT_EQ(arrays[1].needs, std::vector<std::size_t>{0});
  EXPECT_EQ(arrays[2].units[0].seconds, 4);
  options.unit_seconds = 6;
  const auto smaller = pack(dag, plans, options);
  EXPECT_EQ(smaller[1].units.size(), 4u);
  for (const PackedUnit& unit : smaller[1].units) EXPECT_EQ(unit.seconds, 6);
}

TEST_F(UnitsTest, a_long_node_is_a_unit_of_its_own_and_task_by_task_edges_are_found) {
  for (const char* model : {"a", "b", "c"}) {
    const auto load = source(std::string(model) + "/load");
    const auto left = round(std::string(model) + "/left", load),
               right = round(std::string(model) + "/right", load);
    add(std::string(model) + "/sum", left, right);
  }
  for (NodePlan& plan : plans) plan.seconds = 500;
  PackOptions options;
  const auto arrays = pack(dag, plans, options);
  ASSERT_EQ(arrays.size(), 3u);
  EXPECT_EQ(arrays[0].units.size(), 3u);
  EXPECT_EQ(arrays[1].units.size(), 6u);
  EXPECT_FALSE(arrays[1].one_to_one);
  EXPECT_EQ(arrays[1].longest(), 500);
  for (NodePlan& plan : plans) plan.seconds = 200;  // both halves of a model in one unit
  const auto paired = pack(dag, plans, options);
  EXPECT_EQ(paired[1].units.size(), 3u);
}

TEST_F(UnitsTest, what_may_end_its_process_is_a_unit_of_its_own) {
  sweep(1, 6);
  PackOptions options;
  options.unit_seconds = 1000;
  options.alone.assign(dag.nodes.size(), false);
  options.alone[5] = true;  // the third chain
  const auto arrays = pack(dag, plans, options);
  ASSERT_EQ(arrays[1].units.size(), 3u);
  EXPECT_EQ(arrays[1].units[1].nodes, (std::vector<std::size_t>{5, 6}));
}

TEST_F(UnitsTest, memory_is_a_class_and_what_ran_out_gets_more) {
  source("a");
  source("b");
  plans[1].memory = 3u << 30;
  const auto arrays = pack(dag, plans, {});
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].memory, 512u << 20);
  EXPECT_EQ(arrays[1].memory, std::uint64_t{8} << 30);
  PackOptions more;
  more.memory_factor = {2, 1};
  more.time_factor = {1, 4};
  const auto grown = pack(dag, plans, more);
  EXPECT_EQ(grown[0].memory, 1024u << 20);
  EXPECT_EQ(grown[1].time_factor, 4);
}

}  // namespace
}  // namespace ballflow
