// Declarations that node libraries hand over, and what is derived from them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "ballflow/error.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/schema.hpp"
#include "test_data.hpp"
#include "toy_nodes.hpp"

namespace ballflow {
namespace {

std::string node_problem(const std::string& json) {
  try {
    parse_node_declaration(json);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    return error.what();
  }
  return {};
}

std::string type_problem(const std::string& json) {
  try {
    parse_type_declaration(json);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string param_problem(const std::string& param) {
  return node_problem(R"({"id":"N","version":1,"summary":"","doc":"","params":[)" + param + "]}");
}

TEST(declaration, of_a_node_is_read_completely) {
  const NodeDeclaration node =
      parse_node_declaration(R"({"id":"N","version":3,"summary":"s","doc":"d","avoid_when":"a",
    "cites":[{"key":"k","where":"1.2"}],"libraries":{"CGAL":"5.5"},"uses_seed":true,"memory":{"fixed":1000,"per_input_byte":2.5},
    "inputs":[{"name":"a","type":"A","type_version":2,"doc":"x","optional":true}],
    "outputs":[{"name":"b","type":"B","type_version":1,"doc":"y"}],
    "params":[{"name":"p","kind":"file","required":true,"doc":"f","schemes":["shape:"],"hashed":false}]})");
  EXPECT_EQ(node.id, "N");
  EXPECT_EQ(node.version, 3);
  EXPECT_EQ(node.avoid_when, "a");
  EXPECT_EQ(node.cites.at(0).where, "1.2");
  EXPECT_EQ(node.libraries.at("CGAL"), "5.5");
  EXPECT_TRUE(node.uses_seed);
  EXPECT_EQ(node.memory_fixed, 1000U);
  EXPECT_EQ(node.memory_per_input_byte, 2.5);
  EXPECT_TRUE(node.input("a")->optional);
  EXPECT_EQ(node.input("a")->type_version, 2);
  EXPECT_EQ(node.input("b"), nullptr);
  EXPECT_EQ(node.output("b")->type, "B");
  EXPECT_TRUE(node.param("p")->required);
  EXPECT_FALSE(node.param("p")->hashed);
  EXPECT_EQ(node.param("p")->schemes, std::vector<std::string>{"shape:"});
  EXPECT_TRUE(node.param("p")->default_value.is_null());
}

TEST(declaration, that_is_wrong_names_the_field) {
  EXPECT_EQ(node_problem("[]"), "declaration of a node is no JSON object");
  EXPECT_EQ(node_problem("{"),
            "declaration of a node:1:2: error: not JSON: unexpected end of input; expected string literal "
            "(in object key)\n"
            "    {\n     ^\n  the text ends too early: a bracket or quote is not closed");
  EXPECT_EQ(
      node_problem(R"({"id":"a b","version":1})"),
      "declaration of a node: \"id\" \"a b\" is no name of a type (letters, digits and _, no digit first; "
      "after a namespace and a dot: acme.Offset)");
  EXPECT_EQ(node_problem(R"({"id":"N","version":0})"), "node \"N\": \"version\" is no version (1, 2, ...)");
  EXPECT_EQ(node_problem(R"({"id":"N","version":1,"doc":""})"), "node \"N\" has no \"summary\"");
  EXPECT_EQ(node_problem(R"({"id":"N","version":1,"summary":"","doc":"","extra":1})"),
            "node \"N\" has a field \"extra\" that this version does not know");
  EXPECT_EQ(
      node_problem(
          R"({"id":"N","version":1,"summary":"","doc":"","inputs":[{"name":"a","type":"T","doc":""}]})"),
      "node \"N\": input \"a\" has no \"type_version\"");
  EXPECT_EQ(
      node_problem(
          R"({"id":"N","version":1,"summary":"","doc":"","inputs":[{"name":"a","type":"T","type_version":1,"doc":""},{"name":"a","type":"T","type_version":1,"doc":""}]})"),
      "node \"N\" has two inputs \"a\"");
  EXPECT_EQ(param_problem(R"({"name":"p","kind":"real","default":1,"doc":""})"),
            "node \"N\": parameter \"p\": \"kind\" \"real\" is unknown");
  EXPECT_EQ(param_problem(R"({"name":"p","kind":"number","doc":""})"),
            "node \"N\": parameter \"p\" is not required but has no default");
  EXPECT_EQ(param_problem(R"({"name":"p","kind":"number","default":-1,"minimum":0,"doc":""})"),
            "node \"N\": parameter \"p\": \"default\" must be at least 0, is -1");
  EXPECT_EQ(param_problem(
                R"({"name":"p","kind":"choice","default":null,"doc":"","choices":[{"value":"a","doc":""}]})"),
            "node \"N\": parameter \"p\": \"default\" must be one of \"a\", is null");
  EXPECT_EQ(param_problem(R"({"name":"p","kind":"choice","default":"a","doc":""})"),
            "node \"N\": parameter \"p\" is a choice without choices");
  EXPECT_EQ(param_problem(R"({"name":"p","kind":"string","default":"a","doc":"","maximum":3})"),
            "node \"N\": parameter \"p\" has a range but is of kind string");
  EXPECT_EQ(
      type_problem(R"({"id":"T","version":1,"doc":"","arrays":[{"name":"a","dtype":"f16","shape":[]}]})"),
      "type \"T\": array \"a\": \"dtype\" \"f16\" is unknown");
  EXPECT_EQ(type_problem(
                R"({"id":"T","version":1,"doc":"","arrays":[{"name":"a","dtype":"f64","shape":[3,"n"]}]})"),
            "type \"T\": array \"a\": \"shape\" holds fixed lengths and at most a name in front");
}

TEST(declaration, may_have_a_namespace) {
  const auto with_id = [](const std::string& id) {
    return node_problem("{\"id\":\"" + id + "\",\"version\":1,\"summary\":\"\",\"doc\":\"\"}");
  };
  for (const char* good : {"Offset", "acme.Offset", "com.acme_2.x.Offset", "_", "Node", "acme.loop"})
    EXPECT_EQ(with_id(good), "") << good;
  for (const char* bad : {"", ".", "acme.", ".Offset", "acme..Offset", "acme.2d", "acme/Offset",
                          "acme.Off-set", "acme.Of set", "\xc3\xa4.Offset"})
    EXPECT_NE(with_id(bad).find("is no name of a type"), std::string::npos) << bad;
  EXPECT_EQ(with_id(std::string(200, 'a')), "");
  EXPECT_NE(with_id(std::string(201, 'a')), "");
  // These are words of graph files and of the schemas.
  for (const char* word : {"loop", "artifact", "graph", "node", "parameter", "subgraph"})
    EXPECT_EQ(with_id(word),
              "node \"" + std::string(word) + "\": \"id\" is reserved; put a namespace in front of it");
  EXPECT_EQ(parse_type_declaration(R"({"id":"acme.Grid","version":1,"doc":""})").id, "acme.Grid");
  EXPECT_NE(type_problem(R"({"id":"acme.","version":1,"doc":""})"), "");
}

TEST(param, refuses_values_outside_its_kind_and_range) {
  ParamDecl number;
  number.kind = ParamKind::number;
  number.exclusive_maximum = 2;
  EXPECT_EQ(number.refuse(1.999), "");
  EXPECT_EQ(number.refuse(2), "must be less than 2, is 2");
  EXPECT_EQ(number.refuse(std::numeric_limits<double>::quiet_NaN()), "must be a finite number, is nan");
  EXPECT_EQ(number.refuse(-std::numeric_limits<double>::infinity()), "must be a finite number, is -inf");
  ParamDecl integer;
  integer.kind = ParamKind::integer;
  EXPECT_EQ(integer.refuse(std::numeric_limits<std::int64_t>::min()), "");
  EXPECT_EQ(integer.refuse(3.0), "");
  EXPECT_EQ(integer.refuse(1e300), "must be a whole number, is 1e+300");
  ParamDecl file;
  file.kind = ParamKind::file;
  EXPECT_EQ(file.refuse(""), "");
  EXPECT_EQ(file.refuse(std::string("a\0b", 3)), "must be the path of a file, contains a NUL character");
  file.required = true;
  EXPECT_EQ(file.refuse(""), "must be the path of a file, is empty");
}

TEST(registry, keeps_equal_declarations_and_refuses_different_ones) {
  Registry registry = test::toy_registry();
  NodeDeclaration again = *registry.node("Grow");
  again.plugin_path = "second.so";
  registry.add(again);
  EXPECT_EQ(registry.node("Grow")->plugin_path, "");
  again.params.at(0).maximum = 99;
  try {
    registry.add(again);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "node \"Grow\" is declared differently by this program (version 2) and by second.so (version 2)");
  }
  TypeDeclaration type = *registry.type("Balls");
  type.version = 2;
  EXPECT_THROW(registry.add(type), Error);
}

// The shape of an artifact against its declaration.

TypeDeclaration csr() {
  return parse_type_declaration(R"({"id":"Csr","version":1,"doc":"","arrays":[
    {"name":"centers","dtype":"f64","shape":["n",3],"doc":"c"},{"name":"offsets","dtype":"i64","shape":["n+1"],"doc":"o"},
    {"name":"weights","dtype":"f64","shape":["n"],"optional":true,"doc":"w"},{"name":"size","dtype":"f64","shape":[],"doc":"s"}],"summary":[]})");
}

