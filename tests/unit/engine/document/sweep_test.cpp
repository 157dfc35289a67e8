// Sweeps: which variants there are, what they share, and what is said about wrong ones.
#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <set>

#include "ballflow/graph.hpp"
#include "document_fixture.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

/// load -> grow -> match; `sections` come first, in line 1.
std::string graph_with(const std::string& sections) {
  return "{" + sections + R"(
  "params": { "input": { "kind": "file", "default": "a.off" },
              "epsilon": { "kind": "number", "default": 0.5, "minimum": 0 },
              "label": { "kind": "string", "default": "plain" } },
  "nodes": {
    "load":  { "type": "Load", "params": { "file": "${input}" } },
    "grow":  { "type": "Grow", "inputs": { "points": "load.points" }, "params": { "epsilon": "${epsilon}" } },
    "name":  { "type": "Grow", "inputs": { "points": "load.points" }, "params": { "label": "${label}" } },
    "match": { "type": "Match", "inputs": { "balls": "grow.balls", "points": "load.points" } }
  },
  "outputs": { "cover": "match.cover", "named": "name.balls" } })";
}

Dag parse_with(const std::string& sections, const SweepOptions& options = {},
               const std::vector<Setting>& settings = {}) {
  return parse_graph(graph_with(sections), "g.json", registry(), settings, options);
}

std::vector<std::string> names(const Dag& dag) {
  std::vector<std::string> result;
  for (const Variant& variant : dag.variants) result.push_back(variant.name);
  return result;
}

/// Errors with their places and hints, one after the other; warnings, too, when nothing is wrong.
std::string complaints(const std::string& text, const SweepOptions& options = {},
                       const std::vector<Setting>& settings = {}) {
  std::vector<Diagnostic> findings;
  try {
    findings = parse_graph(text, "g.json", registry(), settings, options).warnings;
  } catch (const GraphError& error) {
    findings = error.findings();
  }
  std::string shown;
  for (const Diagnostic& d : findings) {
    shown += d.file + (d.line == 0 ? "" : ":" + std::to_string(d.line) + ":" + std::to_string(d.column)) +
             ": " + d.message + (d.hint.empty() ? "" : " | " + d.hint) + "\n";
  }
  return shown;
}

std::string complaints_of(const std::string& sections, const SweepOptions& options = {},
                          const std::vector<Setting>& settings = {}) {
  return complaints(graph_with(sections), options, settings);
}

TEST(sweep, product_takes_every_combination_the_last_axis_fastest) {
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [0.1, 2], "label": ["a", "b", "c"]}},)");
  EXPECT_EQ(names(dag),
            (std::vector<std::string>{"epsilon=0.1,label=a", "epsilon=0.1,label=b", "epsilon=0.1,label=c",
                                      "epsilon=2,label=a", "epsilon=2,label=b", "epsilon=2,label=c"}));
  EXPECT_EQ(dag.variants[3].values[0], (std::pair<std::string, Json>("epsilon", 2.0)));
  EXPECT_EQ(dag.variants[3].values[1], (std::pair<std::string, Json>("label", "a")));
  EXPECT_TRUE(dag.params.contains("input"));
  EXPECT_FALSE(dag.params.contains("epsilon")) << "no variant's value is the value of all";
}

TEST(sweep, zip_takes_values_side_by_side) {
  const Dag dag =
      parse_with(R"("sweep": {"axes": {"epsilon": [0.1, 2], "label": ["a", "b"]}, "mode": "zip"},)");
  EXPECT_EQ(names(dag), (std::vector<std::string>{"epsilon=0.1,label=a", "epsilon=2,label=b"}));
}

TEST(sweep, excluded_combinations_are_left_out) {
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [0.1, 2], "label": ["a", "b"]},
    "exclude": [{"epsilon": 2, "label": "a"}, {"label": "b", "epsilon": 0.1}]},)");
  EXPECT_EQ(names(dag), (std::vector<std::string>{"epsilon=0.1,label=a", "epsilon=2,label=b"}));
}

