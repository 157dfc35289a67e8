// Graphs that are wrong: where and what the reader is told. One test per kind of error.
#include <gtest/gtest.h>

#include <ctime>

#include "ballflow/graph.hpp"
#include "document_fixture.hpp"
#include "shown_errors.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

/// All errors without the caret lines; empty when the graph is right.
std::string errors(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    parse_graph(text, "g.json", registry(), settings);
  } catch (const GraphError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return shown(error.findings());
  }
  return {};
}

/// A graph of one Load node with `params`, whose text begins in line 2, column 1.
std::string with_params(const std::string& params) {
  return "{\"outputs\":{\"p\":\"l.points\"},\"nodes\":{\"l\":{\"type\":\"Load\",\"params\":\n" + params +
         "}}}";
}

/// A graph around `nodes`, which begin in line 2, column 1; l is a Load node.
std::string with_nodes(const std::string& nodes) {
  return "{\"outputs\":{\"p\":\"l.points\"},\"nodes\":{\"l\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}},"
         "\n" +
         nodes + "}}";
}

TEST(graph_error, prints_place_line_caret_and_hint) {
  try {
    parse_graph("{ \"nodes\": {\n  \"a\": { \"type\": \"Lod\" } },\n  \"outputs\": { \"p\": \"a.points\" } }",
                "dir/g.json", registry());
    FAIL();
  } catch (const GraphError& error) {
    EXPECT_STREQ(error.what(),
                 "dir/g.json:2:18: error: unknown node type \"Lod\" (at /nodes/a/type)\n"
                 "      \"a\": { \"type\": \"Lod\" } },\n"
                 "                     ^\n"
                 "  did you mean \"Load\"?");
  }
}

TEST(graph_error, aliases_that_name_something_else) {
  const auto with = [](const std::string& params) {
    return errors("{\"params\":{\n" + params +
                  "},\"nodes\":{\"l\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}}},"
                  "\"outputs\":{\"p\":\"l.points\"}}");
  };
  const std::string a = R"("a":{"kind":"number","default":1})";
  EXPECT_NE(with(a + R"(,"b":{"kind":"number","default":1,"alias":"a"})")
                .find("is the name of a parameter already"),
            std::string::npos);
  EXPECT_NE(with(R"("b":{"kind":"number","default":1,"alias":"a"},)" + a)
                .find("\"a\" is the alias of \"b\" already"),
            std::string::npos);
  EXPECT_NE(with(R"("b":{"kind":"number","default":1,"alias":"2b"})").find("is no name of a parameter"),
            std::string::npos);
}

TEST(graph_error, syntax) {
  EXPECT_EQ(
      errors(""),
      "g.json:1:1: not JSON: unexpected end of input; expected '[', '{', or a literal (in value) (at )\n"
      "  the text ends too early: a bracket or quote is not closed\n");
  EXPECT_EQ(errors("{\"nodes\":{},\n}"),
            "g.json:2:1: not JSON: unexpected '}'; expected string literal (in object key) (at )\n  remove "
            "the comma before it\n");
  EXPECT_EQ(errors("{\"nodes\":\n  {\"a\" {}}}"),
            "g.json:2:8: not JSON: unexpected '{'; expected ':' (in object separator) (at /nodes)\n");
  EXPECT_EQ(errors("{\"doc\": \n\"open}"),
            "g.json:2:1: not JSON: invalid string: missing closing quote (in value) (at )\n");
  EXPECT_EQ(errors("{} extra"),
            "g.json:1:4: not JSON: invalid literal; expected end of input (in value) (at )\n  the value ends "
            "before this; remove what follows\n");
  EXPECT_EQ(errors("{} {}"),
            "g.json:1:4: not JSON: unexpected '{'; expected end of input (in value) (at )\n"
            "  the value ends before this; remove what follows\n");
  EXPECT_EQ(errors("{'a':1}"),
            "g.json:1:2: not JSON: invalid literal; expected string literal (in object key) (at )\n"
            "  texts are written in double quotes\n");
  EXPECT_EQ(
      errors("{\"nodes\":{}} /* open"),
      "g.json:1:14: not JSON: invalid comment; missing closing '*/'; expected end of input (in value) (at )\n"
      "  the comment is not closed\n");
}