std::string artifact_problem(const std::vector<NamedArray>& arrays, const std::string& type = "Csr") {
  static const std::vector<double> zeros(64, 0.0);
  std::vector<NamedArray> filled = arrays;
  for (NamedArray& array : filled) array.data = zeros.data();
  return check_artifact(csr(), *Artifact::seal(type, 1, filled, "{}", nullptr));
}

TEST(artifact_check, compares_arrays_with_the_declaration) {
  const NamedArray centers{"centers", BF_F64, {2, 3}, nullptr}, offsets{"offsets", BF_I64, {3}, nullptr},
      size{"size", BF_F64, {}, nullptr};
  EXPECT_EQ(artifact_problem({centers, offsets, size}), "");
  EXPECT_EQ(artifact_problem({centers, offsets, size, {"weights", BF_F64, {2}, nullptr}}), "");
  EXPECT_EQ(artifact_problem({{"centers", BF_F64, {0, 3}, nullptr}, {"offsets", BF_I64, {1}, nullptr}, size}),
            "");
  EXPECT_EQ(artifact_problem({centers, offsets, size}, "Balls"),
            "is a \"Balls\" version 1, must be a \"Csr\" version 1");
  EXPECT_EQ(artifact_problem({centers, size}), "has no array \"offsets\" (o)");
  EXPECT_EQ(artifact_problem({centers, size, {"offsets", BF_I32, {3}, nullptr}}),
            "array \"offsets\" holds i32, must hold i64");
  EXPECT_EQ(artifact_problem({offsets, size, {"centers", BF_F64, {2, 2}, nullptr}}),
            "array \"centers\" is 2 x 2, must be n x 3");
  EXPECT_EQ(artifact_problem({offsets, size, {"centers", BF_F64, {6}, nullptr}}),
            "array \"centers\" is 6, must be n x 3");
  EXPECT_EQ(artifact_problem({centers, offsets, {"size", BF_F64, {1}, nullptr}}),
            "array \"size\" is 1, must be one number");
  EXPECT_EQ(artifact_problem({centers, size, {"offsets", BF_I64, {2}, nullptr}}),
            "array \"offsets\" has length 2, must have 3 (n+1, n = 2 by array \"centers\")");
  EXPECT_EQ(artifact_problem({{"centers", BF_F64, {0, 3}, nullptr}, {"offsets", BF_I64, {0}, nullptr}, size}),
            "array \"offsets\" has length 0, must have n+1");
  EXPECT_EQ(artifact_problem({centers, offsets, size, {"weights", BF_F64, {3}, nullptr}}),
            "array \"weights\" has length 3, must have 2 (n, n = 2 by array \"centers\")");
  EXPECT_EQ(artifact_problem({centers, offsets, size, {"more", BF_F64, {3}, nullptr}}),
            "has an array \"more\" that type \"Csr\" does not declare");
}

