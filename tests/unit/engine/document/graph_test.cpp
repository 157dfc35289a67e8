// Graphs that are right: what they become.
#include "ballflow/graph.hpp"

#include <gtest/gtest.h>

#include <ctime>

#include "document_fixture.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

Dag parse(const std::string& text, const std::vector<Setting>& settings = {},
          const std::string& file = "g.json") {
  static const Registry registry = test::toy_registry();
  return parse_graph(text, file, registry, settings);
}

Dag load(const std::string& file, const std::vector<Setting>& settings = {}) {
  static const Registry registry = test::toy_registry();
  return load_graph(file, registry, settings);
}

const char* const chain = R"({
  // a comment
  "doc": "Three nodes.",
  "params": { "input": { "kind": "file", "doc": "model" },
              "epsilon": { "kind": "number", "default": 0.3, "minimum": 0, "unit": "%", "doc": "growth" } },
  "nodes": {
    "match": { "type": "Match", "inputs": { "balls": "grow.balls", "points": "load.points" } },
    "grow":  { "type": "Grow", "inputs": { "points": "load.points" }, "params": { "epsilon": "${epsilon}" } },
    "load":  { "type": "Load", "params": { "file": "${input}" } } /* another */
  },
  "outputs": { "cover": { "from": "match.cover", "doc": "the cover" }, "balls": "grow.balls" }
})";

TEST(graph, becomes_a_dag_in_topological_order_with_defaults_filled_in) {
  const Dag dag = parse(chain, {{"input", "a.off"}});
  EXPECT_EQ(dag.file, "g.json");
  EXPECT_EQ(dag.doc, "Three nodes.");
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"load", "grow", "match"}));
  EXPECT_EQ(dag.nodes[0].params.at("file"), "a.off");
  EXPECT_EQ(dag.nodes[0].params.at("scale"), 1.0);
  EXPECT_EQ(dag.nodes[0].params.at("mode"), "fast");
  EXPECT_EQ(dag.nodes[1].params.at("epsilon"), 0.3);
  EXPECT_EQ(dag.nodes[1].params.at("steps"), 3);
  EXPECT_EQ(dag.nodes[1].inputs.at("points").node, 0U);
  EXPECT_FALSE(dag.nodes[1].inputs.contains("extra"));
  EXPECT_EQ(dag.nodes[2].inputs.at("balls").node, 1U);
  EXPECT_EQ(dag.nodes[2].inputs.at("balls").port, "balls");
  EXPECT_EQ(dag.nodes[1].place.line, 8);
  EXPECT_EQ(dag.nodes[1].place.column, 5);
  EXPECT_EQ(dag.nodes[1].place.pointer, "/nodes/grow");
  ASSERT_EQ(dag.outputs.size(), 2U);
  EXPECT_EQ(dag.outputs[0].name, "cover");
  EXPECT_EQ(dag.outputs[0].doc, "the cover");
  EXPECT_EQ(dag.outputs[0].from.node, 2U);
  EXPECT_EQ(dag.outputs[1].from.node, 1U);
  EXPECT_EQ(dag.params.at("epsilon"), 0.3);
  EXPECT_TRUE(dag.warnings.empty());
  ASSERT_NE(dag.find("grow"), nullptr);
  EXPECT_EQ(dag.find("grow")->kind.type(), "Grow");
  EXPECT_EQ(dag.find("nothing"), nullptr);
}