TEST(graph_error, numbers_that_are_none) {
  EXPECT_EQ(errors(with_params("{\"file\":\"x\",\"scale\":NaN}")),
            "g.json:2:21: not JSON: invalid literal (in value) (at /nodes/l/params)\n  JSON has no NaN and "
            "no infinity\n");
  EXPECT_EQ(
      errors(with_params("{\"file\":\"x\",\"scale\":-inf}")),
      "g.json:2:21: not JSON: invalid number; expected digit after '-' (in value) (at /nodes/l/params)\n"
      "  JSON has no NaN and no infinity\n");
  EXPECT_EQ(errors(with_params("{\"file\":\"x\",\"scale\":1e999}")),
            "g.json:2:21: the number 1e999 is too large (at /nodes/l/params)\n"
            "  numbers are 64-bit floating point, up to 1.79e308\n");
}

TEST(graph_error, bytes_that_are_no_text) {
  EXPECT_EQ(errors("{\"doc\":\"a\xff\"}"),
            "g.json:1:10: not JSON: invalid string: ill-formed UTF-8 byte (in value) (at )\n");
  EXPECT_EQ(errors(std::string("{}\n\0{", 5)),
            "g.json:2:1: not JSON: the text contains a NUL byte (at )\n"
            "  the file is binary or damaged\n");
  EXPECT_EQ(errors(std::string("\xff\xfe{\0}\0", 6)),
            "g.json:1:4: not JSON: the text contains a NUL byte (at )\n"
            "  save the file as UTF-8, it is UTF-16\n");
}