TEST(sweep, what_variants_have_in_common_is_one_node_named_by_what_it_depends_on) {
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [0.1, 2], "label": ["a", "b"]}},)");
  const std::vector<std::string> all = paths(dag);
  const std::set<std::string> expected = {
      "load",           "[epsilon=0.1]/grow", "[epsilon=2]/grow", "[epsilon=0.1]/match", "[epsilon=2]/match",
      "[label=a]/name", "[label=b]/name"};
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()), expected);
  EXPECT_EQ(all.size(), expected.size());
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    for (const auto& [port, edge] : dag.nodes[i].inputs) EXPECT_LT(edge.node, i) << "producers come first";
  }
  for (const Variant& variant : dag.variants) EXPECT_EQ(variant.nodes.size(), 4u);
}

TEST(sweep, every_variant_is_the_graph_with_its_values_set) {
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [0.1, 2], "grow.steps": [1, 2, 10]}},)");
  ASSERT_EQ(dag.variants.size(), 6u);
  for (const Variant& variant : dag.variants) {
    const Dag alone = parse_with(
        "", {},
        {{"epsilon", variant.values[0].second.dump()}, {"grow.steps", variant.values[1].second.dump()}});
    ASSERT_EQ(alone.nodes.size(), variant.nodes.size());
    for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
      const DagNode& node = dag.nodes[variant.nodes[i]];
      EXPECT_EQ(node.kind.declared(), alone.nodes[i].kind.declared());
      EXPECT_EQ(node.params, alone.nodes[i].params);
      ASSERT_EQ(node.inputs.size(), alone.nodes[i].inputs.size());
      for (const auto& [port, edge] : node.inputs) {
        EXPECT_EQ(edge.node, variant.nodes[alone.nodes[i].inputs.at(port).node]);
        EXPECT_EQ(edge.port, alone.nodes[i].inputs.at(port).port);
      }
    }
  }
  EXPECT_EQ(dag.outputs.size(), 12u);
  EXPECT_EQ(dag.outputs[0].name, "epsilon=0.1,grow.steps=1/cover");
  EXPECT_EQ(dag.outputs[0].base_name(), "cover");
}

TEST(sweep, variants_that_have_no_value_in_common_still_have_names_of_their_own) {
  // a + b is "xxx" for two of the variants, which share neither a nor b.
  const Dag dag = parse_graph(R"({"sweep": {"axes": {"a": ["x", "xx"], "b": ["x", "xx"]}},
    "params": {"a": {"kind": "string"}, "b": {"kind": "string"}},
    "nodes": {"l": {"type": "Load", "params": {"file": "${a}${b}"}}}, "outputs": {"p": "l.points"}})",
                              "g.json", registry());
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"[a=x,b=x]/l", "l", "[a=xx,b=xx]/l"}));
}

TEST(sweep, subgraphs_and_loops_are_shared_like_nodes) {
  test::TempFolder folder;
  test::write_file(folder.file("body.json"), R"({"params": {"keep": {"kind": "number", "default": 0.5}},
    "inputs": {"cover": {"type": "Cover"}},
    "nodes": {"trim": {"type": "Trim", "inputs": {"cover": "inputs.cover"}, "params": {"keep": "${keep}"}}},
    "outputs": {"cover": "trim.cover"}})");
  test::write_file(folder.file("g.json"), R"({"sweep": {"axes": {"keep": [0.1, 0.2], "other": [1, 2]}},
    "params": {"keep": {"kind": "number"}, "other": {"kind": "integer"}},
    "nodes": {"load": {"type": "Load", "params": {"file": "x"}},
      "grow": {"type": "Grow", "inputs": {"points": "load.points"}},
      "match": {"type": "Match", "inputs": {"balls": "grow.balls", "points": "load.points"}},
      "rounds": {"loop": "body.json", "inputs": {"cover": "match.cover"}, "until": "cover.remaining == 0",
                 "params": {"keep": "${keep}"}},
      "sub": {"graph": "body.json", "inputs": {"cover": "rounds.cover"}},
      "last": {"type": "Grow", "inputs": {"points": "load.points"}, "params": {"steps": "${other}"}}},
    "outputs": {"cover": "sub.cover", "balls": "last.balls"}})");
  const Dag dag = load_graph(folder.file("g.json"), registry());
  const std::vector<std::string> all = paths(dag);
  EXPECT_EQ(std::count(all.begin(), all.end(), "[keep=0.1]/rounds"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "[keep=0.2]/sub/trim"), 1);
  EXPECT_EQ(all.size(), 3u + 2u + 2u + 2u) << "loops with different bodies are different";
  EXPECT_EQ(dag.files, (std::vector<std::string>{folder.file("g.json"), folder.file("body.json")}))
      << "each file that was read, once, however often it is included";
  ASSERT_EQ(dag.variants[3].interfaces.size(), 1u);
  EXPECT_EQ(dag.variants[3].interfaces[0].name, "sub.cover");
  EXPECT_EQ(dag.nodes[dag.variants[3].interfaces[0].from.node].path, "[keep=0.2]/sub/trim");
  EXPECT_NE(complaints(R"({"nodes": {"s": {"graph": ")" + folder.file("g.json") +
                       R"("}}, "outputs": {"c": "s.cover"}})")
                .find("the sweep of a subgraph is not run"),
            std::string::npos);
}