TEST(artifact_check, runs_the_check_of_the_type) {
  static const bf_type entry = {
      sizeof(bf_type),
      0,
      {nullptr, 0},
      nullptr,
      [](void*, const bf_artifact* artifact, void* context, void (*found)(void*, bf_bytes)) {
        const std::string text = "saw " + std::to_string(artifact->array_count) + " arrays, length " +
                                 std::to_string(artifact->arrays[0].shape[0]);
        found(context, {text.data(), text.size()});
      },
      nullptr};
  TypeDeclaration type = parse_type_declaration(
      R"({"id":"T","version":1,"doc":"","arrays":[{"name":"a","dtype":"u8","shape":["n"]}],"summary":[]})");
  type.entry = &entry;
  const auto artifact = Artifact::seal("T", 1, {{"a", BF_U8, {5}, "12345"}}, "{}", nullptr);
  EXPECT_EQ(check_artifact(type, *artifact), "saw 1 arrays, length 5");
}

namespace {

/// A type whose summary is the length of its array, and whose check refuses more than five.
TypeDeclaration counted(const bf_type& entry) {
  TypeDeclaration type = parse_type_declaration(
      R"({"id":"T","version":3,"doc":"","arrays":[{"name":"a","dtype":"u8","shape":["n"]}],"summary":[]})");
  type.entry = &entry;
  return type;
}

bf_type counting_entry() {
  bf_type entry{};
  entry.struct_size = sizeof entry;
  entry.check = [](void*, const bf_artifact* artifact, void* context, void (*found)(void*, bf_bytes)) {
    if (artifact->arrays[0].shape[0] > 5) found(context, {"too many", 8});
  };
  entry.summarize = [](void*, const bf_artifact* artifact, void* context, void (*made)(void*, bf_bytes)) {
    const std::string text = R"({ "length": )" + std::to_string(artifact->arrays[0].shape[0]) + "}";
    made(context, {text.data(), text.size()});
  };
  return entry;
}

}  // namespace

