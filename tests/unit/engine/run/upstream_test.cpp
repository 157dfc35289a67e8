// Runs on two machines that share nothing but a folder.
#include <filesystem>

#include "run_fixture.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct UpstreamRunTest : RunTest {
  UpstreamRunTest() { fs::create_directory(shared); }

  std::shared_ptr<Store> machine(const std::string& name, UpstreamUse use = {}) {
    use.upstream = Upstream::open(shared);
    StoreOptions options;
    options.root = folder.file(name);
    options.upstream = use;
    return Store::open(options);
  }
  static std::string digest_of(const RunResult& result) {
    return result.nodes.back().outputs.at(0).digest.hex();
  }

  const std::string shared = folder.file("shared");
};

TEST_F(UpstreamRunTest, another_machine_runs_nothing) {
  const Dag dag = diamond(1.5, 2);
  const RunResult first = run(dag, machine("a"));
  EXPECT_EQ(statuses(first), (std::vector<NodeStatus>{ran, ran, ran, ran}));
  toy::reset();
  const auto b = machine("b");
  const RunResult second = run(dag, b);
  EXPECT_EQ(statuses(second), (std::vector<NodeStatus>{hit, hit, hit, hit}));
  EXPECT_EQ(toy::counters.add + toy::counters.source + toy::counters.round, 0);
  EXPECT_EQ(digest_of(first), digest_of(second));
  for (const NodePlan& node : plan(dag, *b, 0, {})) EXPECT_EQ(node.verdict, NodePlan::Verdict::hit);
}

TEST_F(UpstreamRunTest, what_only_the_upstream_has_is_read_by_what_runs_here) {
  run(diamond(1.5, 2), machine("a"));
  toy::reset();
  const RunResult result = run(diamond(1.75, 2), machine("b"));  // rounds to the same
  EXPECT_EQ(statuses(result), (std::vector<NodeStatus>{ran, hit, ran, hit}));
  const RunResult other = run(diamond(2.5, 2), machine("c"));
  EXPECT_EQ(statuses(other), (std::vector<NodeStatus>{ran, hit, ran, ran}));
  EXPECT_EQ(events.read.count("other.numbers"), 1u);
}

TEST_F(UpstreamRunTest, a_damaged_blob_is_computed_again_with_the_same_result) {
  const RunResult first = run(diamond(1.5, 2), machine("a"));
  std::size_t damaged = 0;
  for (const auto& file : fs::recursive_directory_iterator(shared + "/cas")) {
    if (!file.is_regular_file()) continue;
    fs::permissions(file.path(), fs::perms::owner_write, fs::perm_options::add);
    std::string bytes = test::read_file(file.path().string());
    bytes.back() = static_cast<char>(bytes.back() ^ 16);
    test::write_file(file.path().string(), bytes);
    ++damaged;
  }
  EXPECT_GT(damaged, 0u);
  const auto b = machine("b");
  Dag dag = diamond(1.5, 2);
  Runner runner(dag, registry, b, {}, events);
  const RunResult second = runner.run();
  EXPECT_EQ(second.status, ExitCode::ok);
  EXPECT_EQ(digest_of(first), digest_of(second));
  EXPECT_EQ(runner.artifact(dag.outputs[0].from)->digest().hex(), digest_of(first));
  EXPECT_FALSE(b->upstream_notes().empty());
}

TEST_F(UpstreamRunTest, between_jobs_a_result_that_cannot_be_published_fails_its_node) {
  UpstreamUse use;
  use.transport = true;
  const auto store = machine("a", use);
  // Names that are taken by files: nothing can be made below them.
  test::write_file(shared + "/cas", "");
  const RunResult result = run(diamond(1.5, 2), store);
  EXPECT_EQ(result.status, ExitCode::node_failed);
  bool said = false;
  for (const NodeResult& node : result.nodes)
    said = said || node.cause.find("cannot be published") != std::string::npos;
  EXPECT_TRUE(said);
  const RunResult here = run(diamond(1.5, 2), machine("b"));
  EXPECT_EQ(here.status, ExitCode::ok) << "where it is not the transport it costs nothing";
}

TEST_F(UpstreamRunTest, another_result_upstream_fails_a_strict_run_and_no_other) {
  Dag dag;
  node(dag, "source", "Source", {}, {{"value", 3}});
  dag.outputs.push_back({"numbers", "", {0, "numbers"}});
  // What the upstream says of this key was computed by a machine that errs.
  const Dag wrong_dag = [this] {
    Dag other;
    node(other, "source", "Source", {}, {{"value", 4}});
    other.outputs.push_back({"numbers", "", {0, "numbers"}});
    return other;
  }();
  const RunResult wrong = run(wrong_dag, store());
  const RunResult right = run(dag, store());
  ActionEntry entry;
  entry.manifest = right.nodes[0].manifest;
  entry.outputs = wrong.nodes[0].outputs;
  machine("a")->put_action(key_of(entry.manifest), entry);
  for (const bool strict : {false, true}) {
    RunOptions options;
    options.strict = strict;
    options.force = {0};
    const auto store = machine(strict ? "strict" : "b");
    Runner runner(dag, registry, store, options, events);
    const RunResult result = runner.run();
    EXPECT_EQ(result.status, strict ? ExitCode::node_failed : ExitCode::ok);
    if (strict) continue;
    ASSERT_EQ(store->upstream_notes().size(), 1u);
    EXPECT_NE(store->upstream_notes()[0].find("names another result"), std::string::npos);
    EXPECT_EQ(result.nodes[0].outputs[0].digest, right.nodes[0].outputs[0].digest);
  }
}

}  // namespace
}  // namespace ballflow
