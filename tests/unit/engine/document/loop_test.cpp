// Loops in graph files: what they become, and what is reported where.
#include <gtest/gtest.h>

#include "ballflow/graph.hpp"
#include "document_fixture.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

struct graph_loop : testing::Test {
  /// A graph around the loop l, whose text begins in line 2, column 1.
  std::string with_loop(const std::string& loop) {
    return R"({"outputs":{"o":"l.cover"},"nodes":{"p":{"type":"Load","params":{"file":"x"}},"g":{"type":"Grow","inputs":{"points":"p.points"}},"m":{"type":"Match","inputs":{"points":"p.points","balls":"g.balls"}},)"
           "\n" +
           loop + "}}";
  }

  Dag parse(const std::string& text, const std::vector<Setting>& settings = {}) {
    return parse_graph(text, folder.file("g.json"), registry(), settings);
  }

  std::string errors(const std::string& text, const std::vector<Setting>& settings = {}) {
    try {
      parse(text, settings);
    } catch (const GraphError& error) {
      std::string shown;
      for (const Diagnostic& d : error.findings()) {
        if (d.severity == Diagnostic::Severity::warning) continue;
        const std::string prefix = folder.path() + "/";
        shown += (d.file.starts_with(prefix) ? d.file.substr(prefix.size()) : d.file) + ":" +
                 std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.message + " (at " +
                 d.pointer + ")\n";
        if (!d.hint.empty()) shown += "  " + d.hint + "\n";
      }
      return shown;
    }
    return {};
  }

  void body(const std::string& text) { test::write_file(folder.file("body.json"), text); }

  /// Errors of a loop whose condition is `until`.
  std::string until_errors(const std::string& until) {
    body(good_body);
    return errors(
        with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":")" + until + "\"}"));
  }

  static constexpr const char* good_body =
      R"({"params":{"keep":{"kind":"number","default":0.5}},"inputs":{"cover":{"type":"Cover"}},
"nodes":{"t":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":"${keep}"}}},
"outputs":{"cover":"t.cover"}})";
  test::TempFolder folder;
};

