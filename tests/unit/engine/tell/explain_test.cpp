// What a key depends on, and how differences are told.
#include "ballflow/explain.hpp"

#include <gtest/gtest.h>

#include <list>

#include "ballflow/report.hpp"
#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

class Silent final : public EventSink {
 public:
  void on(const Event&) override {}
};

using State = Explanation::Input::State;
using Lines = std::vector<std::string>;

struct ExplainTest : testing::Test {
  ExplainTest() {
    registry.add_plugin(toy::plugin(), "toy");
    toy::reset();
    test::write_file(folder.file("body.json"), R"({
      "params": { "by": { "kind": "number", "default": 1 } },
      "inputs": { "n": { "type": "Numbers" }, "one": { "type": "Numbers" } },
      "nodes": { "step": { "type": "Step", "inputs": { "numbers": "inputs.n" }, "params": { "by": "${by}" } },
                 "add": { "type": "Add", "inputs": { "a": "step.numbers", "b": "inputs.one" } } },
      "outputs": { "n": "add.sum" } })");
  }

  /// source -> round -> sum(round, other) -> loop -> last
  Dag graph(const std::vector<Setting>& settings = {}) {
    return parse_graph(R"({ "nodes": {
        "source": { "type": "Source", "params": { "value": 1.5 } },
        "other": { "type": "Source", "params": { "value": 2 } },
        "round": { "type": "Round", "inputs": { "numbers": "source.numbers" } },
        "sum": { "type": "Add", "inputs": { "a": "round.rounded", "b": "other.numbers" } },
        "loop": { "loop": "body.json", "inputs": { "n": "sum.sum", "one": "other.numbers" }, "until": "n.first >= 9" },
        "last": { "type": "Round", "inputs": { "numbers": "loop.n" } } },
      "outputs": { "n": "last.rounded" } })",
                       folder.file("graph.json"), registry, settings);
  }
  /// Runs, and reads the records back as a command does.
  NodeRecords run(const Dag& dag) {
    Runner runner(dag, registry, store, {}, events);
    const RunResult& result = runner.run();
    EXPECT_EQ(result.status, ExitCode::ok);
    Manifests manifests;
    for (std::size_t i = 0; i < dag.nodes.size(); ++i)
      manifests[dag.nodes[i].path] = result.nodes[i].manifest;
    return records_of(nlohmann::json::parse(run_report("id", dag, result).dump()), manifests);
  }
  NodeRecords planned(const Dag& dag) { return records_of(dag, plan(dag, *store, 0, {})); }

  static Lines causes(const Explanation& explanation) {
    Lines lines;
    for (const Explanation::Cause& cause : explanation.causes) {
      std::string line = cause.path + ":";
      for (const std::string& difference : cause.differences) line += " " + difference;
      lines.push_back(line);
    }
    return lines;
  }
  static std::map<std::string, State> states(const Explanation& explanation) {
    std::map<std::string, State> result;
    for (const Explanation::Input& input : explanation.inputs) result[input.port] = input.state;
    return result;
  }

  std::list<NodeDeclaration> declarations;  // changed ones
  Registry registry;
  test::TempFolder folder;
  std::shared_ptr<Store> store = Store::open({folder.file("cache"), false});
  Silent events;
};

TEST_F(ExplainTest, an_unchanged_graph_has_the_same_keys_everywhere) {
  const NodeRecords before = run(graph());
  const NodeRecords again = run(graph()), next = planned(graph());
  for (const char* path : {"source", "round", "sum", "loop", "last", "loop/step", "loop/add"}) {
    EXPECT_TRUE(explain(before, again, path).same()) << path;
    EXPECT_TRUE(explain(before, next, path).same()) << path;
  }
}

TEST_F(ExplainTest, names_the_fields_of_the_node_and_its_inputs_with_the_same_content) {
  const NodeRecords before = run(graph());
  const Explanation changed = explain(before, run(graph({{"source.count", "4"}})), "source");
  EXPECT_EQ(changed.type, "Source");
  EXPECT_EQ(changed.differences, Lines{"params.count 3 -> 4"});
  EXPECT_TRUE(changed.inputs.empty());
  EXPECT_FALSE(changed.same());
  const Explanation loop = explain(before, run(graph({{"loop.max_iterations", "77"}})), "loop");
  EXPECT_EQ(loop.differences, Lines{"params.max_iterations 10000 -> 77"});
  EXPECT_EQ(states(loop), (std::map<std::string, State>{{"n", State::same}, {"one", State::same}}));
  EXPECT_TRUE(loop.causes.empty());
}