TEST(graph_error, hostile_sizes_and_depths_give_one_error_at_once) {
  const std::clock_t start = std::clock();
  const auto pointer = [](const std::string& step) {
    std::string text;
    for (int i = 0; i < 99; ++i) text += step;
    return " (at " + text + ")\n";
  };
  EXPECT_EQ(errors(std::string(10'000'000, '[')),
            "g.json:1:101: brackets are nested deeper than 100 levels" + pointer("/0"));
  EXPECT_EQ(errors(std::string(200'000, '[') + std::string(200'000, ']')),
            "g.json:1:101: brackets are nested deeper than 100 levels" + pointer("/0"));
  std::string objects;
  for (int i = 0; i < 200'000; ++i) objects += "{\"a\":";
  EXPECT_EQ(errors(objects), "g.json:1:501: brackets are nested deeper than 100 levels" + pointer("/a"));
  EXPECT_EQ(errors(std::string((std::size_t{64} << 20) + 1, ' ')),
            "g.json:0:0: the text is larger than 64 MB (at )\n");
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 3.0);
}

TEST(graph_error, a_graph_that_is_no_object) {
  EXPECT_EQ(errors("[]"), "g.json:1:1: a graph must be an object, is an array (at )\n  { \"nodes\": { } }\n");
  EXPECT_EQ(errors("{}"),
            "g.json:1:1: a graph has \"nodes\" (at )\n  \"nodes\": { \"name\": { \"type\": \"...\" } }\n");
  EXPECT_EQ(errors("{\"nodes\": 3}"), "g.json:1:11: \"nodes\" must be an object, is 3 (at /nodes)\n");
}

TEST(graph_error, unknown_keys_at_every_level) {
  EXPECT_EQ(errors("{\"node\":{},\"nodes\":{}}"),
            "g.json:1:2: unknown key \"node\" (at /node)\n  did you mean \"nodes\"?\n");
  EXPECT_EQ(errors(with_nodes("\"b\":{\"typ\":\"Load\"}")),
            "g.json:2:6: unknown key \"typ\" (at /nodes/b/typ)\n  did you mean \"type\"?\n");
  EXPECT_EQ(errors("{\"params\":{\"a\":{\"kind\":\"number\",\"defualt\":1,\"default\":1}},\"nodes\":{}}"),
            "g.json:1:33: unknown key \"defualt\" (at /params/a/defualt)\n  did you mean \"default\"?\n");
  EXPECT_EQ(errors("{\"inputs\":{\"a\":{\"type\":\"Points\",\"zzzzzz\":1,\"optional\":true}},\"nodes\":{}}"),
            "g.json:1:33: unknown key \"zzzzzz\" (at /inputs/a/zzzzzz)\n  an input has the keys \"type\", "
            "\"optional\", \"doc\"\n");
  EXPECT_EQ(errors("{\"nodes\":{\"l\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}}},\"outputs\":{\"a\":{"
                   "\"from\":\"l.points\",\"dok\":\"\"}}}"),
            "g.json:1:88: unknown key \"dok\" (at /outputs/a/dok)\n  did you mean \"doc\"?\n");
}

TEST(graph_error, duplicate_keys_at_the_second_one) {
  EXPECT_EQ(errors(with_nodes("\"l\":{\"type\":\"Show\"}")),
            "g.json:2:1: duplicate key \"l\" (at /nodes/l)\n  the first one is at line 1, column 38\n");
  EXPECT_EQ(errors(with_params("{\"file\":\"x\",\"file\":3,\"file\":4}")),
            "g.json:2:13: duplicate key \"file\" (at /nodes/l/params/file)\n  the first one is at line 2, "
            "column 2\n"
            "g.json:2:22: duplicate key \"file\" (at /nodes/l/params/file)\n  the first one is at line 2, "
            "column 2\n");
}

TEST(graph_error, unknown_node_type) {
  EXPECT_EQ(errors(with_nodes("\"b\":{\"type\":\"Nothing\"}")),
            "g.json:2:13: unknown node type \"Nothing\" (at /nodes/b/type)\n"
            "  node types are \"Grow\", \"Load\", \"Match\", \"Show\", \"Trim\"\n");
}

TEST(graph_error, a_node_is_a_type_or_a_graph) {
  EXPECT_EQ(errors(with_nodes("\"b\":{}")),
            "g.json:2:1: node \"b\" has no \"type\", \"graph\", \"loop\" or \"map\" (at /nodes/b)\n"
            "  \"type\" names a node type, \"graph\" the file of a subgraph, \"loop\" and \"map\" that of "
            "the body of a loop or map\n");
  EXPECT_EQ(
      errors(with_nodes("\"b\":{\"type\":\"Load\",\"graph\":\"x.json\"}")),
      "g.json:2:28: node \"b\" has both \"type\" and \"graph\" (at /nodes/b/graph)\n  keep one of them\n");
  EXPECT_EQ(errors(with_nodes("\"b\":7")),
            "g.json:2:5: node \"b\" must be an object, is 7 (at /nodes/b)\n"
            "  { \"type\": \"...\", \"inputs\": { }, \"params\": { } }\n");
  EXPECT_EQ(errors(with_nodes("\"b/c\":{\"type\":\"Load\"}")),
            "g.json:2:1: \"b/c\" is no name of a node (at /nodes/b~1c)\n  use letters, digits, _ and -\n");
  EXPECT_EQ(errors(with_nodes("\"inputs\":{\"type\":\"Load\"}")),
            "g.json:2:1: no node can be named \"inputs\" (at /nodes/inputs)\n  \"inputs.x\" means the input "
            "x of the graph\n");
}

TEST(graph_error, edges_that_lead_nowhere) {
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"ll.points\"}}")),
            "g.json:2:39: the graph has no node \"ll\" (at /nodes/g/inputs/points)\n  did you mean \"l\"?\n");
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"l.point\"}}")),
            "g.json:2:39: node \"l\" (Load) has no output \"point\" (at /nodes/g/inputs/points)\n  did you "
            "mean \"points\"?\n");
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"l\"}}")),
            "g.json:2:39: an edge must be \"node.port\", is the text \"l\" (at /nodes/g/inputs/points)\n"
            "  name the output port too: \"l.<port>\"\n");
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":[\"l.points\"]}}")),
            "g.json:2:30: input \"points\" of node \"g\" (Grow) takes one artifact, not a list (at "
            "/nodes/g/inputs/points)\n  write one edge: \"points\": \"node.port\"\n");
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"inputs.points\"}}")),
            "g.json:2:39: the graph has no input \"points\" (at /nodes/g/inputs/points)\n  the graph "
            "declares no \"inputs\"\n");
  EXPECT_EQ(
      errors("{\"nodes\":{\"l\":{\"type\":\"Load\",\"params\":{\"file\":\"x\"}}},\"outputs\":{\"a\":\"l."
             "pts\"}}"),
      "g.json:1:69: node \"l\" (Load) has no output \"pts\" (at /outputs/a)\n  outputs are \"points\"\n");
}

TEST(graph_error, unknown_and_missing_inputs) {
  EXPECT_EQ(errors(with_nodes(
                "\"g\":{\"type\":\"Grow\",\"inputs\":{\"point\":\"l.points\",\"points\":\"l.points\"}}")),
            "g.json:2:30: node \"g\" (Grow) has no input \"point\" (at /nodes/g/inputs/point)\n  did you "
            "mean \"points\"?\n");
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Grow\"}")),
            "g.json:2:1: node \"g\" (Grow) misses its input \"points\" (Points) (at /nodes/g)\n"
            "  \"points\": \"l.points\" would be a Points\n");
}

