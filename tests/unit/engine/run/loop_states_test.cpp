// Loops whose jobs are cancelled go on in the next job, on another machine that shares nothing but a folder.
#include <algorithm>
#include <filesystem>

#include "run_fixture.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct LoopStatesTest : RunTest {
  static constexpr int iterations = 40;

  LoopStatesTest() {
    fs::create_directory(shared);
    test::write_file(number, "1");
  }
  ~LoopStatesTest() override { toy::before_reading = nullptr; }

  /// Counts to `iterations` by a number in a file, with a warning in each iteration.
  Dag graph() {
    test::write_file(folder.file("body.json"),
                     R"({ "inputs": { "n": { "type": "Numbers" } },
      "nodes": { "read": { "type": "FromFile", "params": { "file": ")" +
                         number + R"(" } },
                 "add": { "type": "Add", "inputs": { "a": "inputs.n", "b": "read.numbers" } },
                 "say": { "type": "Step", "inputs": { "numbers": "add.sum" }, "params": { "by": 0 } } },
      "outputs": { "n": "say.numbers" } })");
    return parse(R"("loop": "body.json", "inputs": { "n": "zero.numbers" }, "until": "n.first == 40")");
  }
  Dag parse(const std::string& loop) {
    return parse_graph(R"({ "nodes": { "zero": { "type": "Source", "params": { "value": 0, "count": 1 } },
                                       "loop": { )" +
                           loop + R"( } }, "outputs": { "n": "loop.n" } })",
                       folder.file("graph.json"), registry);
  }

  std::shared_ptr<Store> machine(const std::string& name, bool transport = true) {
    StoreOptions options;
    options.root = folder.file(name);
    options.upstream.upstream = Upstream::open(shared);
    options.upstream.transport = transport;
    return Store::open(options);
  }

  /// `after`: reads of the file before the job is cancelled, 0: never. `last`: what happens then, too.
  RunResult job(
      const Dag& dag, const std::shared_ptr<Store>& store, int after,
      const std::function<void()>& last = [] {}) {
    std::atomic<bool> cancel{false};
    int reads = 0;
    toy::before_reading = [&](const std::string&) {
      if (++reads != after) return;
      cancel = true;
      last();
    };
    RunOptions options;
    options.threads = 1;
    options.cancel = &cancel;
    Runner runner(dag, registry, store, options, events);
    RunResult result = runner.run();
    toy::before_reading = nullptr;
    return result;
  }

  const NodeResult& loop_in(const RunResult& result) { return result.nodes.back(); }
  bool said(const std::string& words) const {
    return std::any_of(events.messages.begin(), events.messages.end(),
                       [&](const std::string& message) { return message.find(words) != std::string::npos; });
  }
  void damage_blobs(const std::set<std::string>& but) {
    for (const auto& file : fs::recursive_directory_iterator(shared + "/cas")) {
      if (!file.is_regular_file() || but.count(file.path().string()) != 0) continue;
      fs::permissions(file.path(), fs::perms::owner_write, fs::perm_options::add);
      std::string bytes = test::read_file(file.path().string());
      bytes.back() = static_cast<char>(bytes.back() ^ 16);
      test::write_file(file.path().string(), bytes);
    }
  }
  std::set<std::string> blobs() const {
    std::set<std::string> names;
    for (const auto& file : fs::recursive_directory_iterator(shared + "/cas")) {
      if (file.is_regular_file()) names.insert(file.path().string());
    }
    return names;
  }

  const std::string shared = folder.file("shared"), number = folder.file("number");
};

TEST_F(LoopStatesTest, the_next_job_goes_on_and_ends_with_what_one_job_would_have_made) {
  const Dag dag = graph();
  const RunResult whole = run(dag, store(), 1);
  ASSERT_EQ(loop_in(whole).status, ran) << loop_in(whole).cause;
  ASSERT_EQ(loop_in(whole).warnings.size(), 21u);
  EXPECT_EQ(toy::counters.add, iterations);
  toy::reset();
  EXPECT_EQ(job(dag, machine("a"), 5).status, ExitCode::cancelled);
  EXPECT_TRUE(said("where the next job goes on"));
  EXPECT_EQ(job(dag, machine("b"), 20).status, ExitCode::cancelled);
  const RunResult last = job(dag, machine("c"), 0);
  ASSERT_EQ(loop_in(last).status, ran) << loop_in(last).cause;
  EXPECT_EQ(loop_in(last).outputs, loop_in(whole).outputs);
  EXPECT_EQ(loop_in(last).warnings, loop_in(whole).warnings);
  EXPECT_EQ(loop_in(last).iterations, iterations);
  EXPECT_GE(toy::counters.add, iterations);
  EXPECT_LE(toy::counters.add, iterations + 2) << "each cancelled job may lose an iteration, and no more";
}

