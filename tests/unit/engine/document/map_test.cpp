// Maps: a subgraph for every entry of a list, and its outputs as lists.
#include <gtest/gtest.h>

#include "ballflow/graph.hpp"
#include "document_fixture.hpp"
#include "shown_errors.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

/// The toy nodes, and one that takes a list: Gather, balls (list) [, more (list)] -> balls.
const Registry& with_lists() {
  static const Registry all = [] {
    Registry toy = test::toy_registry();
    toy.add(parse_node_declaration(R"({"id":"Gather","version":1,"summary":"Gather.","doc":"",
      "inputs":[{"name":"balls","type":"Balls","type_version":1,"doc":"several","list":true},
                {"name":"more","type":"Balls","type_version":1,"doc":"more","list":true,"optional":true}],
      "outputs":[{"name":"balls","type":"Balls","type_version":1,"doc":"all"}],"params":[]})"));
    return toy;
  }();
  return all;
}

class Map : public ::testing::Test {
 protected:
  void SetUp() override {
    test::write_file(folder_.file("body.json"), R"({"doc":"A link.",
      "params":{"name":{"kind":"string"},"steps":{"kind":"integer","default":3,"maximum":10},
                "epsilon":{"kind":"number","default":0.5}},
      "inputs":{"points":{"type":"Points"}},
      "nodes":{"grow":{"type":"Grow","inputs":{"points":"inputs.points"},
                       "params":{"label":"${name}","steps":"${steps}","epsilon":"${epsilon}"}}},
      "outputs":{"balls":"grow.balls"}})");
  }
  Dag parse(const std::string& text, const std::vector<Setting>& settings = {}) {
    return parse_graph(text, folder_.file("g.json"), with_lists(), settings);
  }
  std::string errors(const std::string& over, const std::string& rest, const std::string& outputs,
                     const std::vector<Setting>& settings = {}) {
    try {
      parse(graph(over, rest, outputs), settings);
    } catch (const GraphError& error) {
      std::string text = shown(error.findings());
      for (std::size_t at; (at = text.find(folder_.file(""))) != std::string::npos;)
        text.erase(at, folder_.file("").size());
      return text;
    }
    return {};
  }
  static std::string graph(const std::string& over, const std::string& rest, const std::string& outputs) {
    return R"({"params":{"names":{"kind":"list","default":["hand","arm"],"doc":"names"},
  "counts":{"kind":"list","default":[3]}},
"nodes":{"load":{"type":"Load","params":{"file":"x"}},
"links":{"map":"body.json","inputs":{"points":"load.points"},
)" + over + "}" +
           rest + "},\n\"outputs\":" + outputs + "}";
  }
  static std::string plain() { return R"("over":{"name":"${names}"})"; }
  static std::string gather() { return R"(,"all":{"type":"Gather","inputs":{"balls":"links.balls"}})"; }
  test::TempFolder folder_;
};

const char* const all_balls = R"({"balls":"all.balls"})";

TEST_F(Map, has_a_copy_of_its_body_for_every_entry) {
  const Dag dag = parse(graph(plain(), gather(), all_balls));
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"load", "links[arm]/grow", "links[hand]/grow", "all"}));
  EXPECT_EQ(dag.find("links[hand]/grow")->params.at("label"), "hand");
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("label"), "arm");
  EXPECT_EQ(dag.nodes[dag.find("links[arm]/grow")->inputs.at("points").node].path, "load");
  EXPECT_EQ(dag.params.at("names"), Json::array({"hand", "arm"}));
}

TEST_F(Map, gives_lists_in_the_order_of_the_entries) {
  for (const std::string names : {"a,b,c", "c,a,b", R"(["c","b","a"])"}) {
    const Dag dag = parse(graph(plain(), gather(), all_balls), {{"names", names}});
    const DagNode& all = *dag.find("all");
    ASSERT_EQ(all.inputs.size(), 3U);
    std::string order;
    for (int i = 0; i < 3; ++i)
      order += dag.nodes[all.inputs.at(list_slot("balls", i)).node].params.at("label").get<std::string>();
    std::string wanted;
    for (const char c : names)
      wanted += std::string("abc").find(c) == std::string::npos ? "" : std::string(1, c);
    EXPECT_EQ(order, wanted);
  }
}