TEST_F(graph_loop, is_one_node_with_the_body_inside) {
  body(good_body);
  const Dag dag = parse(with_loop(
      R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"params":{"keep":0.25},"until":"cover.remaining == 0 or cover.gap < 1e-2 and cover.remaining <= 5"})"));
  ASSERT_EQ(dag.nodes.size(), 4u);
  const DagNode& node = dag.nodes.back();
  EXPECT_EQ(node.path, "l");
  EXPECT_EQ(dag.outputs[0].from.node, 3u);
  EXPECT_EQ(node.inputs.at("cover").port, "cover");
  ASSERT_NE(node.kind.loop(), nullptr);
  EXPECT_EQ(node.params.at("max_iterations"), 10'000);
  EXPECT_EQ(node.params.at("at_limit"), "error");
  ASSERT_EQ(node.kind.loop()->body.nodes.size(), 1u);
  const DagNode& trim = node.kind.loop()->body.nodes[0];
  EXPECT_EQ(trim.path, "l/t");
  EXPECT_EQ(trim.params.at("keep"), 0.25);
  EXPECT_EQ(trim.inputs.at("cover").node, loop_input);
  EXPECT_EQ(trim.inputs.at("cover").port, "cover");
  EXPECT_EQ(trim.place.file, folder.file("body.json"));
  ASSERT_EQ(node.kind.loop()->body.outputs.size(), 1u);
  EXPECT_EQ(node.kind.loop()->body.outputs[0].from.node, 0u);
  const auto& conditions = node.kind.loop()->conditions;
  ASSERT_EQ(conditions.size(), 2u);
  ASSERT_EQ(conditions[1].size(), 2u);
  EXPECT_EQ(conditions[0][0].op, Loop::Comparison::Op::equal);
  EXPECT_EQ(conditions[1][0].field, "gap");
  EXPECT_EQ(conditions[1][0].number, 0.01);
  EXPECT_EQ(conditions[1][1].op, Loop::Comparison::Op::at_most);
}

TEST_F(graph_loop, bodies_may_have_subgraphs_and_a_graph_with_a_loop_may_be_one) {
  test::write_file(
      folder.file("trim.json"),
      R"({"inputs":{"c":{"type":"Cover"}},"nodes":{"t":{"type":"Trim","inputs":{"cover":"inputs.c"},"params":{"keep":1}}},"outputs":{"c":"t.cover"}})");
  body(
      R"({"inputs":{"cover":{"type":"Cover"}},"nodes":{"s":{"graph":"trim.json","inputs":{"c":"inputs.cover"}}},"outputs":{"cover":"s.c"}})");
  test::write_file(
      folder.file("strategy.json"),
      R"({"inputs":{"cover":{"type":"Cover"}},"nodes":{"r":{"loop":"body.json","inputs":{"cover":"inputs.cover"},"until":"cover.remaining < 1"}},"outputs":{"cover":"r.cover"}})");
  const Dag dag = parse(with_loop(R"("l":{"graph":"strategy.json","inputs":{"cover":"m.cover"}})"));
  const DagNode* node = dag.find("l/r");
  ASSERT_NE(node, nullptr);
  ASSERT_EQ(node->kind.loop()->body.nodes.size(), 1u);
  EXPECT_EQ(node->kind.loop()->body.nodes[0].path, "l/r/s/t");
  EXPECT_EQ(node->kind.loop()->body.nodes[0].inputs.at("cover").node, loop_input);
}

TEST_F(graph_loop, settings_belong_to_loops_and_until_is_needed) {
  body(good_body);
  EXPECT_EQ(errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"}})")),
            "g.json:2:1: loop \"l\" has no \"until\" (at /nodes/l)\n"
            "  \"until\": \"state.field == 0\", a field of the summary of a state\n");
  EXPECT_EQ(errors(with_loop(R"("l":{"graph":"body.json","inputs":{"cover":"m.cover"},"at_limit":"stop"})")),
            "g.json:2:55: \"at_limit\" is for loops, node \"l\" is none (at /nodes/l/at_limit)\n"
            "  \"loop\": \"body.json\" makes a node a loop\n");
  EXPECT_EQ(
      errors(with_loop(
          R"("l":{"loop":"body.json","graph":"body.json","inputs":{"cover":"m.cover"},"until":"cover.gap < 1"})")),
      "g.json:2:13: node \"l\" has both \"graph\" and \"loop\" (at /nodes/l/loop)\n  keep one of them\n");
}

TEST_F(graph_loop, settings_out_of_range) {
  body(good_body);
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":7,
"max_iterations":0,
"at_limit":"stopp"})")),
      "g.json:2:62: \"until\" must be a text, is 7 (at /nodes/l/until)\n"
      "  until: ends the loop, looked at before every iteration: fields of the summaries of states compared "
      "with numbers, joined by \"and\" and \"or\", like \"cover.remaining == 0\"\n"
      "g.json:3:18: \"max_iterations\" must be at least 1, is 0 (at /nodes/l/max_iterations)\n"
      "  max_iterations: how often the body runs at most\n"
      "g.json:4:12: \"at_limit\" must be one of \"error\", \"stop\", is the text \"stopp\" (at "
      "/nodes/l/at_limit)\n"
      "  did you mean \"stop\"?\n");
}