TEST_F(ExplainTest, leads_from_other_content_to_the_node_that_changed) {
  const NodeRecords before = run(graph());
  const Dag dag = graph({{"source.value", "3.5"}});
  const NodeRecords next = planned(dag);  // before it has run: what follows is not known
  const Explanation waits = explain(before, next, "sum");
  EXPECT_EQ(states(waits), (std::map<std::string, State>{{"a", State::unknown}, {"b", State::same}}));
  EXPECT_EQ(causes(waits), Lines{"source: params.value 1.5 -> 3.5"});
  const NodeRecords now = run(dag);
  const Explanation sum = explain(before, now, "sum");
  EXPECT_TRUE(sum.differences.empty());
  EXPECT_EQ(states(sum), (std::map<std::string, State>{{"a", State::other}, {"b", State::same}}));
  EXPECT_EQ(sum.inputs.at(0).from, "round.rounded");
  EXPECT_EQ(causes(sum), Lines{"source: params.value 1.5 -> 3.5"});
  EXPECT_EQ(causes(explain(before, now, "last")), Lines{"source: params.value 1.5 -> 3.5"});
}

TEST_F(ExplainTest, a_change_that_gives_the_same_content_is_no_cause) {
  const NodeRecords before = run(graph());
  const NodeRecords now = run(graph({{"source.value", "1.25"}}));  // rounds to 1 like 1.5
  EXPECT_EQ(explain(before, now, "source").differences, Lines{"params.value 1.5 -> 1.25"});
  EXPECT_EQ(states(explain(before, now, "round")), (std::map<std::string, State>{{"numbers", State::other}}));
  EXPECT_TRUE(explain(before, now, "sum").same());
}

TEST_F(ExplainTest, several_causes_are_all_named_the_nearest_first) {
  const NodeRecords before = run(graph());
  const NodeRecords now = run(graph({{"source.value", "7"}, {"loop.by", "3"}, {"other.value", "5"}}));
  EXPECT_EQ(causes(explain(before, now, "last")),
            (Lines{"loop: body.nodes.0:Step.params.by 1.0 -> 3.0", "other: params.value 2.0 -> 5.0",
                   "source: params.value 1.5 -> 7.0"}));
}

TEST_F(ExplainTest, nodes_in_the_body_of_a_loop_are_explained_as_parts_of_it) {
  const NodeRecords before = run(graph());
  const NodeRecords now = run(graph({{"loop/step.by", "2"}, {"other.value", "3"}}));
  const Explanation step = explain(before, now, "loop/step");
  EXPECT_EQ(step.type, "Step");
  EXPECT_EQ(step.differences, Lines{"params.by 1.0 -> 2.0"});
  EXPECT_EQ(states(step), (std::map<std::string, State>{{"numbers", State::other}}));
  EXPECT_EQ(step.inputs.at(0).from, "loop.n");
  EXPECT_EQ(causes(step), Lines{"other: params.value 2.0 -> 3.0"});
  const Explanation add = explain(before, now, "loop/add");
  EXPECT_TRUE(add.differences.empty());
  EXPECT_EQ(states(add), (std::map<std::string, State>{{"a", State::same}, {"b", State::other}}));
  EXPECT_EQ(add.inputs.at(0).from, "loop/step.numbers");
}

TEST_F(ExplainTest, nodes_that_are_new_or_unknown_are_said_to_be_so) {
  const NodeRecords before = run(graph());
  NodeRecords now = before;
  now["added"] = now.at("round");
  EXPECT_FALSE(explain(before, now, "added").ran_before);
  EXPECT_FALSE(explain(before, now, "added").same());
  try {
    explain(before, now, "loop/stop");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_STREQ(error.what(), "there is no node \"loop/stop\"");
    EXPECT_EQ(error.hint(), "did you mean \"loop/step\"?");
  }
  now.at("sum").manifest.clear();
  EXPECT_THROW(explain(before, now, "sum"), Error);
}