TEST_F(Map, lists_stand_among_other_edges) {
  const Dag dag = parse(graph(plain(),
                              R"(,"one":{"type":"Grow","inputs":{"points":"load.points"}},
          "all":{"type":"Gather","inputs":{"balls":["one.balls","links.balls","one.balls"],"more":"links.balls"}})",
                              all_balls));
  const DagNode& all = *dag.find("all");
  std::vector<std::string> order;
  for (int i = 0; i < 4; ++i) order.push_back(dag.nodes[all.inputs.at(list_slot("balls", i)).node].path);
  EXPECT_EQ(order, (std::vector<std::string>{"one", "links[hand]/grow", "links[arm]/grow", "one"}));
  EXPECT_EQ(all.inputs.size(), 6U);
  EXPECT_EQ(dag.nodes[all.inputs.at("more[1]").node].path, "links[arm]/grow");
}

TEST_F(Map, goes_over_lists_together_and_one_entry_is_for_all) {
  const std::string over = R"("over":{"name":"${names}","steps":"${counts}","epsilon":[0.25, 0.75]})";
  Dag dag = parse(graph(over, gather(), all_balls), {{"counts", "7,9"}});
  EXPECT_EQ(dag.find("links[hand]/grow")->params.at("steps"), 7);
  EXPECT_TRUE(dag.find("links[hand]/grow")->params.at("steps").is_number_integer());
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("steps"), 9);
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("epsilon"), 0.75);
  dag = parse(graph(over, gather(), all_balls), {{"counts", "8"}});
  EXPECT_EQ(dag.find("links[hand]/grow")->params.at("steps"), 8);
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("steps"), 8);
}

TEST_F(Map, tells_copies_their_place) {
  const Dag dag = parse(graph(R"("over":{"name":"${names}"},"index":"epsilon")", gather(), all_balls));
  EXPECT_EQ(dag.find("links[hand]/grow")->params.at("epsilon"), 0.0);
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("epsilon"), 1.0);
  EXPECT_EQ(errors(R"("over":{"name":"${names}"},"index":"epsilom")", gather(), all_balls),
            "g.json:5:36: map body \"body.json\" has no parameter \"epsilom\" (at /nodes/links/index)\n"
            "  did you mean \"epsilon\"?\n");
  EXPECT_EQ(errors(R"("over":{"name":"${names}"},"index":"name")", gather(), all_balls),
            "g.json:5:36: parameter \"name\" of map \"links\" has a value already (at /nodes/links/index)\n"
            "  let \"index\" be another one\n");
}

TEST_F(Map, outputs_of_the_graph_have_the_entry_before_their_name) {
  const Dag dag = parse(graph(plain(), "", R"({"balls":{"from":"links.balls","doc":"d"}})"));
  ASSERT_EQ(dag.outputs.size(), 2U);
  EXPECT_EQ(dag.outputs[0].name, "hand/balls");
  EXPECT_EQ(dag.outputs[0].base_name(), "balls");
  EXPECT_EQ(dag.outputs[1].name, "arm/balls");
  EXPECT_EQ(dag.nodes[dag.outputs[1].from.node].path, "links[arm]/grow");
  ASSERT_EQ(dag.interfaces.size(), 2U);
  EXPECT_EQ(dag.interfaces[0].name, "links[hand].balls");
}

TEST_F(Map, settings_reach_one_copy_or_all) {
  const std::string text = graph(plain(), gather(), all_balls);
  Dag dag = parse(text, {{"links/grow.steps", "5"}, {"links[arm]/grow.steps", "6"}});
  EXPECT_EQ(dag.find("links[hand]/grow")->params.at("steps"), 5);
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("steps"), 6);
  dag = parse(text, {{"links[arm].steps", "7"}, {"names", "arm,a.stl"}, {"links[a.stl]/grow.epsilon", "2"}});
  EXPECT_EQ(dag.find("links[arm]/grow")->params.at("steps"), 7);
  EXPECT_EQ(dag.find("links[a.stl]/grow")->params.at("epsilon"), 2.0);
  EXPECT_THROW(parse(text, {{"links[leg]/grow.steps", "5"}}), GraphError);
}

