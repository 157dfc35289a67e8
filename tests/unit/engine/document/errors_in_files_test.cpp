// Graphs in several files that are wrong.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "document_fixture.hpp"
#include "shown_errors.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

std::string load_errors(const std::string& file, const std::vector<Setting>& settings = {}) {
  try {
    load_graph(file, registry(), settings);
  } catch (const GraphError& error) {
    return shown(error.findings());
  }
  return {};
}

class graph_error_in_files : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { test::write_file(folder_.file(name), text); }
  /// Errors of loading a file, with the folder's name removed.
  std::string of(const std::string& name, const std::vector<Setting>& settings = {}) {
    std::string text = load_errors(folder_.file(name), settings);
    for (std::size_t at; (at = text.find(folder_.path() + "/")) != std::string::npos;)
      text.erase(at, folder_.path().size() + 1);
    return text;
  }
  test::TempFolder folder_;
};

TEST_F(graph_error_in_files, missing_subgraph_names_what_there_is) {
  write("strategies/greedy.json", "{}");
  write("strategies/lagrange.json", "{}");
  write("top.json", "{\"nodes\":{\n\"s\":{\"graph\":\"strategies/greddy.json\"}}}");
  EXPECT_EQ(of("top.json"),
            "top.json:2:14: no subgraph file \"strategies/greddy.json\" (at /nodes/s/graph)\n"
            "  did you mean \"greedy.json\"? folder \"strategies\" has \"greedy.json\", \"lagrange.json\"\n");
  write("top.json", "{\"nodes\":{\n\"s\":{\"graph\":\"nowhere/greddy.json\"}}}");
  EXPECT_EQ(of("top.json"),
            "top.json:2:14: no subgraph file \"nowhere/greddy.json\" (at /nodes/s/graph)\n"
            "  there is no folder \"nowhere\"\n");
}

TEST_F(graph_error_in_files, recursion_shows_the_chain) {
  write("a.json", R"({"nodes":{"b":{"graph":"b.json"}}})");
  write("b.json", R"({"nodes":{"c":{"graph":"./sub/../a.json"}}})");
  EXPECT_EQ(of("a.json"),
            "b.json:1:24: the graph includes itself: a.json -> b.json -> a.json (at /nodes/c/graph)\n"
            "  subgraphs cannot be recursive\n");
}

TEST_F(graph_error_in_files, too_deep_or_too_many_subgraphs) {
  for (int i = 0; i < 60; ++i)
    write(std::to_string(i) + ".json",
          "{\"nodes\":{\"n\":{\"graph\":\"" + std::to_string(i + 1) + ".json\"}}}");
  EXPECT_EQ(of("0.json"), "49.json:1:24: subgraphs are nested deeper than 50 levels (at /nodes/n/graph)\n");
  for (int i = 0; i < 40; ++i) {
    write("w" + std::to_string(i) + ".json", "{\"nodes\":{\"a\":{\"graph\":\"w" + std::to_string(i + 1) +
                                                 ".json\"},\"b\":{\"graph\":\"w" + std::to_string(i + 1) +
                                                 ".json\"}}}");
  }
  write("w40.json", "{\"nodes\":{}}");
  EXPECT_NE(of("w0.json").find("the graph expands to more than 1000000 nodes"), std::string::npos);
}

TEST_F(graph_error_in_files, broken_subgraph_is_reported_once_in_its_own_file) {
  write("s.json", "{\"nodes\":{\"x\":{\"type\":\"Lod\"}},\"outputs\":{\"p\":\"x.points\"}}");
  write("t.json", "{\"nodes\":");
  write(
      "top.json",
      R"({"nodes":{"a":{"graph":"s.json"},"b":{"graph":"s.json"},"t":{"graph":"t.json"},"u":{"graph":"t.json"},
     "g":{"type":"Grow","inputs":{"points":"a.p"}},"h":{"type":"Grow","inputs":{"points":"t.p"}}},"outputs":{"o":"g.balls","p":"t.x"}})");
  EXPECT_EQ(
      of("top.json", {{"a.x.scale", "2"}}),
      "s.json:1:23: unknown node type \"Lod\" (at /nodes/x/type)\n  did you mean \"Load\"?\n"
      "t.json:1:10: not JSON: unexpected end of input; expected '[', '{', or a literal (in value) (at )\n"
      "  the text ends too early: a bracket or quote is not closed\n");
}