TEST(graph_error, type_mismatch_names_both_types_and_both_ends) {
  EXPECT_EQ(errors(with_nodes("\"g\":{\"type\":\"Show\",\"inputs\":{\"balls\":\"l.points\"}}")),
            "g.json:2:38: \"l.points\" is a Points, but input \"balls\" of node \"g\" (Show) takes a Balls "
            "(at /nodes/g/inputs/balls)\n");
}

TEST(graph_error, cycles_are_printed_once_each) {
  EXPECT_EQ(errors(R"({"outputs":{"o":"a.cover"},"nodes":{
"c":{"type":"Trim","inputs":{"cover":"b.cover"},"params":{"keep":1}},
"a":{"type":"Trim","inputs":{"cover":"c.cover"},"params":{"keep":1}},
"b":{"type":"Trim","inputs":{"cover":"a.cover"},"params":{"keep":1}},
"after":{"type":"Trim","inputs":{"cover":"b.cover"},"params":{"keep":1}},
"self":{"type":"Trim","inputs":{"cover":"self.cover"},"params":{"keep":1}}}})"),
            "g.json:3:38: cycle: a -> b -> c -> a (at /nodes/a/inputs/cover)\n  remove one of these edges\n"
            "g.json:6:41: cycle: self -> self (at /nodes/self/inputs/cover)\n  remove one of these edges\n");
}

TEST(graph_error, parameters_of_nodes) {
  EXPECT_EQ(errors(with_params("{}")),
            "g.json:1:38: node \"l\" (Load) needs a value for its parameter \"file\" (at /nodes/l)\n"
            "  file: the file to read\n");
  EXPECT_EQ(errors(with_params("{\"file\":\"x\",\"scal\":1}")),
            "g.json:2:13: node type \"Load\" has no parameter \"scal\" (at /nodes/l/params/scal)\n  did you "
            "mean \"scale\"?\n");
  EXPECT_EQ(
      errors(with_params("{\"file\":\"x\",\"scale\":0}")),
      "g.json:2:21: \"scale\" must be more than 0, is 0 (at /nodes/l/params/scale)\n  scale: factor (1)\n");
  EXPECT_EQ(errors(with_params("{\"file\":\"x\",\"mode\":\"fastt\"}")),
            "g.json:2:20: \"mode\" must be one of \"fast\", \"exact\", is the text \"fastt\" (at "
            "/nodes/l/params/mode)\n"
            "  did you mean \"fast\"?\n");
  EXPECT_EQ(errors(with_params("{\"file\":{}}")),
            "g.json:2:9: \"file\" must be the path of a file, is an object (at /nodes/l/params/file)\n"
            "  file: the file to read\n");
  const auto grow = [](const std::string& params) {
    return errors(with_nodes("\"g\":{\"type\":\"Grow\",\"inputs\":{\"points\":\"l.points\"},\"params\":\n" +
                             params + "}"));
  };
  EXPECT_EQ(grow("{\"epsilon\":-1}"),
            "g.json:3:12: \"epsilon\" must be at least 0, is -1 (at /nodes/g/params/epsilon)\n  epsilon: "
            "growth (%)\n");
  EXPECT_EQ(grow("{\"epsilon\":100.5}"),
            "g.json:3:12: \"epsilon\" must be at most 100, is 100.5 (at /nodes/g/params/epsilon)\n  epsilon: "
            "growth (%)\n");
  EXPECT_EQ(grow("{\"epsilon\":\"1\"}"),
            "g.json:3:12: \"epsilon\" must be a number, is the text \"1\" (at /nodes/g/params/epsilon)\n  "
            "epsilon: growth (%)\n");
  EXPECT_EQ(
      grow("{\"steps\":2.5}"),
      "g.json:3:10: \"steps\" must be a whole number, is 2.5 (at /nodes/g/params/steps)\n  steps: rounds\n");
  EXPECT_EQ(grow("{\"steps\":18446744073709551615}"),
            "g.json:3:10: \"steps\" must fit 64 bits with sign, is 18446744073709551615 (at "
            "/nodes/g/params/steps)\n  steps: rounds\n");
  EXPECT_EQ(grow("{\"closed\":1}"),
            "g.json:3:11: \"closed\" must be true or false, is 1 (at /nodes/g/params/closed)\n  closed: "
            "closed balls\n");
  EXPECT_EQ(grow("{\"label\":null}"),
            "g.json:3:10: \"label\" must be a text, is null (at /nodes/g/params/label)\n  label: any text\n");
}