TEST_F(graph_loop, syntax_of_until_with_the_place_in_the_text) {
  const std::string hint = "  write it like \"cover.remaining == 0 or cover.gap < 0.01\"\n";
  const auto at = [&](int column, const std::string& message) {
    return "g.json:2:" + std::to_string(62 + column) + ": \"until\": " + message + " (at /nodes/l/until)\n" +
           hint;
  };
  EXPECT_EQ(until_errors("cover.remaining == 0"), "");
  EXPECT_EQ(until_errors(""), at(1, "expected the name of a state, found the end"));
  EXPECT_EQ(until_errors("cover"),
            at(6, "expected \".\" and a field of the summary of \"cover\", found the end"));
  EXPECT_EQ(until_errors("cover.remaining"), at(16, "expected ==, !=, <, <=, > or >=, found the end"));
  EXPECT_EQ(until_errors("cover.remaining = 0"), at(17, "expected ==, !=, <, <=, > or >=, found \"= 0\""));
  EXPECT_EQ(until_errors("cover.remaining == many"), at(20, "expected a number, found \"many\""));
  EXPECT_EQ(until_errors("cover.remaining == nan"), at(20, "expected a number, found \"nan\""));
  EXPECT_EQ(until_errors("cover.gap < 1 && cover.gap > 0"),
            at(15, "expected \"and\", \"or\" or the end, found \"&& cover.gap > 0\""));
  EXPECT_EQ(until_errors("cover.gap < 1 or"), at(17, "expected the name of a state, found the end"));
  EXPECT_EQ(until_errors("cover.gap < 1and"), at(14, "expected a space after the number, found \"and\""));
}

TEST_F(graph_loop, until_names_states_and_fields_that_exist) {
  EXPECT_EQ(until_errors("cver.remaining == 0 or cover.remainin == 0"),
            "g.json:2:63: \"until\": loop \"l\" has no state \"cver\" (at /nodes/l/until)\n"
            "  did you mean \"cover\"?\n"
            "g.json:2:92: \"until\": the summary of a Cover has no field \"remainin\" (at /nodes/l/until)\n"
            "  did you mean \"remaining\"?\n");
  body(
      R"({"inputs":{"b":{"type":"Balls"},"p":{"type":"Points"}},"nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p"}}},"outputs":{"b":"g.balls"}})");
  EXPECT_EQ(
      errors(
          R"({"nodes":{"p":{"type":"Load","params":{"file":"x"}},"g":{"type":"Grow","inputs":{"points":"p.points"}},
"l":{"loop":"body.json","inputs":{"b":"g.balls","p":"p.points"},"until":"b.count == 0 or p.count == 0"}},"outputs":{"b":"l.b"}})"),
      "g.json:2:76: \"until\": the summary of a Balls has no field \"count\" (at /nodes/l/until)\n"
      "  it has no fields\n"
      "g.json:2:90: \"until\": loop \"l\" has no state \"p\" (at /nodes/l/until)\n"
      "  did you mean \"b\"?\n");
}

TEST_F(graph_loop, a_wrong_condition_from_an_override_names_the_override) {
  body(good_body);
  EXPECT_EQ(
      errors(with_loop(
                 R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":"cover.remaining == 0"})"),
             {{"l.until", "cover.rest == 0"}}),
      "--set l.until=cover.rest == 0:0:0: \"until\": the summary of a Cover has no field \"rest\" (at )\n"
      "  fields are \"remaining\", \"gap\"\n");
}

TEST_F(graph_loop, every_output_of_the_body_is_a_state_that_fits) {
  body(R"({"inputs":{"cover":{"type":"Cover","optional":true},
"rest":{"type":"Points"},"balls":{"type":"Balls"},"points":{"type":"Points"}},
"nodes":{"m":{"type":"Match","inputs":{"balls":"inputs.balls","points":"inputs.points"}}},
"outputs":{"cover":"m.cover",
"rest":"m.rest",
"more":"m.rest"}})");
  EXPECT_EQ(
      errors(with_loop(
          R"("l":{"loop":"body.json","inputs":{"cover":"m.cover","rest":"p.points","balls":"g.balls","points":"p.points"},"until":"cover.gap < 1"})")),
      "body.json:1:12: input \"cover\" is a state of loop \"l\" and cannot be optional (at /inputs/cover)\n"
      "body.json:5:8: \"m.rest\" is a Balls, but state \"rest\" of the loop begins as a Points (at "
      "/outputs/rest)\n"
      "  a loop passes its outputs to its inputs: their types must agree\n"
      "body.json:6:1: output \"more\" is a state of loop \"l\", but there is no input of that name (at "
      "/outputs/more)\n"
      "  a loop passes its outputs to its inputs: declare \"more\" under \"inputs\" with the type of the "
      "output\n");
}