TEST_F(Map, nodes_are_named_one_by_one_or_together) {
  const Dag dag = parse(graph(plain(), gather(), all_balls));
  EXPECT_EQ(nodes_named(dag, "links").size(), 2U);
  EXPECT_EQ(nodes_named(dag, "links/grow").size(), 2U);
  EXPECT_EQ(nodes_named(dag, "links[arm]").size(), 1U);
  EXPECT_EQ(nodes_named(dag, "links[arm]/grow").size(), 1U);
  EXPECT_THROW(nodes_named(dag, "links[leg]"), Error);
  EXPECT_EQ(without_entries("a[x]/b/c[y.z]/d"), "a/b/c/d");
  EXPECT_EQ(without_entries("[epsilon=1]/a"), "[epsilon=1]/a");
}

TEST_F(Map, maps_in_maps_give_one_list) {
  test::write_file(folder_.file("outer.json"), R"({"params":{"side":{"kind":"string"}},
    "inputs":{"points":{"type":"Points"}},
    "nodes":{"fingers":{"map":"body.json","over":{"name":["f1","f2"]},"inputs":{"points":"inputs.points"}}},
    "outputs":{"balls":"fingers.balls"}})");
  const Dag dag = parse(R"({"nodes":{"load":{"type":"Load","params":{"file":"x"}},
    "hands":{"map":"outer.json","over":{"side":["left","right"]},"inputs":{"points":"load.points"}},
    "all":{"type":"Gather","inputs":{"balls":"hands.balls"}}},
    "outputs":{"balls":"hands.balls","all":"all.balls"}})");
  std::vector<std::string> names;
  for (const DagOutput& output : dag.outputs) names.push_back(output.name);
  EXPECT_EQ(names, (std::vector<std::string>{"left/f1/balls", "left/f2/balls", "right/f1/balls",
                                             "right/f2/balls", "all"}));
  EXPECT_EQ(dag.find("all")->inputs.size(), 4U);
  EXPECT_EQ(dag.nodes[dag.find("all")->inputs.at("balls[2]").node].path, "hands[right]/fingers[f1]/grow");
}

TEST_F(Map, a_list_goes_through_the_outputs_of_a_subgraph) {
  test::write_file(folder_.file("sub.json"), R"({"params":{"names":{"kind":"list"}},
    "inputs":{"points":{"type":"Points"}},
    "nodes":{"links":{"map":"body.json","over":{"name":"${names}"},"inputs":{"points":"inputs.points"}}},
    "outputs":{"balls":"links.balls"}})");
  const Dag dag = parse(R"({"params":{"n":{"kind":"list","default":["a","b"]}},
    "nodes":{"load":{"type":"Load","params":{"file":"x"}},
    "robot":{"graph":"sub.json","params":{"names":"${n}"},"inputs":{"points":"load.points"}},
    "all":{"type":"Gather","inputs":{"balls":"robot.balls"}}},"outputs":{"all":"all.balls"}})");
  EXPECT_EQ(paths(dag),
            (std::vector<std::string>{"load", "robot/links[a]/grow", "robot/links[b]/grow", "all"}));
}

TEST_F(Map, a_copy_that_only_passes_on_is_no_node) {
  test::write_file(folder_.file("pass.json"), R"({"params":{"name":{"kind":"string"}},
    "inputs":{"points":{"type":"Points"}},"nodes":{},"outputs":{"points":"inputs.points"}})");
  const Dag dag = parse(R"({"nodes":{"load":{"type":"Load","params":{"file":"x"}},
    "m":{"map":"pass.json","over":{"name":["a","b"]},"inputs":{"points":"load.points"}}},"outputs":{"p":"m.points"}})");
  ASSERT_EQ(dag.outputs.size(), 2U);
  EXPECT_EQ(dag.outputs[0].from.node, dag.outputs[1].from.node);
}