TEST_F(LoopStatesTest, what_is_damaged_is_told_and_an_earlier_state_or_the_beginning_counts) {
  const Dag dag = graph();
  const RunResult whole = run(dag, store(), 1);
  job(dag, machine("a"), 10);
  const std::set<std::string> first = blobs();
  job(dag, machine("b"), 10);
  damage_blobs(first);
  toy::reset();
  const RunResult from_first = job(dag, machine("c"), 10);
  EXPECT_EQ(from_first.status, ExitCode::cancelled);
  EXPECT_TRUE(said("is damaged or lost"));
  EXPECT_TRUE(said("goes on after iteration 10") || said("goes on after iteration 9"));
  damage_blobs({});
  toy::reset();
  const RunResult last = job(dag, machine("d"), 0);
  ASSERT_EQ(loop_in(last).status, ran) << loop_in(last).cause;
  EXPECT_EQ(loop_in(last).outputs, loop_in(whole).outputs);
  EXPECT_EQ(toy::counters.add, iterations) << "it begins anew";
}

TEST_F(LoopStatesTest, of_copies_of_a_job_the_one_that_got_further_counts_and_nobody_warns) {
  const Dag dag = graph();
  job(dag, machine("a"), 5);
  // The second copy begins before the first one ends: it finds no state, and one under its number at its end.
  fs::rename(shared + "/ac", folder.file("ac of a"));
  const auto copy = machine("copy"), next = machine("next");
  job(dag, copy, 15, [this] {
    fs::remove_all(shared + "/ac");
    fs::rename(folder.file("ac of a"), shared + "/ac");
  });
  EXPECT_EQ(copy->upstream_notes(), std::vector<std::string>());
  toy::reset();
  const RunResult last = job(dag, next, 0);
  ASSERT_EQ(loop_in(last).status, ran) << loop_in(last).cause;
  EXPECT_LE(toy::counters.add, iterations - 14) << "from the state of the copy, which is further";
  EXPECT_EQ(next->upstream_notes(), std::vector<std::string>());
}

TEST_F(LoopStatesTest, a_state_that_cannot_be_stored_costs_the_iterations_and_fails_nothing) {
  const Dag dag = graph();
  const RunResult result = job(dag, machine("a"), 5, [this] {
    fs::remove_all(shared + "/cas");
    test::write_file(shared + "/cas", "");  // nothing can be made below it
  });
  EXPECT_EQ(result.status, ExitCode::cancelled);
  EXPECT_EQ(loop_in(result).status, NodeStatus::cancelled);
  EXPECT_TRUE(said("the next job begins anew"));
}

TEST_F(LoopStatesTest, a_file_that_changed_leaves_no_state_of_what_was_read_before) {
  const Dag dag = graph();
  const auto change = [this] { test::write_file(number, "2"); };
  EXPECT_EQ(job(dag, machine("a"), 5, change).status, ExitCode::cancelled);
  EXPECT_TRUE(said("changed while the run was reading it"));
}

TEST_F(LoopStatesTest, where_the_upstream_is_no_transport_nothing_is_kept) {
  const Dag dag = graph();
  const auto here = machine("a", false);
  job(dag, here, 5);
  const std::size_t kept = blobs().size();
  EXPECT_LE(kept, 1u) << "what the loop began with";
  toy::reset();
  EXPECT_EQ(job(dag, here, 0).status, ExitCode::ok);
  EXPECT_EQ(toy::counters.add, iterations);
}

TEST_F(LoopStatesTest, a_loop_of_loops_goes_on_at_an_iteration_of_the_outer_one) {
  graph();  // writes body.json
  test::write_file(folder.file("outer.json"), R"({ "inputs": { "n": { "type": "Numbers" } },
      "nodes": { "inner": { "loop": "body.json", "inputs": { "n": "inputs.n" },
                            "until": "n.first >= 1000000", "max_iterations": 4, "at_limit": "stop" } },
      "outputs": { "n": "inner.n" } })");
  const Dag dag =
      parse(R"("loop": "outer.json", "inputs": { "n": "zero.numbers" }, "until": "n.first == 40")");
  const RunResult whole = run(dag, store(), 1);
  toy::reset();
  job(dag, machine("a"), 22);
  const RunResult last = job(dag, machine("b"), 0);
  EXPECT_EQ(loop_in(last).outputs, loop_in(whole).outputs);
  EXPECT_EQ(loop_in(last).iterations, loop_in(whole).iterations);
  EXPECT_LE(toy::counters.add, iterations + 4);
}

}  // namespace
}  // namespace ballflow