TEST(make_artifact, has_the_summary_that_its_type_makes) {
  const bf_type entry = counting_entry();
  const auto made = make_artifact(counted(entry), {{"a", BF_U8, {5}, "12345"}}, nullptr);
  EXPECT_EQ(made->type(), "T");
  EXPECT_EQ(made->version(), 3);
  EXPECT_EQ(made->summary(), R"({"length":5})");
  EXPECT_EQ(made->digest(),
            Artifact::seal("T", 3, {{"a", BF_U8, {5}, "12345"}}, R"({"length":5})", nullptr)->digest());
}

TEST(make_artifact, has_no_summary_where_the_library_of_the_type_makes_none) {
  bf_type entry = counting_entry();
  entry.struct_size = BF_TYPE_MIN_SIZE;  // built before there were summaries: what follows is not there
  EXPECT_EQ(make_artifact(counted(entry), {{"a", BF_U8, {5}, "12345"}}, nullptr)->summary(), "{}");
  entry = counting_entry();
  entry.summarize = nullptr;
  EXPECT_EQ(make_artifact(counted(entry), {{"a", BF_U8, {5}, "12345"}}, nullptr)->summary(), "{}");
}

TEST(make_artifact, refuses_what_the_type_refuses) {
  const bf_type entry = counting_entry();
  EXPECT_THROW(make_artifact(counted(entry), {{"a", BF_U8, {6}, "123456"}}, nullptr), Error);
  EXPECT_THROW(make_artifact(counted(entry), {{"b", BF_U8, {5}, "12345"}}, nullptr), Error);
  EXPECT_THROW(make_artifact(counted(entry), {{"a", BF_F64, {0}, nullptr}}, nullptr), Error);
}

TEST(schema, documents_every_node_port_and_parameter) {
  const Registry registry = test::toy_registry();
  const Json schema = nodes_schema(registry);
  for (const auto& [id, node] : registry.nodes()) {
    const Json& properties = schema.at("definitions").at(id).at("properties");
    EXPECT_EQ(properties.at("type").at("const"), id);
    EXPECT_EQ(properties.at("inputs").at("properties").size(), node.inputs.size());
    EXPECT_EQ(properties.at("params").at("properties").size(), node.params.size());
  }
  const Json& epsilon =
      schema.at("definitions").at("Grow").at("properties").at("params").at("properties").at("epsilon");
  EXPECT_EQ(epsilon.at("default"), 0.5);
  EXPECT_EQ(epsilon.at("description"), "growth Unit: %.");
  EXPECT_EQ(epsilon.at("anyOf").at(0).at("maximum"), 100.0);
}