TEST(sweep, names_are_fit_for_folders_whatever_the_values) {
  const std::string longest(500, 'x');
  const Dag dag = parse_with(R"("sweep": {"axes": {"label":
    ["a/b", "a b", "../..", "", "[x]=,", "caf\u00e9", ".", "\u001b[2J", ")" +
                             longest + R"(", ")" + longest + R"(y"]}},)");
  std::set<std::string> seen;
  for (const Variant& variant : dag.variants) {
    EXPECT_TRUE(seen.insert(variant.name).second) << variant.name;
    EXPECT_LE(variant.name.size(), 200u);
    EXPECT_EQ(variant.name.find_first_of("/[], \t\n\x1b"), std::string::npos) << variant.name;
    EXPECT_TRUE(variant.name.starts_with("label=")) << variant.name;
  }
  EXPECT_EQ(dag.variants[0].name, "label=a_b");
  EXPECT_EQ(dag.variants[1].name, "label=a_b~2");
  EXPECT_EQ(dag.variants[5].name, "label=caf\xc3\xa9");
  EXPECT_EQ(dag.variants[1].values[0].second, "a b") << "the value itself stays as it is";
  std::set<std::string> unique;
  for (const std::string& path : paths(dag)) EXPECT_TRUE(unique.insert(path).second) << path;
}

TEST(sweep, many_axes_have_short_names_too) {
  std::string axes, params;
  for (int i = 0; i < 40; ++i) {
    axes += (i == 0 ? "" : ",") + std::string("\"parameter_") + std::to_string(i) + "\": [" +
            std::to_string(i) + "]";
    params += ",\"parameter_" + std::to_string(i) + R"(": {"kind": "integer"})";
  }
  const Dag dag = parse_graph(R"({"sweep": {"axes": {"x": ["a", "b"],)" + axes +
                                  R"(}}, "params": {"x": {"kind": "string"})" + params +
                                  R"(}, "nodes": {"l": {"type": "Load", "params": {"file": "${x}"}}},
                                  "outputs": {"p": "l.points"}})",
                              "g.json", registry());
  ASSERT_EQ(dag.variants.size(), 2u);
  EXPECT_LE(dag.variants[0].name.size(), 200u);
  EXPECT_NE(dag.variants[0].name, dag.variants[1].name);
}

struct SweepFiles : testing::Test {
  SweepFiles() : before(fs::current_path()) {
    fs::create_directories(folder.file("scans/more.ply"));  // a folder that matches
    for (const char* name : {"b.ply", "a.ply", "c.off"})
      test::write_file(folder.file(std::string("scans/") + name), "");
    fs::current_path(folder.path());
  }
  ~SweepFiles() override { fs::current_path(before); }
  test::TempFolder folder;
  fs::path before;
};