TEST_F(graph_loop, edges_at_the_loop_are_checked_like_those_of_any_node) {
  body(good_body);
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"g.balls"},"until":"cover.gap < 1"})")),
      "g.json:2:43: \"g.balls\" is a Balls, but input \"cover\" of node \"l\" (loop) takes a Cover (at "
      "/nodes/l/inputs/cover)\n"
      "  \"cover\": \"m.cover\" would be a Cover\n");
  EXPECT_EQ(errors(with_loop(R"("l":{"loop":"body.json","until":"cover.gap < 1"})")),
            "g.json:2:1: node \"l\" (loop) misses its input \"cover\" (Cover) (at /nodes/l)\n"
            "  \"cover\": \"m.cover\" would be a Cover\n");
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"l.cover"},"until":"cover.gap < 1"})")),
      "g.json:2:43: cycle: l -> l (at /nodes/l/inputs/cover)\n  remove one of these edges\n");
}

TEST_F(graph_loop, bodies_without_state_or_with_parameters_named_like_settings) {
  body(R"({"inputs":{"cover":{"type":"Cover"}},"nodes":{}})");
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":"cover.gap < 1"})")),
      "g.json:2:13: loop \"l\" has no state: " + folder.file("body.json") +
          " has no \"outputs\" (at /nodes/l/loop)\n"
          "  a loop passes its outputs to its inputs of the same names\n");
  body(R"({"params":{"until":{"kind":"number","default":1}},"inputs":{"cover":{"type":"Cover"}},
"nodes":{"t":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":"${until}"}}},"outputs":{"cover":"t.cover"}})");
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":"cover.gap < 1"})")),
      "body.json:1:12: the body of loop \"l\" cannot have a parameter \"until\" (at /params/until)\n"
      "  every loop has a parameter of that name; choose another one\n");
}

TEST_F(graph_loop, errors_in_the_body_are_all_reported) {
  body(R"({"inputs":{"cover":{"type":"Covr"}},
"nodes":{"t":{"type":"Trimm","inputs":{"cover":"inputs.cover"}},
"u":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":2}}},"outputs":{"cover":"t.cover"}})");
  EXPECT_EQ(
      errors(with_loop(R"("l":{"loop":"body.json","inputs":{"cover":"m.cover"},"until":"cover.gap < 1"})")),
      "body.json:1:28: unknown type \"Covr\" (at /inputs/cover/type)\n"
      "  did you mean \"Cover\"?\n"
      "body.json:2:22: unknown node type \"Trimm\" (at /nodes/t/type)\n"
      "  did you mean \"Trim\"?\n"
      "body.json:3:71: \"keep\" must be at most 1, is 2 (at /nodes/u/params/keep)\n"
      "  keep: share that stays\n");
  test::write_file(folder.file("self.json"),
                   R"({"inputs":{"cover":{"type":"Cover"}},"nodes":{
"r":{"loop":"self.json","inputs":{"cover":"inputs.cover"},"until":"cover.gap < 1"}},"outputs":{"cover":"r.cover"}})");
  const std::string recursive =
      errors(with_loop(R"("l":{"graph":"self.json","inputs":{"cover":"m.cover"}})"));
  EXPECT_TRUE(recursive.starts_with("self.json:2:13: the graph includes itself: ")) << recursive;
}

}  // namespace
}  // namespace ballflow