TEST_F(Map, bodies_may_have_loops_and_loops_maps) {
  test::write_file(folder_.file("round.json"),
                   R"({"inputs":{"cover":{"type":"Cover"}},"params":{"k":{"kind":"number"}},
    "nodes":{"trim":{"type":"Trim","inputs":{"cover":"inputs.cover"},"params":{"keep":"${k}"}}},
    "outputs":{"cover":"trim.cover"}})");
  test::write_file(folder_.file("looping.json"), R"({"params":{"k":{"kind":"number"}},
    "inputs":{"balls":{"type":"Balls"},"points":{"type":"Points"}},
    "nodes":{"match":{"type":"Match","inputs":{"balls":"inputs.balls","points":"inputs.points"}},
      "rounds":{"loop":"round.json","until":"cover.remaining == 0","inputs":{"cover":"match.cover"},"params":{"k":"${k}"}}},
    "outputs":{"cover":"rounds.cover"}})");
  const Dag dag = parse(R"({"nodes":{"load":{"type":"Load","params":{"file":"x"}},
    "grow":{"type":"Grow","inputs":{"points":"load.points"}},
    "m":{"map":"looping.json","over":{"k":[0.25,0.5]},"inputs":{"balls":"grow.balls","points":"load.points"}}},
    "outputs":{"c":"m.cover"}})");
  const Loop* loop = dag.find("m[0.5]/rounds")->kind.loop();
  ASSERT_NE(loop, nullptr);
  EXPECT_EQ(loop->body.nodes.at(0).path, "m[0.5]/rounds/trim");
  EXPECT_EQ(loop->body.nodes.at(0).params.at("keep"), 0.5);

  test::write_file(folder_.file("gathering.json"),
                   R"({"inputs":{"cover":{"type":"Cover"},"points":{"type":"Points"}},
    "nodes":{"links":{"map":"body.json","over":{"name":["a","b"]},"inputs":{"points":"inputs.points"}},
      "all":{"type":"Gather","inputs":{"balls":"links.balls"}},
      "match":{"type":"Match","inputs":{"balls":"all.balls","points":"inputs.points"}}},
    "outputs":{"cover":"match.cover"}})");
  const Dag looped = parse(R"({"nodes":{"load":{"type":"Load","params":{"file":"x"}},
    "grow":{"type":"Grow","inputs":{"points":"load.points"}},
    "match":{"type":"Match","inputs":{"balls":"grow.balls","points":"load.points"}},
    "rounds":{"loop":"gathering.json","until":"cover.remaining == 1",
              "inputs":{"cover":"match.cover","points":"load.points"}}},
    "outputs":{"c":"rounds.cover"}})");
  EXPECT_EQ(paths(looped.find("rounds")->kind.loop()->body),
            (std::vector<std::string>{"rounds/links[a]/grow", "rounds/links[b]/grow", "rounds/all",
                                      "rounds/match"}));
}

TEST_F(Map, variants_of_a_sweep_share_copies) {
  const Dag dag = parse_graph(graph(plain(), gather(), all_balls), folder_.file("g.json"), with_lists(), {},
                              {{{"links/grow.steps", "3"}, {"names", "[\"hand\", \"arm\"]"}}, {}});
  // One link at a time: each is a list of one.
  ASSERT_EQ(dag.variants.size(), 2U);
  EXPECT_NE(dag.find("[names=hand]/all"), nullptr);
  EXPECT_NE(dag.find("[names=hand]/links[hand]/grow"), nullptr);
  EXPECT_EQ(nodes_named(dag, "links/grow").size(), 2U);
}