TEST(graph_error, parameters_of_the_graph) {
  const auto declared = [](const std::string& params) {
    return errors("{\"nodes\":{},\"params\":{\n" + params + "}}");
  };
  EXPECT_EQ(declared("\"a\":{\"default\":1}"),
            "g.json:2:1: parameter \"a\" has no \"kind\" (at /params/a)\n"
            "  kinds are number, integer, boolean, string, choice, file, list, files and artifact\n");
  EXPECT_EQ(declared("\"a\":{\"kind\":\"numbr\"}"),
            "g.json:2:13: unknown kind \"numbr\" (at /params/a/kind)\n  did you mean \"number\"?\n");
  EXPECT_EQ(declared("\"a\":{\"kind\":\"number\",\"minimum\":1,\"default\":0}"),
            "g.json:2:44: the default of \"a\" must be at least 1, is 0 (at /params/a/default)\n");
  EXPECT_EQ(declared("\"a\":{\"default\":\"gredy\",\"kind\":\"choice\",\"choices\":[\"greedy\",{\"value\":"
                     "\"exact\",\"doc\":\"slow\"}]}"),
            "g.json:2:16: the default of \"a\" must be one of \"greedy\", \"exact\", is the text \"gredy\" "
            "(at /params/a/default)\n"
            "  did you mean \"greedy\"?\n");
  EXPECT_EQ(
      declared("\"a\":{\"kind\":\"string\",\"minimum\":1,\"default\":\"\"}"),
      "g.json:2:22: \"minimum\" is for numbers, the parameter is of kind string (at /params/a/minimum)\n");
  EXPECT_EQ(declared("\"a-b\":{\"kind\":\"string\",\"default\":\"\"}"),
            "g.json:2:1: \"a-b\" is no name of a parameter (at /params/a-b)\n  use letters, digits and _, no "
            "digit first\n");
  EXPECT_EQ(declared("\"a\":{\"kind\":\"number\"}"),
            "g.json:2:1: parameter \"a\" has no value (at /params/a)\n  give it one: --set a=<number>\n");
}

TEST(graph_error, substitutions) {
  EXPECT_EQ(errors("{\"params\":{\"epsilon\":{\"kind\":\"number\",\"default\":1}},\n\"nodes\":{\"l\":{"
                   "\"type\":\"Load\",\"params\":{\"file\":\"a${epsilom}\",\"scale\":\"${epsilon}\"}}},"
                   "\"outputs\":{\"p\":\"l.points\"}}"),
            "g.json:2:46: the graph has no parameter \"epsilom\" (at /nodes/l/params/file)\n  did you mean "
            "\"epsilon\"?\n");
  EXPECT_EQ(errors(with_params("{\"file\":\"${a\"}")),
            "g.json:2:9: \"${\" without \"}\" in \"${a\" (at /nodes/l/params/file)\n  write $${ for a "
            "literal ${\n");
  EXPECT_EQ(
      errors("{\"params\":{\"s\":{\"kind\":\"string\",\"default\":\"1\"}},\n\"nodes\":{\"l\":{\"type\":"
             "\"Load\",\"params\":{\"file\":\"x\",\"scale\":\"${s}\"}}},\"outputs\":{\"p\":\"l.points\"}}"),
      "g.json:2:58: \"scale\" must be a number, is the text \"1\" (at /nodes/l/params/scale)\n  scale: "
      "factor (1)\n");
}