/// Runs Python's jsonschema, an implementation that knows nothing of ours; skips where it is absent.
TEST(schema, accepts_and_refuses_what_the_engine_does) {
  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3 with jsonschema is not installed";
  const Registry registry = test::toy_registry();
  const auto graph = [](const std::string& nodes) {
    return R"({"nodes":{"l":{"type":"Load","params":{"file":"x"}},)" + nodes +
           R"(},"outputs":{"p":"l.points"}})";
  };
  const auto sweep = [](const std::string& section) {
    return R"({"sweep":)" + section +
           R"(,"nodes":{"l":{"type":"Load","params":{"file":"x"}}},"outputs":{"p":"l.points"}})";
  };
  const std::vector<std::string> texts = {
      R"({"$schema":"x","doc":"d","params":{"e":{"kind":"number","default":1},"c":{"kind":"choice","default":"fast","choices":["fast",{"value":"exact","doc":""}]}},
          "nodes":{"l":{"type":"Load","params":{"file":"a${e}","scale":"${e}","mode":"${c}"}}},"outputs":{"p":{"from":"l.points","doc":"d"}}})",
      graph(
          R"("g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"epsilon":100,"steps":10,"closed":true,"label":""}})"),
      graph(R"("g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"epsilon":100.5}})"),
      graph(R"("g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"steps":2.5}})"),
      graph(R"("g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"step":2}})"),
      graph(R"("g":{"type":"Grow","inputs":{"points":"l.points"},"params":{"closed":"yes"}})"),
      graph(R"("g":{"type":"Grow","inputs":{"point":"l.points"}})"),
      graph(R"("g":{"type":"Grow"})"),
      graph(R"("g":{"type":"Groww","inputs":{"points":"l.points"}})"),
      graph(R"("g":{"typ":"Grow","inputs":{"points":"l.points"}})"),
      graph(R"("g":{"type":"Load","params":{"file":"x","mode":"slow"}})"),
      graph(R"("g":{"type":"Load","params":{"file":"x","scale":0}})"),
      graph(R"("g":{"type":"Load","params":{"file":""}})"),
      graph(R"("g":{"type":"Load"})"),
      graph(R"("g h":{"type":"Load","params":{"file":"x"}})"),
      graph(R"("inputs":{"type":"Load","params":{"file":"x"}})"),
      graph(R"("g":{"type":"Load","graph":"x.json"})"),
      sweep(R"({"axes":{"l.scale":[1,2]},"mode":"zip","exclude":[{"l.scale":1}]})"),
      sweep(R"({"axes":{"l.scale":[1,2]},"mode":"zipp"})"),
      sweep(R"({"axes":{"l.scale":[]}})"),
      sweep(R"({"axes":{"l.scale":1}})"),
      sweep(R"({"axes":{"l.scale":[[1]]}})"),
      sweep(R"({"axes":{"l.scale":[1,1]}})"),
      sweep(R"({"axes":{"l.scale":[1]},"exclude":[{}]})"),
      sweep(R"({"axis":{"l.scale":[1]}})"),
      sweep(R"({})"),
      R"({"params":{"f":{"kind":"file"}},"map":{"f":["a","b"]},"nodes":{}})",
      R"({"params":{"f":{"kind":"file"}},"map":{"f":"a"},"nodes":{}})",
      R"({"params":{"f":{"kind":"file","default":"x"}},"map":{"f":1},"nodes":{}})",
      R"({"node":{}})",
      R"({"nodes":{},"params":{"a":{"kind":"reel","default":1}}})",
      R"({"nodes":{},"params":{"a":{"kind":"choice","default":"x","choices":[]}}})"};
  const test::TempFolder folder;
  test::write_file(folder.file("schema.json"), graph_schema(registry).dump());
  Json expected = Json::array();
  for (const std::string& text : texts) {
    bool accepted = true;
    try {
      parse_graph(text, "g.json", registry);
    } catch (const GraphError&) {
      accepted = false;
    }
    expected.push_back({{"graph", Json::parse(text)}, {"accepted", accepted}});
  }
  EXPECT_TRUE(expected.at(0).at("accepted").get<bool>() && expected.at(1).at("accepted").get<bool>());
  test::write_file(folder.file("graphs.json"), expected.dump());
  test::write_file(folder.file("compare.py"), R"(
import json, sys
import jsonschema
schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
wrong = [case for case in json.load(open(sys.argv[2])) if validator.is_valid(case["graph"]) != case["accepted"]]
for case in wrong: print(json.dumps(case))
sys.exit(1 if wrong else 0)
)");
  const std::string command = "python3 " + folder.file("compare.py") + " " + folder.file("schema.json") +
                              " " + folder.file("graphs.json");
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(examples, are_the_first_uses_in_the_graphs_of_a_folder_and_in_what_they_can_include) {
  const Registry registry = test::toy_registry();
  const test::TempFolder folder;
  test::write_file(folder.file("b.json"), R"({ // comments are fine
    "params": { "how": { "kind": "string", "default": "none" } },
    "nodes": { "load": { "type": "Load", "params": { "file": "x" } },
               "part": { "graph": "parts/${how}.json", "inputs": { "points": "load.points" } } },
    "outputs": { "balls": "part.balls" } })");
  test::write_file(folder.file("a.json"), R"({ "nodes": { "other": { "type": "Absent" } } })");
  test::write_file(folder.file("parts/none.json"), R"({ "inputs": { "points": { "type": "Points" } },
    "nodes": { "small": { "type": "Grow", "inputs": { "points": "inputs.points" }, "params": { "epsilon": 0 } } },
    "outputs": { "balls": "small.balls" } })");
  test::write_file(folder.file("parts/much.json"), R"({ "inputs": { "points": { "type": "Points" } },
    "nodes": { "g": { "type": "Grow", "inputs": { "points": "inputs.points" } },
               "m": { "type": "Match", "inputs": { "points": "inputs.points", "balls": "g.balls" } } },
    "outputs": { "balls": "m.rest" } })");
  const auto examples = find_examples(folder.path(), registry);
  ASSERT_EQ(examples.size(), 3u);
  EXPECT_EQ(examples.at("Load").file, "b.json");
  EXPECT_EQ(examples.at("Load").entry.begin().key(), "load");
  EXPECT_EQ(examples.at("Grow").file, "parts/none.json");
  EXPECT_EQ(examples.at("Grow").entry.at("small").at("params").at("epsilon"), 0);
  EXPECT_TRUE(examples.at("Grow").settings.empty());
  EXPECT_EQ(examples.at("Match").graph, "b.json");
  EXPECT_EQ(examples.at("Match").file, "parts/much.json");
  ASSERT_EQ(examples.at("Match").settings.size(), 1u);
  EXPECT_EQ(examples.at("Match").settings[0].value, "much");
  EXPECT_TRUE(find_examples(folder.file("nowhere"), registry).empty());
}

