// Graphs as text for Graphviz.
#include "ballflow/dot.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "process.hpp"
#include "test_data.hpp"
#include "toy_nodes.hpp"

namespace ballflow {
namespace {

struct DotTest : testing::Test {
  Dag parse(const std::string& text, const std::vector<Setting>& settings = {}) {
    return parse_graph(text, folder.file("graph.json"), registry, settings);
  }
  static std::vector<std::smatch> all(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    return {std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()};
  }
  /// Graphviz's own opinion, where it is installed.
  void expect_accepted(const std::string& text) {
    if (test::run_process({"/usr/bin/env", "dot", "-V"}).exit_code != 0) return;
    test::write_file(folder.file("graph.dot"), text);
    const auto result = test::run_process({"/usr/bin/env", "dot", "-Tsvg", folder.file("graph.dot")});
    EXPECT_EQ(result.exit_code, 0) << result.err << text;
    EXPECT_EQ(result.err, "") << text;
  }
  Registry registry = test::toy_registry();
  test::TempFolder folder;
};

const char* const prune = R"({
  "inputs": { "balls": { "type": "Balls" }, "points": { "type": "Points" } },
  "nodes": {
    "match": { "type": "Match", "inputs": { "balls": "inputs.balls", "points": "inputs.points" } },
    "rounds": { "loop": "round.json", "inputs": { "cover": "match.cover" }, "until": "cover.remaining <= 3 and cover.gap < 0.5" }
  },
  "outputs": { "cover": "rounds.cover" } })";

const char* const round = R"({
  "inputs": { "cover": { "type": "Cover" } },
  "nodes": { "first": { "type": "Trim", "inputs": { "cover": "inputs.cover" }, "params": { "keep": 0.5 } },
             "second": { "type": "Trim", "inputs": { "cover": "first.cover" }, "params": { "keep": 1 } } },
  "outputs": { "cover": "second.cover" } })";

const char* const top = R"({
  "doc": "Prunes \"balls\" & <more>.",
  "nodes": {
    "load": { "type": "Load", "params": { "file": "a <b>&\"c\".off" } },
    "grow": { "type": "Grow", "inputs": { "points": "load.points" }, "params": { "label": "\\n\u0007" } },
    "prune": { "graph": "prune.json", "inputs": { "balls": "grow.balls", "points": "load.points" } }
  },
  "outputs": { "cover": "prune.cover", "balls": "grow.balls" } })";

TEST_F(DotTest, shows_every_node_and_every_edge_between_ports_that_exist) {
  test::write_file(folder.file("prune.json"), prune);
  test::write_file(folder.file("round.json"), round);
  const Dag dag = parse(top);
  const std::string text = dot(dag);
  // Nodes: id -> ports of its table.
  std::map<std::string, std::set<std::string>> ports;
  for (const std::smatch& node : all(text, R"(\n\s*(\w+) \[label=<(<TABLE.*</TABLE>)>\];)")) {
    const std::string table = node[2];  // the matches point into it
    for (const std::smatch& port : all(table, R"re(PORT="(\w+)")re")) ports[node[1]].insert(port[1]);
  }
  ASSERT_EQ(ports.size(), 6u) << "load, grow, match, rounds, first, second:\n" << text;
  std::size_t edges = 0, back = 0;
  for (const std::smatch& edge : all(text, R"((\w+):(\w+)(:\w)? -> (\w+)(:(\w+))?)")) {
    ++edges;
    ASSERT_EQ(ports.count(edge[1]), 1u) << edge[0];
    EXPECT_EQ(ports[edge[1]].count(edge[2]), 1u) << edge[0];
    if (edge[4].str().rfind("out", 0) == 0 && !edge[5].matched) continue;  // an output of the graph
    ASSERT_EQ(ports.count(edge[4]), 1u) << edge[0];
    EXPECT_EQ(ports[edge[4]].count(edge[6]), 1u) << edge[0];
  }
  back = all(text, "style=dashed, constraint=false").size();
  // 4 between nodes, 2 to outputs, and in the loop: state to first, first to second, second back.
  EXPECT_EQ(edges, 4u + 2u + 3u) << text;
  EXPECT_EQ(back, 1u);
  EXPECT_EQ(all(text, "subgraph \"cluster_").size(), 2u) << "prune, and the loop in it";
  EXPECT_NE(text.find("label=\"prune\""), std::string::npos);
  EXPECT_NE(text.find("label=\"loop until cover.remaining <= 3 and cover.gap < 0.5\""), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
  expect_accepted(text);
}

TEST_F(DotTest, escapes_all_text) {
  test::write_file(folder.file("prune.json"), prune);
  test::write_file(folder.file("round.json"), round);
  const std::string text = dot(parse(top));
  EXPECT_NE(text.find("label=\"Prunes \\\"balls\\\" &amp; <more>.\""), std::string::npos) << text;
  EXPECT_NE(text.find("file = a &lt;b&gt;&amp;&quot;c&quot;.off"), std::string::npos) << text;
  EXPECT_NE(text.find("label = \\n?"), std::string::npos) << "no control characters\n" << text;
  EXPECT_EQ(text.find('\a'), std::string::npos);
  expect_accepted(text);
}

TEST_F(DotTest, shows_parameters_that_are_not_default_and_cuts_long_ones) {
  const std::string text = dot(parse(R"({ "nodes": {
      "load": { "type": "Load", "params": { "file": ")" +
                                     std::string(60, 'x') + R"(", "scale": 1, "mode": "exact" } } } })"));
  EXPECT_NE(text.find(std::string(48, 'x') + "..."), std::string::npos);
  EXPECT_EQ(text.find(std::string(49, 'x')), std::string::npos);
  EXPECT_NE(text.find("mode = exact"), std::string::npos);
  EXPECT_EQ(text.find("scale"), std::string::npos) << "1 is the default";
}

TEST_F(DotTest, shows_what_a_plan_says) {
  const Dag dag = parse(R"({ "nodes": {
      "a": { "type": "Load", "params": { "file": "a" } }, "b": { "type": "Grow", "inputs": { "points": "a.points" } } } })");
  std::vector<NodePlan> plans(2);
  plans[0].verdict = NodePlan::Verdict::hit;
  plans[1].verdict = NodePlan::Verdict::maybe;
  const std::string text = dot(dag, plans);
  EXPECT_NE(text.find("<B>HIT</B>"), std::string::npos);
  EXPECT_NE(text.find("<B>MAYBE</B>"), std::string::npos);
  EXPECT_EQ(dot(dag).find("<B>HIT</B>"), std::string::npos);
  expect_accepted(text);
}

TEST_F(DotTest, nodes_of_one_subgraph_stand_in_one_cluster_whatever_their_order_is) {
  // "a-b" sorts between "a" and "a/x".
  test::write_file(folder.file("sub.json"), R"({ "nodes": {
      "x": { "type": "Load", "params": { "file": "x" } }, "deep": { "graph": "deep.json" } } })");
  test::write_file(folder.file("deep.json"),
                   R"({ "nodes": { "y": { "type": "Load", "params": { "file": "y" } } } })");
  const std::string text = dot(parse(
      R"({ "nodes": { "a": { "graph": "sub.json" }, "a-b": { "graph": "sub.json" }, "z": { "graph": "deep.json" } } })"));
  EXPECT_EQ(all(text, "subgraph \"cluster_").size(), 5u) << text;
  for (const char* name : {"a", "a-b", "z"})
    EXPECT_EQ(all(text, "label=\"" + std::string(name) + "\"").size(), 1u) << name;
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
  expect_accepted(text);
}

}  // namespace
}  // namespace ballflow