TEST(graph, a_parameter_is_set_by_its_former_name_too) {
  const test::TempFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    test::write_file(folder.file(name), text);
    return folder.file(name);
  };
  const std::string inner = write("inner.json", R"({
    "params": { "growth": { "kind": "number", "default": 1, "alias": "epsilon" } },
    "nodes": { "load": { "type": "Load", "params": { "file": "x", "scale": "${growth}" } } } })");
  const auto scale = [](const Dag& dag) { return dag.nodes.at(0).params.at("scale"); };
  EXPECT_EQ(scale(load(inner)), 1.0);
  EXPECT_EQ(scale(load(inner, {{"growth", "2"}})), 2.0);
  EXPECT_EQ(scale(load(inner, {{"epsilon", "3"}})), 3.0);
  EXPECT_EQ(load(inner, {{"epsilon", "3"}}).params.at("growth"), 3.0);
  const std::string outer = write("outer.json", R"({
    "nodes": { "part": { "graph": "inner.json", "params": { "epsilon": 4 } } } })");
  EXPECT_EQ(scale(load(outer)), 4.0);
  EXPECT_EQ(scale(load(outer, {{"part.epsilon", "5"}})), 5.0);
  EXPECT_EQ(scale(load(outer, {{"part.growth", "6"}})), 6.0);
  EXPECT_THROW(load(inner, {{"growth", "2"}, {"epsilon", "3"}}), GraphError);  // which one counts?
}

TEST(graph, ties_of_the_topological_order_are_broken_by_path) {
  const Dag dag = parse(R"({"nodes":{
    "c":{"type":"Load","params":{"file":"x"}},"a":{"type":"Load","params":{"file":"x"}},
    "b":{"type":"Load","params":{"file":"x"}},"a2":{"type":"Grow","inputs":{"points":"c.points","extra":"a.points"}}},
    "outputs":{"o":"a2.balls","p":"b.points"}})");
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"a", "b", "c", "a2"}));
}

TEST(graph, keeps_the_type_of_a_whole_value_and_prints_numbers_shortest_inside_text) {
  const Dag dag = parse(R"({
    "params": { "e": {"kind":"number","default":0.1}, "n": {"kind":"integer","default":7},
                "f": {"kind":"boolean","default":true}, "s": {"kind":"string","default":"x y"}, "one": {"kind":"number","default":1}},
    "nodes": { "load": {"type":"Load","params":{"file":"m-${s}-${n}.off"}},
      "grow": {"type":"Grow","inputs":{"points":"load.points"},"params":{"epsilon":"${e}","steps":"${n}","closed":"${f}",
               "label":"${e}|${n}|${f}|${s}|${one}|$${e}|$"}} },
    "outputs": {"o":"grow.balls"}})");
  const auto& params = dag.find("grow")->params;
  EXPECT_TRUE(params.at("epsilon").is_number_float());
  EXPECT_TRUE(params.at("steps").is_number_integer());
  EXPECT_EQ(params.at("closed"), true);
  EXPECT_EQ(params.at("label"), "0.1|7|true|x y|1|${e}|$");
  EXPECT_EQ(dag.find("load")->params.at("file"), "m-x y-7.off");
}

TEST(graph, writes_one_number_in_one_way) {
  const auto epsilon = [](const std::string& number) {
    const Dag dag = parse(R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
      "g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"epsilon":)" +
                          number + R"(,"steps":2.0}}},"outputs":{"o":"g.balls"}})");
    EXPECT_TRUE(dag.find("g")->params.at("steps").is_number_integer());
    return dag.find("g")->params.at("epsilon").dump();
  };
  EXPECT_EQ(epsilon("1"), epsilon("1.0"));
  EXPECT_EQ(epsilon("10e-1"), epsilon("1"));
  EXPECT_EQ(epsilon("-0.0"), epsilon("0"));
}

TEST(graph, byte_order_marks_are_skipped_and_other_encodings_named) {
  test::TempFolder folder;
  const std::string windows = "\xef\xbb\xbf" + std::string(chain);
  test::write_file(folder.file("mark.json"), windows);
  EXPECT_EQ(paths(load(folder.file("mark.json"), {{"input", "x"}})), paths(parse(chain, {{"input", "x"}})));
  for (const std::string& start :
       {std::string("\xff\xfe{\0", 4), std::string("\xfe\xff\0{", 4), std::string("{\0", 2)}) {
    test::write_file(folder.file("wide.json"), start + std::string(" \0}\0", 4));
    try {
      load(folder.file("wide.json"));
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("UTF-16"), std::string::npos);
      EXPECT_EQ(error.hint(), "save it as UTF-8");
    }
  }
}