TEST_F(ExplainTest, another_version_of_a_type_inside_a_loop_is_another_key_and_is_named) {
  // As when the layout of a type changes that only nodes of the body exchange.
  const Dag dag = graph();
  Dag other = graph();
  for (DagNode& node : other.nodes) {
    if (node.path != "loop") continue;
    auto loop = std::make_shared<Loop>(*node.kind.loop());
    for (DagNode& inner : loop->body.nodes) {
      declarations.push_back(*inner.kind.declared());
      NodeDeclaration& decl = declarations.back();
      for (PortDecl& port : decl.id == "Step" ? decl.outputs : decl.inputs) {
        if (decl.id == "Step" || port.name == "a") port.type_version = 2;
      }
      inner.kind = decl;
    }
    node.kind = std::shared_ptr<const Loop>(std::move(loop));
  }
  EXPECT_NE(action_key(*dag.find("loop"), {}, 0, *store).key,
            action_key(*other.find("loop"), {}, 0, *store).key);
  const NodeRecords before = planned(dag), now = planned(other);
  EXPECT_EQ(explain(before, now, "loop/step").differences, Lines{"output numbers: type version 1 -> 2"});
  EXPECT_EQ(explain(before, now, "loop/add").differences, Lines{"input a: type version 1 -> 2"});
  EXPECT_EQ(explain(before, now, "loop").differences.size(), 2u);
}

/// Every leaf of a manifest, by its path: (path, pointer).
void leaves(const Json& json, const std::string& path, const Json::json_pointer& pointer,
            std::vector<std::pair<std::string, Json::json_pointer>>& out) {
  if (!json.is_object()) return out.emplace_back(path, pointer), void();
  for (const auto& [name, value] : json.items())
    leaves(value, path.empty() ? name : path + "." + name, pointer / name, out);
}

struct KeyMutationTest : ExplainTest {
  /// Changes every field of the manifest once, and takes every field away once.
  void expect_every_field_counts(const ActionKey& key) {
    EXPECT_EQ(key_of(key.manifest), key.key) << "the text says everything that was hashed";
    const Json manifest = Json::parse(key.manifest);
    std::vector<std::pair<std::string, Json::json_pointer>> all;
    leaves(manifest, "", Json::json_pointer(), all);
    std::map<Digest, std::string> keys = {{key.key, "nothing"}};
    for (const auto& [path, pointer] : all) {
      Json changed = manifest;
      Json& leaf = changed[pointer];
      if (leaf.is_string()) {
        leaf = leaf.get<std::string>() + "x";
      } else if (leaf.is_boolean()) {
        leaf = !leaf.get<bool>();
      } else if (leaf.is_number_float()) {
        leaf = leaf.get<double>() + 0.125;
      } else if (leaf.is_number()) {
        leaf = leaf.get<std::int64_t>() + 1;
      } else {
        leaf = 7;  // null (no seed), an empty object
      }
      const auto [place, fresh] = keys.emplace(key_of(changed.dump()), path);
      EXPECT_TRUE(fresh) << path << " gives the same key as " << place->second;
      const Lines named = manifest_differences(key.manifest, changed.dump());
      ASSERT_EQ(named.size(), 1u) << path;
      const std::string last = path.substr(path.rfind('.') + 1);
      const std::string word = last == "digest"                   ? "other content"
                               : path == "node"                   ? "node type"
                               : path == "format"                 ? "key format"
                               : path == "version"                ? "version"
                               : path.rfind("libraries.", 0) == 0 ? "library " + last
                               : path.rfind("files.", 0) == 0     ? "file " + last
                               : path.rfind("inputs.", 0) == 0    ? "input "
                                                                  : path;
      EXPECT_NE(named[0].find(word), std::string::npos) << path << ": " << named[0];

      Json missing = manifest;
      missing[pointer.parent_pointer()].erase(pointer.back());
      EXPECT_TRUE(keys.emplace(key_of(missing.dump()), path + " taken away").second) << path;
      EXPECT_EQ(manifest_differences(key.manifest, missing.dump()).size(), 1u) << path;
    }
    EXPECT_GE(all.size(), 6u);
  }
  static OutputEntry entry(const std::string& port, const std::string& content) {
    return {port, "Numbers", 1, sha256(content), 8, {}, "{}"};
  }
};

TEST_F(KeyMutationTest, every_field_of_every_toy_manifest_counts_and_is_named) {
  test::write_file(folder.file("data.txt"), "1");
  for (const auto& [id, registered] : registry.nodes()) {
    SCOPED_TRACE(id);
    NodeDeclaration decl = registered;
    decl.libraries = {{"CGAL", "5.5"}, {"lp_solve", "5.5.2"}};
    decl.uses_seed = true;
    DagNode node{id, decl};
    for (const ParamDecl& param : decl.params)
      node.params[param.name] =
          param.kind == ParamKind::file ? Json(folder.file("data.txt")) : param.default_value;
    std::map<std::string, OutputEntry> inputs;
    for (const PortDecl& port : decl.inputs) inputs[port.name] = entry(port.name, port.name);
    expect_every_field_counts(action_key(node, inputs, 5, *store));
  }
}