TEST(graph_error, settings) {
  const std::string graph =
      "{\"params\":{\"epsilon\":{\"kind\":\"number\",\"default\":1,\"minimum\":0,\"doc\":\"growth\",\"unit\":"
      "\"%\"}},\"nodes\":{\"l\":{\"type\":\"Load\","
      "\"params\":{\"file\":\"x\",\"scale\":\"${epsilon}\"}}},\"outputs\":{\"p\":\"l.points\"}}";
  EXPECT_EQ(errors(graph, {{"epsilon", "2"}, {"l.mode", "exact"}}), "");
  EXPECT_EQ(errors(graph, {{"epsilon", "abc"}}),
            "--set epsilon=abc:0:0: \"epsilon\" must be a finite number, is \"abc\" (at )\n  epsilon: growth "
            "(%)\n");
  EXPECT_EQ(errors(graph, {{"epsilon", "nan"}}),
            "--set epsilon=nan:0:0: \"epsilon\" must be a finite number, is \"nan\" (at )\n  epsilon: growth "
            "(%)\n");
  EXPECT_EQ(errors(graph, {{"epsilon", "-1"}}),
            "--set epsilon=-1:0:0: \"epsilon\" must be at least 0, is -1 (at )\n  epsilon: growth (%)\n");
  EXPECT_EQ(
      errors(graph, {{"epsilom", "1"}}),
      "--set epsilom=1:0:0: the graph has no parameter \"epsilom\" (at )\n  did you mean \"epsilon\"?\n");
  EXPECT_EQ(
      errors(graph, {{"l.mod", "exact"}}),
      "--set l.mod=exact:0:0: the graph has no parameter \"l.mod\" (at )\n  did you mean \"l.mode\"?\n");
  EXPECT_EQ(errors(graph, {{"l.mode", "exakt"}}),
            "--set l.mode=exakt:0:0: \"mode\" must be one of \"fast\", \"exact\", is the text \"exakt\" (at "
            ")\n  did you mean \"exact\"?\n");
}

TEST(graph_error, inputs_of_the_top_graph_are_not_connected) {
  EXPECT_EQ(
      errors(
          R"({"inputs":{"p":{"type":"Points"}},"nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p"}}},"outputs":{"b":"g.balls"}})"),
      "g.json:1:12: input \"p\" (Points) is not connected (at /inputs/p)\n"
      "  a graph with inputs is a subgraph: run a graph that includes it\n");
  EXPECT_EQ(
      errors(
          R"({"inputs":{"p":{"type":"Point"}},"nodes":{"g":{"type":"Grow","inputs":{"points":"inputs.p"}}},"outputs":{"b":"g.balls"}})"),
      "g.json:1:24: unknown type \"Point\" (at /inputs/p/type)\n  did you mean \"Points\"?\n");
}

TEST(graph_error, all_of_a_file_at_once_each_once_in_order) {
  EXPECT_EQ(
      errors(R"({
  "docs": "x",
  "params": { "eps": { "kind": "number", "default": "a" } },
  "nodes": {
    "l": { "type": "Load", "params": { "file": "x", "scale": "${eps}", "mode": 3 } },
    "bad": { "type": "Unknown", "params": { "x": 1 }, "inputs": { "y": "l.points" } },
    "g": { "type": "Grow", "inputs": { "points": "bad.points" } },
    "m": { "type": "Match", "inputs": { "balls": "l.points", "points": "no.points" } },
    "t": { "type": "Trim", "inputs": { "cover": "m.cover" }, "params": { "keep": 2 } }
  },
  "outputs": { "o": "bad.points", "q": "t.covers", "r": "zz.y" }
})"),
      "g.json:2:3: unknown key \"docs\" (at /docs)\n  did you mean \"doc\"?\n"
      "g.json:3:53: the default of \"eps\" must be a number, is the text \"a\" (at /params/eps/default)\n"
      "g.json:5:80: \"mode\" must be one of \"fast\", \"exact\", is 3 (at /nodes/l/params/mode)\n  mode: "
      "how\n"
      "g.json:6:22: unknown node type \"Unknown\" (at /nodes/bad/type)\n"
      "  node types are \"Grow\", \"Load\", \"Match\", \"Show\", \"Trim\"\n"
      "g.json:8:50: \"l.points\" is a Points, but input \"balls\" of node \"m\" (Match) takes a Balls (at "
      "/nodes/m/inputs/balls)\n"
      "  \"balls\": \"g.balls\" would be a Balls\n"
      "g.json:8:72: the graph has no node \"no\" (at /nodes/m/inputs/points)\n  did you mean \"l\"?\n"
      "g.json:9:82: \"keep\" must be at most 1, is 2 (at /nodes/t/params/keep)\n  keep: share that stays\n"
      "g.json:11:40: node \"t\" (Trim) has no output \"covers\" (at /outputs/q)\n  did you mean \"cover\"?\n"
      "g.json:11:57: the graph has no node \"zz\" (at /outputs/r)\n  did you mean \"l\"?\n");
}

TEST(graph_error, never_prints_raw_control_characters) {
  try {
    parse_graph(with_nodes("\"a\\u001b[31m\":{\"type\":\"Load\"}"), "g.json", registry());
    FAIL();
  } catch (const GraphError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_NE(text.find("\"a?[31m\" is no name of a node (at /nodes/a?[31m)"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace ballflow