TEST(graph, overrides_reach_graph_parameters_and_nodes_at_any_depth) {
  test::TempFolder folder;
  test::write_file(folder.file("s/deep.json"), R"({"params":{"k":{"kind":"number","default":0.5}},
    "inputs":{"cover":{"type":"Cover"}},
    "nodes":{"trim":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":"${k}"}}},"outputs":{"cover":"trim.cover"}})");
  test::write_file(folder.file("s/mid.json"), R"({"inputs":{"cover":{"type":"Cover"}},
    "nodes":{"deep":{"graph":"deep.json","inputs":{"cover":"inputs.cover"}}},"outputs":{"cover":"deep.cover"}})");
  test::write_file(folder.file("top.json"),
                   R"({"params":{"which":{"kind":"choice","choices":["mid","other"],"default":"other"}},
    "nodes":{"load":{"type":"Load","params":{"file":"x"}},"grow":{"type":"Grow","inputs":{"points":"load.points"}},
    "match":{"type":"Match","inputs":{"balls":"grow.balls","points":"load.points"}},
    "prune":{"graph":"s/${which}.json","inputs":{"cover":"match.cover"}}},"outputs":{"cover":"prune.cover"}})");
  const Dag dag =
      load(folder.file("top.json"),
           {{"which", "mid"}, {"prune/deep.k", "0.25"}, {"grow.steps", "9"}, {"load.file", "1e3"}});
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"load", "grow", "match", "prune/deep/trim"}));
  EXPECT_EQ(dag.find("prune/deep/trim")->params.at("keep"), 0.25);
  EXPECT_EQ(dag.find("prune/deep/trim")->place.file, folder.file("s/deep.json"));
  EXPECT_EQ(dag.find("prune/deep/trim")->inputs.at("cover").node, 2U);
  EXPECT_EQ(dag.find("grow")->params.at("steps"), 9);
  EXPECT_EQ(dag.find("load")->params.at("file"), "1e3");
  EXPECT_EQ(dag.params.at("which"), "mid");
  EXPECT_EQ(dag.outputs.at(0).from.node, 3U);
  const Dag dots = load(folder.file("top.json"),
                        {{"which", "mid"}, {"prune.deep.trim.keep", "1"}, {"prune/deep/trim/keep", "0.75"}});
  EXPECT_EQ(dots.find("prune/deep/trim")->params.at("keep"), 0.75) << "the last of two settings wins";
}

TEST(graph, one_subgraph_serves_twice_with_different_parameters) {
  test::TempFolder folder;
  test::write_file(folder.file("grow.json"),
                   R"({"params":{"e":{"kind":"number"}},"inputs":{"p":{"type":"Points"}},
    "nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p"},"params":{"epsilon":"${e}"}}},"outputs":{"b":"g.balls","same":"inputs.p"}})");
  test::write_file(folder.file("top.json"), R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
    "one":{"graph":"grow.json","inputs":{"p":"l.points"},"params":{"e":1}},
    "two":{"graph":"grow.json","inputs":{"p":"one.same"},"params":{"e":2}}},"outputs":{"a":"one.b","b":"two.b","p":"two.same"}})");
  const Dag dag = load(folder.file("top.json"));
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"l", "one/g", "two/g"}));
  EXPECT_EQ(dag.nodes[1].params.at("epsilon"), 1.0);
  EXPECT_EQ(dag.nodes[2].params.at("epsilon"), 2.0);
  EXPECT_EQ(dag.nodes[2].inputs.at("points").node, 0U) << "through one.same to the loader";
  EXPECT_EQ(dag.outputs[2].from.node, 0U);
}

TEST(graph, optional_inputs_of_subgraphs_may_stay_open) {
  test::TempFolder folder;
  test::write_file(folder.file("s.json"),
                   R"({"inputs":{"p":{"type":"Points"},"q":{"type":"Points","optional":true}},
    "nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p","extra":"inputs.q"}}},"outputs":{"b":"g.balls"}})");
  test::write_file(folder.file("top.json"), R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
    "s":{"graph":"s.json","inputs":{"p":"l.points"}}},"outputs":{"b":"s.b"}})");
  EXPECT_FALSE(load(folder.file("top.json")).find("s/g")->inputs.contains("extra"));
}