TEST_F(graph_error_in_files, interfaces_of_subgraphs_are_checked) {
  write("s.json", R"({"params":{"k":{"kind":"number"}},"inputs":{"cover":{"type":"Cover"}},
"nodes":{"t":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":"${k}"}}},"outputs":{"cover":"t.cover"}})");
  write("top.json", R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},
"a":{"graph":"s.json","inputs":{"cover":"l.points"},"params":{"k":1}},
"b":{"graph":"s.json","params":{"kk":1,"k":1}},
"c":{"graph":"s.json","inputs":{"cover":"a.cover","points":"l.points"}},
"g":{"type":"Grow","inputs":{"points":"a.covr"}},
"h":{"type":"Grow","inputs":{"points":"a.cover"}}},"outputs":{"o":"g.balls"}})");
  EXPECT_EQ(of("top.json"),
            "top.json:2:41: \"l.points\" is a Points, but input \"cover\" of subgraph \"a\" (s.json) takes a "
            "Cover (at /nodes/a/inputs/cover)\n"
            "  \"cover\": \"b.cover\" would be a Cover\n"
            "top.json:3:1: subgraph \"b\" (s.json) misses its input \"cover\" (Cover) (at /nodes/b)\n"
            "  \"cover\": \"a.cover\" would be a Cover\n"
            "top.json:3:33: subgraph \"s.json\" has no parameter \"kk\" (at /nodes/b/params/kk)\n  did you "
            "mean \"k\"?\n"
            "top.json:4:1: subgraph \"c\" (s.json) needs a value for its parameter \"k\" (at /nodes/c)\n"
            "top.json:4:51: subgraph \"c\" (s.json) has no input \"points\" (at /nodes/c/inputs/points)\n  "
            "inputs are \"cover\"\n"
            "top.json:5:39: subgraph \"a\" (s.json) has no output \"covr\" (at /nodes/g/inputs/points)\n  "
            "did you mean \"cover\"?\n"
            "top.json:6:39: \"a.cover\" is a Cover, but input \"points\" of node \"h\" (Grow) takes a Points "
            "(at /nodes/h/inputs/points)\n"
            "  \"points\": \"l.points\" would be a Points\n");
}

TEST_F(graph_error_in_files, circle_of_subgraphs_that_only_pass_values_around) {
  write("pass.json", R"({"inputs":{"p":{"type":"Points"}},"nodes":{},"outputs":{"p":"inputs.p"}})");
  write(
      "top.json",
      R"({"nodes":{"a":{"graph":"pass.json","inputs":{"p":"b.p"}},"b":{"graph":"pass.json","inputs":{"p":"a.p"}}},"outputs":{"o":"a.p"}})");
  EXPECT_EQ(of("top.json"),
            "pass.json:1:61: cycle without a node in it: a.p -> b.p -> a.p (at /outputs/p)\n  let the value "
            "come from a node\n");
}

TEST_F(graph_error_in_files, unreadable_files) {
  try {
    load_graph(folder_.file("none.json"), registry());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(error.what(), "cannot read \"" + folder_.file("none.json") + "\": there is no such file");
  }
  EXPECT_THROW(load_graph(folder_.path(), registry()), Error);
  write("top.json", "{\"nodes\":{\n\"s\":{\"graph\":\"/dev/zero\"}}}");
  EXPECT_EQ(of("top.json").substr(0, 45), "top.json:2:14: no subgraph file \"/dev/zero\" (");
}

}  // namespace
}  // namespace ballflow