TEST_F(Map, files_are_found_by_patterns_and_named_by_their_names) {
  for (const char* const name : {"scans/b.off", "scans/a.off", "scans/c.txt"})
    test::write_file(folder_.file(name), "x");
  test::write_file(folder_.file("each.json"), R"({"params":{"scan":{"kind":"file"}},
    "nodes":{"load":{"type":"Load","params":{"file":"${scan}"}}},"outputs":{"points":"load.points"}})");
  const std::string text = R"({"params":{"scans":{"kind":"files"}},
    "nodes":{"m":{"map":"each.json","over":{"scan":"${scans}"}}},"outputs":{"p":"m.points"}})";
  Dag dag = parse(text, {{"scans", folder_.file("scans/*.off") + "," + folder_.file("scans/a.off")}});
  EXPECT_EQ(paths(dag), (std::vector<std::string>{"m[a.off]/load", "m[b.off]/load"}));
  EXPECT_EQ(dag.nodes[0].params.at("file"), folder_.file("scans/a.off"));
  test::write_file(folder_.file("more/a.off"), "x");
  dag = parse(text, {{"scans", folder_.file("*/a.off")}});
  EXPECT_EQ(dag.nodes.size(), 2U);
  try {
    parse(text, {{"scans", folder_.file("*.ply")}});
    FAIL();
  } catch (const GraphError& error) {
    EXPECT_NE(std::string(error.what()).find("no file matches"), std::string::npos);
  }
}

TEST_F(Map, wrong_maps_are_explained) {
  EXPECT_EQ(errors(R"("over":{"nme":"${names}"})", gather(), all_balls),
            "g.json:5:9: map body \"body.json\" has no parameter \"nme\" (at /nodes/links/over/nme)\n"
            "  did you mean \"name\"?\n");
  EXPECT_EQ(errors(R"("over":{"name":"hand"})", gather(), all_balls),
            "g.json:5:16: map \"links\" goes over lists; what \"name\" has is the text \"hand\" (at "
            "/nodes/links/over/name)\n"
            "  declare a parameter of kind list or files and write \"${name}\", or write [\"a\", \"b\"]\n");
  EXPECT_EQ(errors(plain(), gather(), all_balls, {{"names", ""}}),
            "g.json:5:16: map \"links\" has nothing to go over: the list for \"name\" is empty (at "
            "/nodes/links/over/name)\n"
            "  give it entries, like --set name=a,b,c\n");
  EXPECT_EQ(
      errors(plain(), gather(), all_balls, {{"names", "a,b,a"}}),
      "g.json:5:16: map \"links\" has \"a\" twice in the list for \"name\" (at /nodes/links/over/name)\n"
      "  the first list names the copies: let it have every entry once\n");
  EXPECT_EQ(
      errors(R"("over":{"name":"${names}","steps":"${counts}"})", gather(), all_balls, {{"counts", "1,2,3"}}),
      "g.json:5:35: the lists of map \"links\" do not go together: \"name\" has 2, \"steps\" has 3 entries "
      "(at /nodes/links/over/steps)\n"
      "  \"steps\" needs one entry for each \"name\", or one for all\n");
  EXPECT_EQ(
      errors(R"("over":{"name":"${names}","steps":"${counts}"})", gather(), all_balls, {{"counts", "1,x"}}),
      "g.json:5:35: entry 2 of the list for \"steps\" must be of kind integer, is \"x\" (at "
      "/nodes/links/over/steps)\n");
  EXPECT_EQ(
      errors(R"("over":{"name":"${names}","steps":"${counts}"})", gather(), all_balls, {{"counts", "1,11"}}),
      "g.json:5:35: entry 2 of the list for \"steps\" must be at most 10, is 11 (at "
      "/nodes/links/over/steps)\n");
  EXPECT_EQ(
      errors(plain() + R"(,"params":{"name":"x"})", gather(), all_balls),
      "g.json:5:38: parameter \"name\" of map \"links\" is in \"over\", too (at /nodes/links/params/name)\n"
      "  remove one of them\n");
  EXPECT_EQ(errors(R"("over":{})", gather(), all_balls),
            "g.json:5:8: map \"links\" goes over nothing (at /nodes/links/over)\n"
            "  \"over\": { \"parameter\": \"${list}\" }\n");
  EXPECT_EQ(
      errors(R"("doc":"d")", gather(), all_balls),
      "g.json:4:1: map \"links\" has no \"over\" (at /nodes/links)\n"
      "  \"over\": { \"parameter\": \"${list}\" }, a parameter of the body and the list it goes through\n");
  EXPECT_EQ(errors(plain(), R"(,"g":{"type":"Gather","over":{},"inputs":{"balls":"links.bals"}})",
                   R"({"b":"g.balls"})"),
            "g.json:5:50: \"over\" is for maps, node \"g\" is none (at /nodes/g/over)\n"
            "  \"map\": \"body.json\" makes a node a map\n"
            "g.json:5:78: map \"links\" (body.json) has no output \"bals\" (at /nodes/g/inputs/balls)\n"
            "  did you mean \"balls\"?\n");
}