TEST_F(SweepFiles, map_runs_the_graph_for_every_file_sorted) {
  const Dag dag = parse_with(R"("map": {"input": ["scans/*.ply", "scans/?.off", "scans/a.ply"]},)");
  EXPECT_EQ(names(dag), (std::vector<std::string>{"input=a.ply", "input=b.ply", "input=c.off"}));
  EXPECT_EQ(dag.variants[1].values[0].second, "scans/b.ply");
  EXPECT_EQ(dag.nodes[dag.variants[2].nodes[0]].params.at("file"), "scans/c.off");
}

TEST_F(SweepFiles, inputs_replace_the_map_and_multiply_the_axes) {
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [1, 2], "label": ["a", "b"]}, "mode": "zip"},
                            "map": {"input": "scans/*.off"},)",
                             {{}, {"scans/*.ply"}});
  EXPECT_EQ(names(dag),
            (std::vector<std::string>{"input=a.ply,epsilon=1,label=a", "input=a.ply,epsilon=2,label=b",
                                      "input=b.ply,epsilon=1,label=a", "input=b.ply,epsilon=2,label=b"}));
}

TEST_F(SweepFiles, inputs_need_no_map) {
  EXPECT_EQ(names(parse_with("", {{}, {"scans/[ab].ply"}})),
            (std::vector<std::string>{"input=a.ply", "input=b.ply"}));
  EXPECT_EQ(names(parse_with("", {{}, {"input=shape:torus?n=3", "scans/c.off"}})),
            (std::vector<std::string>{"input=c.off", "input=shape:torus_n_3"}))
      << "a name without * or [ need not be a file";
}

TEST_F(SweepFiles, a_name_that_is_there_is_no_pattern) {
  for (const char* name : {"scan [1].ply", "scan 1.ply", "what?.ply"})
    test::write_file(folder.file(std::string("scans/") + name), "");
  const Dag dag = parse_with("", {{}, {"scans/scan [1].ply", "scans/what?.ply"}});
  ASSERT_EQ(dag.variants.size(), 2u);
  EXPECT_EQ(dag.variants[0].values[0].second, "scans/scan [1].ply");
  EXPECT_EQ(dag.variants[1].values[0].second, "scans/what?.ply");
  EXPECT_EQ(parse_with("", {{}, {"scans/scan [12].ply"}}).variants[0].values[0].second, "scans/scan 1.ply")
      << "none is called so: a pattern";
}

TEST_F(SweepFiles, files_of_one_name_are_told_apart_by_their_folders) {
  fs::create_directories("other");
  test::write_file(folder.file("other/a.ply"), "");
  EXPECT_EQ(names(parse_with("", {{}, {"*/a.ply"}})),
            (std::vector<std::string>{"input=other_a.ply", "input=scans_a.ply"}));
}