TEST(graph, warns_about_what_is_not_used) {
  const Dag dag = parse(R"({"params":{"unused":{"kind":"number","default":1}},
 "nodes":{"l":{"type":"Load","params":{"file":"x"}},
  "g":{"type":"Grow","inputs":{"points":"l.points"}}},"outputs":{"p":"l.points"}})");
  ASSERT_EQ(dag.warnings.size(), 2U);
  EXPECT_EQ(dag.warnings[0].text(),
            "g.json:1:12: warning: parameter \"unused\" is not used (at /params/unused)\n"
            "    {\"params\":{\"unused\":{\"kind\":\"number\",\"default\":1}},\n"
            "               ^");
  EXPECT_EQ(dag.warnings[1].message, "nothing uses the outputs of node \"g\"");
  EXPECT_EQ(dag.warnings[1].severity, Diagnostic::Severity::warning);
}

TEST(graph, warns_about_an_unused_input_unless_it_is_the_first_state_of_a_loop) {
  const auto warnings = [](const std::string& output) {
    test::TempFolder folder;
    test::write_file(folder.file("body.json"),
                     R"({"inputs":{"p":{"type":"Points"},"b":{"type":"Balls"}},
      "nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p"}}},"outputs":{")" +
                         output + R"(":"g.balls"}})");
    test::write_file(folder.file("top.json"), R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
      "g":{"type":"Grow","inputs":{"points":"l.points"}},
      "s":{"graph":"body.json","inputs":{"p":"l.points","b":"g.balls"}}},"outputs":{"b":"s.)" +
                                                  output + R"("}})");
    std::vector<std::string> messages;
    for (const Diagnostic& warning : load(folder.file("top.json")).warnings)
      messages.push_back(warning.message);
    return messages;
  };
  EXPECT_EQ(warnings("other"), std::vector<std::string>{"input \"b\" is not used"});
  EXPECT_EQ(warnings("b"), std::vector<std::string>{});
}

TEST(graph, warns_about_no_input_of_a_graph_without_nodes) {
  test::TempFolder folder;
  test::write_file(
      folder.file("nothing.json"),
      R"({"inputs":{"p":{"type":"Points"},"b":{"type":"Balls"}},"nodes":{},"outputs":{"same":"inputs.b"}})");
  test::write_file(folder.file("top.json"), R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
    "g":{"type":"Grow","inputs":{"points":"l.points"}},
    "s":{"graph":"nothing.json","inputs":{"p":"l.points","b":"g.balls"}}},"outputs":{"b":"s.same"}})");
  EXPECT_TRUE(load(folder.file("top.json")).warnings.empty());
}

TEST(graph, accepts_a_byte_order_mark_and_windows_line_ends) {
  const Dag dag = parse(
      "\xef\xbb\xbf{\r\n\"nodes\":{\r\n\"l\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}}},\"outputs\":{"
      "\"p\":\"l.points\"}}");
  EXPECT_EQ(dag.nodes.at(0).place.line, 3);
  EXPECT_EQ(dag.nodes.at(0).place.column, 1);
}

TEST(graph, of_many_nodes_is_read_in_time) {
  std::string text = "{\"nodes\":{\"n0\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}}";
  constexpr int n = 50'000;
  for (int i = 1; i < n; ++i) {
    text += ",\"n" + std::to_string(i) +
            "\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"n0.points\"},\"params\":{\"steps\":2}}";
  }
  text += "},\"outputs\":{\"o\":\"n1.balls\"}}";
  const std::clock_t start = std::clock();
  EXPECT_EQ(parse(text).nodes.size(), static_cast<std::size_t>(n));
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 10.0);
}

}  // namespace
}  // namespace ballflow