TEST(markdown, shows_a_node_completely) {
  const Registry registry = test::toy_registry();
  EXPECT_EQ(node_markdown(*registry.node("Load")),
            "### Load\n\nRead points.\n\n| output | type | meaning |\n|---|---|---|\n| `points` | Points | n "
            "points |\n\n"
            "| parameter | kind | default | range | unit | meaning |\n|---|---|---|---|---|---|\n"
            "| `file` | file | required |  |  | the file to read |\n"
            "| `scale` | number | `1.0` | > 0 | 1 | factor |\n"
            "| `mode` | choice | `\"fast\"` | `fast`, `exact` |  | how |\n\n"
            "Choices of `mode`:\n\n- `fast`: quick\n- `exact`: slow\n\n"
            "```json\n{\n  \"node\": {\n    \"type\": \"Load\",\n    \"params\": {\n      \"file\": "
            "\"${file}\",\n      \"scale\": 1.0,\n      \"mode\": \"fast\"\n    }\n  }\n}\n```\n\n"
            "Behaviour version 1.\n");
  const NodeExample example = {
      "top.json", "parts/load.json", {{"part", "load"}}, {{"scan", {{"type", "Load"}}}}};
  EXPECT_NE(
      node_markdown(*registry.node("Load"), &example)
          .find("```json\n{\n  \"scan\": {\n    \"type\": \"Load\"\n  }\n}\n```\n\n"
                "From [parts/load.json](../graphs/parts/load.json); `ballflow run graphs/top.json --set "
                "part=load` runs it.\n"),
      std::string::npos);
  const std::string all = nodes_markdown(registry);
  for (const auto& [id, node] : registry.nodes())
    EXPECT_NE(all.find("\n### " + id + "\n"), std::string::npos);
  for (const auto& [id, type] : registry.types())
    EXPECT_NE(all.find("\n### " + id + "\n"), std::string::npos);
}

}  // namespace
}  // namespace ballflow