TEST_F(Map, a_list_for_what_takes_one_is_explained) {
  EXPECT_EQ(
      errors(plain(), R"(,"show":{"type":"Match","inputs":{"balls":"links.balls","points":"load.points"}})",
             R"({"c":"show.cover"})"),
      "g.json:5:70: \"links.balls\" is a list, one Balls for each entry of a map, but input \"balls\" of "
      "node "
      "\"show\" (Match) takes one (at /nodes/show/inputs/balls)\n"
      "  put the node into the body of the map, or connect a port that takes a list\n");
  // Into itself, and through a subgraph: an error, and an end.
  test::write_file(folder_.file("pass.json"), R"({"params":{"name":{"kind":"string"}},
    "inputs":{"points":{"type":"Points"}},"nodes":{},"outputs":{"points":"inputs.points"}})");
  EXPECT_THROW(parse(R"({"nodes":{"m":{"map":"pass.json","over":{"name":["a","b"]},
    "inputs":{"points":"m.points"}}},"outputs":{"p":"m.points"}})"),
               GraphError);
  EXPECT_THROW(
      parse(R"({"nodes":{"m":{"map":"pass.json","over":{"name":["a","b"]},"inputs":{"points":"n.points"}},
    "n":{"map":"pass.json","over":{"name":["c"]},"inputs":{"points":"m.points"}}},"outputs":{"p":"m.points","q":"n.points"}})"),
      GraphError);
}

TEST_F(Map, lists_are_no_texts) {
  EXPECT_EQ(errors(R"("over":{"name":"${names}"},"params":{"epsilon":"a${counts}"})", gather(), all_balls),
            "g.json:5:48: parameter \"counts\" is a list, which is no part of a text (at "
            "/nodes/links/params/epsilon)\n"
            "  let it stand alone: \"${counts}\"\n");
  EXPECT_EQ(errors(R"("over":{"name":"${names}"},"params":{"epsilon":"${counts}"})", gather(), all_balls),
            "g.json:5:48: \"epsilon\" must be a number, is an array (at /nodes/links/params/epsilon)\n");
  EXPECT_EQ(errors(R"("over":{"name":["a${names}"]})", gather(), all_balls),
            "g.json:5:17: a list cannot have parameters in it (at /nodes/links/over/name/0)\n"
            "  declare the whole list as a parameter of kind list\n");
  EXPECT_EQ(errors(plain(), gather(), all_balls, {{"names", "[1"}}),
            "--set names=[1:0:0: \"names\" must be a,b,c or a JSON list, is \"[1\" (at )\n  names: names\n");
}

TEST_F(Map, ten_thousand_copies_are_made_quickly) {
  std::string names;
  for (int i = 0; i < 10'000; ++i) names += (i == 0 ? "" : ",") + ("n" + std::to_string(i));
  const Dag dag = parse(graph(plain(), gather(), all_balls), {{"names", names}});
  EXPECT_EQ(dag.nodes.size(), 10'002U);
  EXPECT_EQ(dag.nodes[dag.find("all")->inputs.at("balls[9999]").node].path, "links[n9999]/grow");
}

}  // namespace
}  // namespace ballflow