TEST_F(SweepFiles, wrong_inputs_are_explained) {
  EXPECT_NE(
      complaints_of("", {{}, {"scans/*.obj"}}).find("--inputs scans/*.obj: no file matches \"scans/*.obj\""),
      std::string::npos);
  EXPECT_NE(complaints_of(R"("map": {"input": "none/*"},)").find("g.json:1:19: no file matches \"none/*\""),
            std::string::npos);
  EXPECT_NE(complaints_of(R"("map": {"imput": "x"},)")
                .find("g.json:1:10: \"map\" needs a parameter of kind file; "
                      "\"imput\" is none of the graph's | did you mean \"input\"?"),
            std::string::npos)
      << complaints_of(R"("map": {"imput": "x"},)");
  EXPECT_NE(complaints_of("", {{}, {"label=scans/*"}}).find("\"label\" is no parameter of kind file"),
            std::string::npos);
  EXPECT_NE(complaints_of(R"("map": {"input": 7},)").find("a file pattern must be a text, is 7"),
            std::string::npos);
  EXPECT_NE(complaints_of("", {{{"input", "a,b"}}, {"scans/*.ply"}}).find("\"input\" is swept twice"),
            std::string::npos);
  const std::string two = R"({"params": {"a": {"kind": "file"}, "b": {"kind": "file"}}, "nodes": {}})";
  EXPECT_NE(
      complaints(two, {{}, {"scans/*.ply"}})
          .find("which parameter shall have these files is not clear | file parameters are \"a\", \"b\""),
      std::string::npos);
}

TEST(sweep, axes_of_the_command_line_replace_and_add) {
  const std::string sections = R"("sweep": {"axes": {"epsilon": [0.1, 2], "label": ["a", "b"]},
                                    "exclude": [{"epsilon": 2, "label": "a"}]},)";
  EXPECT_EQ(names(parse_with(sections, {{{"epsilon", "5"}}, {}})),
            (std::vector<std::string>{"epsilon=5,label=a", "epsilon=5,label=b"}));
  EXPECT_EQ(names(parse_with("", {{{"grow/steps", "2,3"}}, {}})),
            (std::vector<std::string>{"grow.steps=2", "grow.steps=3"}));
  const Dag list = parse_with("", {{{"label", R"(["a,b", "c"])"}}, {}});
  EXPECT_EQ(list.variants[0].values[0].second, "a,b");
  EXPECT_EQ(names(list), (std::vector<std::string>{"label=a_b", "label=c"}));
}

TEST(sweep, errors_name_the_place_and_the_nearest) {
  const std::pair<std::string, std::string> cases[] = {
      {R"("sweep": 3,)", "g.json:1:11: \"sweep\" must be an object, is 3"},
      {R"("sweep": {},)", "g.json:1:2: a sweep has \"axes\""},
      {R"("sweep": {"axis": {}, "axes": {}},)", "g.json:1:12: unknown key \"axis\" | did you mean \"axes\"?"},
      {R"("sweep": {"axes": {"epsilon": []}},)", "g.json:1:32: \"epsilon\" has no values"},
      {R"("sweep": {"axes": {"epsilon": 3}},)",
       "g.json:1:32: axis \"epsilon\" must be a list of values, is 3"},
      {R"("sweep": {"axes": {"epsilon": [[1]]}},)",
       "g.json:1:33: a value of axis \"epsilon\" must be a number"},
      {R"("sweep": {"axes": {"epsilom": [1, 2]}},)",
       "g.json:1:21: the graph has no parameter \"epsilom\" | did you mean \"epsilon\"?"},
      {R"("sweep": {"axes": {"gro.epsilon": [1, 2]}},)",
       "g.json:1:21: the graph has no parameter \"gro.epsilon\" | did you mean \"grow.epsilon\"?"},
      {R"("sweep": {"axes": {"epsilon": [1, -1]}},)", "g.json:1:36: \"epsilon\" must be at least 0, is -1"},
      {R"("sweep": {"axes": {"epsilon": [1, "x"]}},)", "g.json:1:36: \"epsilon\" must be a number"},
      {R"("sweep": {"axes": {"epsilon": [1, 1.0]}},)", "g.json:1:36: axis \"epsilon\" has \"1\" twice"},
      {R"("sweep": {"axes": {"epsilon": [1]}, "mode": "zipp"},)",
       "g.json:1:46: \"mode\" must be \"product\" or \"zip\", is the text \"zipp\" | did you mean \"zip\"?"},
      {R"("sweep": {"axes": {"epsilon": [1, 2], "label": ["a"]}, "mode": "zip"},)",
       "g.json:1:40: axes of a zip have the same number of values; \"epsilon\" has 2, \"label\" has 1"},
      {R"("sweep": {"axes": {"epsilon": [1]}, "exclude": [{"epsilom": 1}]},)",
       "g.json:1:51: the sweep has no axis \"epsilom\" | did you mean \"epsilon\"?"},
      {R"("sweep": {"axes": {"label": ["greedy"]}, "exclude": [{"label": "gredy"}]},)",
       "g.json:1:65: axis \"label\" has no value \"gredy\" | did you mean \"greedy\"?"},
      {R"("sweep": {"axes": {"epsilon": [1]}, "exclude": [{"epsilon": 1}]},)",
       "g.json:1:2: every combination of the sweep is excluded"},
      {R"("sweep": {"axes": {"epsilon": [1]}, "exclude": [{}]},)",
       "g.json:1:50: an excluded combination names at least one parameter"},
      {R"("sweep": {"axes": {"epsilon": [1]}, "exclude": {"epsilon": 1}},)",
       "g.json:1:49: \"exclude\" must be a list of combinations"},
      {R"("sweep": {"axes": {"epsilon": [1], "input": ["b"]}}, "map": {"input": "a"},)",
       "g.json:1:37: \"input\" is swept twice"},
  };
  for (const auto& [sections, expected] : cases) {
    const std::string shown = complaints_of(sections);
    EXPECT_NE(shown.find(expected), std::string::npos) << sections << "\n" << shown;
  }
}

TEST(sweep, errors_of_the_command_line_say_what_was_typed) {
  EXPECT_NE(complaints_of("", {{{"epsilon", "1,x"}}, {}})
                .find("--axis epsilon=1,x: \"epsilon\" must be a finite number, is \"x\""),
            std::string::npos);
  EXPECT_NE(complaints_of("", {{{"epsilon", "1,"}}, {}}).find("\"epsilon\" must be a finite number, is \"\""),
            std::string::npos);
  EXPECT_NE(complaints_of("", {{{"epsilon", "[1,"}}, {}}).find("this is no JSON list"), std::string::npos);
  EXPECT_NE(complaints_of("", {{{"epsilon", "1"}, {"epsilon", "2"}}, {}}).find("this axis is given twice"),
            std::string::npos);
  EXPECT_NE(complaints_of("", {{{"epsilon", "1,2"}}, {}}, {{"epsilon", "3"}})
                .find("--set epsilon=3: \"epsilon\" is an axis of the sweep | to run one value of it only: "
                      "--axis epsilon=3"),
            std::string::npos);
}

TEST(sweep, an_error_of_some_variants_says_in_which) {
  const std::string text = R"({"sweep": {"axes": {"kind": ["Grow", "Grwo"], "n": [1, 2]}},
    "params": {"kind": {"kind": "string"}, "n": {"kind": "integer"}},
    "nodes": {"l": {"type": "Load", "params": {"file": "x"}},
              "s": {"graph": "${kind}.json", "inputs": {"points": "l.points"}},
              "g": {"type": "Grow", "inputs": {"points": "l.points"}, "params": {"steps": "${n}"}}},
    "outputs": {"b": "g.balls"}})";
  const std::string shown = complaints(text);
  EXPECT_NE(shown.find("no subgraph file \"Grow.json\""), std::string::npos) << shown;
  EXPECT_NE(shown.find("; in the variant kind=Grwo,n=1"), std::string::npos) << shown;
  // What is wrong in all of them is said once, without one of them.
  const std::string all = complaints_of(R"("sweep": {"axes": {"epsilon": [1, 2]}}, "nodes": 3,)");
  EXPECT_EQ(all.find("in the variant"), std::string::npos) << all;
}

TEST(sweep, too_many_variants_are_counted_not_made) {
  std::string values = "0";
  for (int i = 1; i < 1000; ++i) values += "," + std::to_string(i);
  const std::string sections =
      R"("sweep": {"axes": {"epsilon": [)" + values + R"(], "label": [)" + values + "]}},";
  const std::clock_t start = std::clock();
  EXPECT_NE(complaints_of(sections).find("the sweep has 1000000 variants, more than 100000"),
            std::string::npos);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 1.0);
}

TEST(sweep, a_thousand_variants_are_merged_quickly) {
  std::string values = "0";
  for (int i = 1; i < 1000; ++i) values += "," + std::to_string(i) + "e-3";
  const std::clock_t start = std::clock();
  const Dag dag = parse_with(R"("sweep": {"axes": {"epsilon": [)" + values + "]}},");
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_EQ(dag.nodes.size(), 2u + 2u * 1000u);
  std::printf("1000 variants of a graph of four nodes: %.1f ms of CPU time\n", seconds * 1e3);
  EXPECT_LT(seconds, 2.0);
}

}  // namespace
}  // namespace ballflow
