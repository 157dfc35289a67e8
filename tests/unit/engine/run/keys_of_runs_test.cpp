// What enters the key of a node, and what does not.
#include <gtest/gtest.h>

#include <bit>

#include "ballflow/report.hpp"
#include "ballflow/run.hpp"
#include "run_fixture.hpp"

namespace ballflow {
namespace {

struct KeyTest : RunTest {
  Digest key(const DagNode& n, const std::map<std::string, OutputEntry>& inputs = {},
             std::uint64_t seed = 0) {
    return action_key(n, inputs, seed, *store()).key;
  }
};

TEST_F(KeyTest, names_and_seeds_of_nodes_without_randomness_do_not_enter) {
  Dag dag;
  node(dag, "a", "Source");
  node(dag, "other/name", "Source");
  EXPECT_EQ(key(dag.nodes[0]), key(dag.nodes[1]));
  EXPECT_EQ(key(dag.nodes[0], {}, 1), key(dag.nodes[0], {}, 2));
}

TEST_F(KeyTest, every_field_of_the_manifest_changes_the_key_and_is_named) {
  Dag dag;
  node(dag, "a", "Source");
  OutputEntry input{"a", "Numbers", 1, sha256("x"), 1, {}, "{}"};
  NodeDeclaration decl = *dag.nodes[0].kind.declared();
  decl.libraries["CGAL"] = "5.5.1";
  decl.uses_seed = true;
  dag.nodes[0].kind = decl;
  const ActionKey base = action_key(dag.nodes[0], {{"a", input}}, 0, *store());
  const auto expect_change = [&](const DagNode& n, const OutputEntry& in, std::uint64_t seed,
                                 const std::string& named) {
    const ActionKey other = action_key(n, {{"a", in}}, seed, *store());
    EXPECT_NE(other.key, base.key) << named;
    const auto differences = manifest_differences(base.manifest, other.manifest);
    ASSERT_EQ(differences.size(), 1u) << named;
    EXPECT_NE(differences[0].find(named), std::string::npos) << differences[0];
  };
  DagNode changed = dag.nodes[0];
  changed.params["value"] = 2.0;
  expect_change(changed, input, 0, "params.value");
  changed = dag.nodes[0];
  changed.params["count"] = 4;
  expect_change(changed, input, 0, "params.count");
  NodeDeclaration other = decl;
  other.version = 2;
  changed = dag.nodes[0];
  changed.kind = other;
  expect_change(changed, input, 0, "Source version 1 -> 2");
  other = decl;
  other.libraries["CGAL"] = "5.6";
  expect_change(changed, input, 0, "library CGAL");
  other = decl;
  other.id = "Other";
  expect_change(changed, input, 0, "node");
  OutputEntry in = input;
  in.digest = sha256("y");
  expect_change(dag.nodes[0], in, 0, "input a");
  in = input;
  in.type_version = 2;
  expect_change(dag.nodes[0], in, 0, "input a: type version 1 -> 2");
  in = input;
  in.type = "Letters";
  expect_change(dag.nodes[0], in, 0, "input a: type");
  expect_change(dag.nodes[0], input, 5, "seed");
}

/// The bytes that key.hpp promises for a manifest, from its text alone.
std::string hashed_bytes(const nlohmann::json& value) {
  const auto u64 = [](std::uint64_t n) {
    std::string bytes;
    for (int i = 0; i < 8; ++i, n >>= 8) bytes += static_cast<char>(n & 255);
    return bytes;
  };
  if (value.is_null()) return "n";
  if (value.is_boolean()) return value.get<bool>() ? "t" : "f";
  if (value.is_number_integer()) return "i" + u64(static_cast<std::uint64_t>(value.get<std::int64_t>()));
  if (value.is_number_float()) return "d" + u64(std::bit_cast<std::uint64_t>(value.get<double>() + 0.0));
  if (value.is_string()) return "s" + u64(value.get<std::string>().size()) + value.get<std::string>();
  std::string bytes = "o" + u64(value.size());
  for (const auto& [name, member] : value.items()) bytes += u64(name.size()) + name + hashed_bytes(member);
  return bytes;
}

TEST_F(KeyTest, the_key_is_the_hash_of_its_manifest) {
  Dag dag = diamond(1.5, 2);
  dag.nodes[0].params["value"] = -0.0;
  std::map<std::string, OutputEntry> inputs;
  inputs["b"] = {"sum", "Numbers", 3, sha256("b"), 10, {}, "{}"};
  inputs["a"] = {"sum", "Numbers", 1, sha256("a"), 10, {}, "{}"};
  NodeDeclaration strange = *dag.nodes[3].kind.declared();
  strange.uses_seed = true;
  strange.libraries = {{"CGAL", "5.5 \"odd\" caf\xc3\xa9"}, {"A", "1"}};
  dag.nodes[3].kind = strange;
  for (const DagNode& n : dag.nodes) {
    const ActionKey made = action_key(n, inputs, 1234567890123456789u, *store());
    EXPECT_EQ(made.key, sha256(hashed_bytes(nlohmann::json::parse(made.manifest)))) << made.manifest;
    EXPECT_EQ(Json::parse(made.manifest).dump(), made.manifest);
  }
}

TEST_F(KeyTest, threads_memory_and_earlier_attempts_do_not_enter_and_neither_does_the_host) {
  const Dag dag = diamond(1.5, 2);
  const auto run_with = [&](unsigned threads, std::uint64_t memory, const std::shared_ptr<Store>& where) {
    RunOptions options;
    options.threads = threads;
    options.memory_bytes = memory;
    Runner runner(dag, registry, where, options, events);
    return runner.run();
  };
  const RunResult first = run_with(1, std::uint64_t{1} << 30, store());
  const RunResult again = run_with(3, std::uint64_t{5} << 30, store());
  EXPECT_EQ(statuses(again), std::vector<NodeStatus>(dag.nodes.size(), hit));
  const std::set<std::string> fields{"format", "node", "version", "libraries", "params", "seed", "inputs"};
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    EXPECT_EQ(first.nodes[i].manifest, again.nodes[i].manifest);
    std::set<std::string> found;
    const Json manifest = Json::parse(first.nodes[i].manifest);
    for (const auto& [name, value] : manifest.items()) found.insert(name);
    EXPECT_EQ(found, fields) << "what enters is said above, and nothing else does";
  }
}

TEST_F(KeyTest, minus_zero_is_zero_and_whole_numbers_equal_themselves) {
  Dag dag;
  node(dag, "a", "Source", {}, {{"value", 0.0}});
  node(dag, "b", "Source", {}, {{"value", -0.0}});
  node(dag, "c", "Source", {}, {{"value", 0}});
  EXPECT_EQ(key(dag.nodes[0]), key(dag.nodes[1]));
  EXPECT_EQ(key(dag.nodes[0]), key(dag.nodes[2]));
}

TEST_F(KeyTest, a_file_enters_by_content_and_format_not_by_path) {
  Dag dag;
  node(dag, "a", "Source");
  NodeDeclaration decl = *dag.nodes[0].kind.declared();
  ParamDecl file;
  file.name = "file";
  file.kind = ParamKind::file;
  file.schemes = {"shape:"};
  decl.params.push_back(file);
  dag.nodes[0].kind = decl;
  const auto with = [&](const std::string& path) {
    DagNode n = dag.nodes[0];
    n.params["file"] = path;
    return key(n);
  };
  test::write_file(folder.file("one.off"), "content");
  test::write_file(folder.file("dir/two.off"), "content");
  test::write_file(folder.file("three.ply"), "content");
  test::write_file(folder.file("four.off"), "other content");
  EXPECT_EQ(with(folder.file("one.off")), with(folder.file("dir/two.off")));
  EXPECT_NE(with(folder.file("one.off")), with(folder.file("three.ply")));
  EXPECT_NE(with(folder.file("one.off")), with(folder.file("four.off")));
  EXPECT_NE(with("shape:torus"), with("shape:sphere"));
  EXPECT_THROW(with(folder.file("absent.off")), Error);
}

}  // namespace
}  // namespace ballflow