TEST_F(KeyMutationTest, every_field_of_a_loop_counts_and_is_named) {
  const Dag dag = graph();
  expect_every_field_counts(
      action_key(*dag.find("loop"), {{"n", entry("n", "a")}, {"one", entry("one", "b")}}, 0, *store));
}

TEST_F(KeyMutationTest, differences_are_told_in_words) {
  const std::string before =
      R"({"format":1,"node":"Enlarge","version":1,"libraries":{"CGAL":"5.5"},"params":{"epsilon":0.3,
          "file":{"file":{"digest":"a","format":"off"}}},"seed":null,
          "inputs":{"balls":{"type":"Balls","version":1,"digest":"a"}}})";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string now = before;
    now.replace(now.find(from), from.size(), to);
    const Lines lines = manifest_differences(before, now);
    return lines.size() == 1 ? lines[0] : std::to_string(lines.size()) + " differences";
  };
  EXPECT_EQ(with("0.3", "0.5"), "params.epsilon 0.3 -> 0.5");
  EXPECT_EQ(with("\"version\":1,\"lib", "\"version\":2,\"lib"), "Enlarge version 1 -> 2");
  EXPECT_EQ(with("\"5.5\"", "\"5.6\""), "library CGAL \"5.5\" -> \"5.6\"");
  EXPECT_EQ(with("null", "4"), "seed null -> 4");
  EXPECT_EQ(with("\"version\":1,\"digest\":\"a\"", "\"version\":1,\"digest\":\"b\""),
            "input balls: other content");
  EXPECT_EQ(with("\"type\":\"Balls\",\"version\":1", "\"type\":\"Balls\",\"version\":2"),
            "input balls: type version 1 -> 2");
  EXPECT_EQ(with("{\"digest\":\"a\"", "{\"digest\":\"b\""), "params.file: other content");
  EXPECT_EQ(with("\"off\"", "\"ply\""), "params.file.file.format \"off\" -> \"ply\"");
  EXPECT_EQ(with("0.3", "1"), "params.epsilon 0.3 -> 1");
  EXPECT_EQ(manifest_differences("nonsense", before), Lines{"the record of the earlier run cannot be read"});
}

TEST_F(KeyMutationTest, what_is_no_part_of_the_result_is_no_part_of_the_key) {
  const auto keys = [&](const Dag& dag) {
    std::map<std::string, std::string> result;
    for (const auto& [path, record] : run(dag)) result[path.substr(path.rfind('/') + 1)] = record.manifest;
    return result;
  };
  const auto expected = keys(graph());
  // Comments, order, another file in another folder, another doc, nodes with other names.
  test::write_file(folder.file("elsewhere/body.json"),
                   R"(/* c */ { "outputs": { "n": "z_add.sum" }, "doc": "other",
      "nodes": { "z_add": { "inputs": { "b": "inputs.one", "a": "zz_step.numbers" }, "type": "Add" }, // c
                 "zz_step": { "params": { "by": "${by}" }, "type": "Step", "inputs": { "numbers": "inputs.n" } } },
      "inputs": { "one": { "type": "Numbers", "doc": "d" }, "n": { "type": "Numbers" } },
      "params": { "by": { "default": 1.0, "kind": "number" } } })");
  const Dag other = parse_graph(R"({ // c
      "outputs": { "renamed": "last.rounded" },
      "nodes": {
        "last": { "inputs": { "numbers": "loop.n" }, "type": "Round", "doc": "d" },
        "loop": { "until": "n.first >= 9", "inputs": { "one": "second.numbers", "n": "sum.sum" }, "loop": "body.json" },
        "sum": { "inputs": { "b": "second.numbers", "a": "round.rounded" }, "type": "Add" },
        "round": { "type": "Round", "inputs": { "numbers": "source.numbers" } },
        "second": { "params": { "count": 3, "value": 2.0 }, "type": "Source" },
        "source": { "type": "Source", "params": { "value": 15e-1 } } } })",
                                folder.file("elsewhere/graph.json"), registry);
  auto found = keys(other);
  found["other"] = found.at("second");
  found.erase("second");
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace ballflow
