// What the scheduler decides, with an executor that runs no node: it gives artifacts of the wanted size and
// content.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <thread>

#include "ballflow/executor.hpp"
#include "ballflow/run.hpp"
#include "faulty_file_system.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

/// Bytes of arrays that somebody still refers to.
class Live {
 public:
  std::shared_ptr<std::vector<double>> numbers(std::size_t count, double value) {
    const std::lock_guard lock(mutex_);
    now_ += bytes(count);
    most_ = std::max(most_, now_);
    const auto gone = [this](std::vector<double>* numbers) {
      const std::lock_guard guard(mutex_);
      now_ -= bytes(numbers->size());
      delete numbers;
    };
    return {new std::vector<double>(count, value), gone};
  }
  std::uint64_t now() {
    const std::lock_guard lock(mutex_);
    return now_;
  }
  std::uint64_t most() {
    const std::lock_guard lock(mutex_);
    return most_;
  }

 private:
  static std::uint64_t bytes(std::size_t count) { return count * sizeof(double); }
  std::mutex mutex_;
  std::uint64_t now_ = 0, most_ = 0;
};

ArtifactPtr numbers(Live& live, std::size_t count, double value, int version = 1) {
  const auto owner = live.numbers(count, value);
  return Artifact::seal("Numbers", version, {{"values", BF_F64, {count}, owner->data()}}, "{}", owner);
}

class Fake final : public Executor {
 public:
  ExecutionOutcome execute(const ExecutionRequest& request) override {
    const std::string& path = request.node->path;
    {
      const std::lock_guard lock(mutex);
      started.push_back(path);
      ++running;
    }
    if (during) during(request);
    ExecutionOutcome outcome;
    outcome.status = ExecutionOutcome::Status::ok;
    const auto size = sizes.find(path);
    const auto value = values.find(path);
    outcome.outputs["out"] =
        numbers(live, size == sizes.end() ? 1 : size->second, value == values.end() ? 1 : value->second);
    if (change) change(outcome);
    const std::lock_guard lock(mutex);
    --running;
    return outcome;
  }
  int count(const std::string& path) const {
    return static_cast<int>(std::count(started.begin(), started.end(), path));
  }

  Live live;
  std::map<std::string, std::size_t> sizes;  // numbers, by path; else one
  std::map<std::string, double> values;      // of the numbers, by path; else 1
  std::function<void(const ExecutionRequest&)> during;
  std::function<void(ExecutionOutcome&)> change;
  std::mutex mutex;
  std::vector<std::string> started;
  int running = 0;
};

class Ears final : public EventSink {
 public:
  void on(const Event& event) override {
    const std::lock_guard lock(mutex);
    if (event.kind == Event::Kind::node_waiting) waited.emplace_back(event.node, event.text);
    if (event.kind == Event::Kind::node_message) messages.push_back(event.text);
    if (event.kind == Event::Kind::node_started) most_running = std::max(most_running, ++running);
    if (event.kind == Event::Kind::node_finished) --running;
    if (event.kind == Event::Kind::run_finished) memory_at_end = event.memory;
    if (hears) hears(event);
    changed.notify_all();
  }
  /// Until something was heard; a minute at most, so that a test that would wait for ever fails instead.
  template <class Condition>
  void wait(const Condition& condition) {
    std::unique_lock lock(mutex);
    EXPECT_TRUE(changed.wait_for(lock, std::chrono::minutes(1), condition)) << "nothing more was heard";
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::pair<std::size_t, std::string>> waited;
  std::vector<std::string> messages;
  int running = 0, most_running = 0;
  std::uint64_t memory_at_end = 0;
  std::function<void(const Event&)> hears;
};

struct SchedulerTest : testing::Test {
  /// A node that reads any number of others; different `version`s have different keys.
  std::size_t node(const std::string& path, const std::vector<std::size_t>& reads = {}, int version = 0,
                   std::uint64_t memory = 0) {
    NodeDeclaration decl;
    decl.id = "Node" + std::to_string(reads.size());
    decl.version = version == 0 ? static_cast<int>(dag.nodes.size()) + 100 : version;
    decl.memory_fixed = memory;
    decl.outputs.push_back({"out", "Numbers", "", 1, false});
    std::map<std::string, EdgeRef> inputs;
    for (const std::size_t producer : reads) {
      const std::string port = "in" + std::to_string(inputs.size());
      decl.inputs.push_back({port, "Numbers", "", 1, false});
      inputs[port] = {producer, "out"};
    }
    declarations.push_back(std::make_unique<NodeDeclaration>(std::move(decl)));
    dag.nodes.push_back({path, *declarations.back(), std::move(inputs)});
    return dag.nodes.size() - 1;
  }
  void output(std::size_t i) { dag.outputs.push_back({dag.nodes[i].path, "", {i, "out"}}); }

  std::shared_ptr<Store> store() { return Store::open({folder.file("cache"), false}); }
  Digest key(std::size_t i) { return action_key(dag.nodes[i], {}, 0, *store()).key; }
  /// What another process would leave for a node without inputs.
  void leave(std::size_t i, double value, int version = 1) {
    const ArtifactPtr artifact = numbers(executor->live, 1, value, version);
    ActionEntry entry;
    entry.manifest = action_key(dag.nodes[i], {}, 0, *store()).manifest;
    entry.outputs.push_back(output_entry("out", *artifact));
    ASSERT_TRUE(store()->put_blob(*artifact, false));
    ASSERT_TRUE(store()->put_action(key(i), entry));
  }

  RunOptions options(unsigned threads, std::uint64_t memory = 0) {
    RunOptions result;
    result.threads = threads;
    result.memory_bytes = memory;
    result.executor = executor;
    return result;
  }
  RunResult run(const RunOptions& with, std::shared_ptr<Store> where = nullptr) {
    Runner runner(dag, registry, where != nullptr ? where : store(), with, ears);
    return runner.run();
  }
  bool told(const std::string& text) const {
    return std::any_of(ears.messages.begin(), ears.messages.end(),
                       [&](const std::string& message) { return message.find(text) != std::string::npos; });
  }

  const test::TempFolder folder;
  Registry registry;
  std::vector<std::unique_ptr<NodeDeclaration>> declarations;
  Dag dag;
  const std::shared_ptr<Fake> executor = std::make_shared<Fake>();
  Ears ears;
};

constexpr std::size_t megabyte = (1u << 20) / sizeof(double);
constexpr std::uint64_t megabytes(std::uint64_t n) { return n << 20; }

TEST_F(SchedulerTest, the_executor_is_asked_once_for_every_node_with_its_inputs) {
  const auto a = node("a"), b = node("b"), sum = node("sum", {a, b});
  output(sum);
  executor->values = {{"a", 3}, {"b", 4}};
  executor->during = [](const ExecutionRequest& request) {
    if (request.node->path != "sum") return;
    EXPECT_EQ(*static_cast<const double*>(request.inputs.at("in0")->find("values")->data), 3);
    EXPECT_EQ(*static_cast<const double*>(request.inputs.at("in1")->find("values")->data), 4);
    EXPECT_EQ(request.threads, 2u);
  };
  EXPECT_EQ(run(options(2)).status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 3u);
  EXPECT_EQ(run(options(2)).nodes[sum].status, NodeStatus::hit);
  EXPECT_EQ(executor->started.size(), 3u);
}

TEST_F(SchedulerTest, what_goes_wrong_around_a_node_fails_the_node) {
  output(node("a"));
  executor->during = [](const ExecutionRequest&) {
    throw Error(ExitCode::node_failed, "the other machine is gone", "start it");
  };
  const RunResult thrown = run(options(1));
  EXPECT_EQ(thrown.nodes[0].status, NodeStatus::failed);
  EXPECT_EQ(thrown.nodes[0].cause, "the other machine is gone");
  EXPECT_EQ(thrown.nodes[0].hint, "start it");

  executor->during = nullptr;
  executor->change = [](ExecutionOutcome& outcome) { outcome.outputs.clear(); };
  EXPECT_EQ(run(options(1)).nodes[0].cause, "the executor gave no output \"out\" of type Numbers");
  executor->change = [this](ExecutionOutcome& outcome) {
    outcome.outputs["out"] = numbers(executor->live, 1, 1, 2);
  };
  EXPECT_EQ(run(options(1)).nodes[0].status, NodeStatus::failed) << "another version of the type";
}

TEST_F(SchedulerTest, producers_of_large_outputs_wait_while_slow_consumers_hold_them) {
  // 24 MB in all, every consumer also reads a node that ends only when all producers have ended or one has to
  // wait.
  constexpr std::size_t producers = 24;
  constexpr std::uint64_t budget = megabytes(10);
  const auto slow = node("slow");
  std::size_t ended = 0;
  for (std::size_t i = 0; i < producers; ++i) {
    const auto producer = node("producer" + std::to_string(i));
    executor->sizes["producer" + std::to_string(i)] = megabyte;
    output(node("consumer" + std::to_string(i), {producer, slow}));
  }
  ears.hears = [&](const Event& event) {
    if (event.kind == Event::Kind::node_finished && dag.nodes[event.node].path.rfind("producer", 0) == 0)
      ++ended;
  };
  executor->during = [&](const ExecutionRequest& request) {
    if (request.node->path == "slow") ears.wait([&] { return ended == producers || !ears.waited.empty(); });
  };
  const RunResult result = run(options(4, budget), Store::open({}));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 2 * producers + 1) << "nothing runs twice";
  EXPECT_LE(executor->live.most(), budget);
  EXPECT_GE(executor->live.most(), megabytes(5)) << "the budget is used";
  std::uint64_t outputs = 0;
  for (const DagOutput& one : dag.outputs) outputs += result.nodes[one.from.node].outputs.at(0).bytes;
  EXPECT_EQ(ears.memory_at_end, outputs) << "outputs of the graph are held to the end, and nothing else";
}

TEST_F(SchedulerTest, outputs_of_the_graph_that_only_memory_has_count_to_the_end) {
  constexpr std::size_t count = 8;
  for (std::size_t i = 0; i < count; ++i) {
    output(node("n" + std::to_string(i)));
    executor->sizes["n" + std::to_string(i)] = megabyte;
  }
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, int>> seen;  // held, running
  executor->during = [&](const ExecutionRequest&) {
    // Another one runs beside this one, or has to wait, or none is left.
    ears.wait([&] { return ears.most_running > 1 || !ears.waited.empty(); });
    const std::scoped_lock lock(mutex, executor->mutex);
    seen.emplace_back(executor->live.now(), executor->running);
  };
  EXPECT_EQ(run(options(2, megabytes(4)), Store::open({})).status, ExitCode::ok);
  for (const auto& [held, running] : seen) {
    if (held >= megabytes(4)) {
      EXPECT_EQ(running, 1) << held << " bytes were held: one at a time, or nothing would ever end";
    }
  }
  EXPECT_EQ(executor->live.now(), 0u) << "the runner is gone";
  EXPECT_EQ(executor->live.most(), megabytes(count));
}

TEST_F(SchedulerTest, nodes_that_wait_for_memory_are_looked_up_once) {
  const auto opens_per_node = [this](std::size_t count) {
    dag = {};
    for (std::size_t i = 0; i < count; ++i) output(node("n" + std::to_string(i), {}, 0, 60));
    ears.waited.clear();
    // The first holds the budget until all others wait for it.
    executor->during = [&](const ExecutionRequest&) {
      ears.wait([&] { return ears.waited.size() >= count - 1; });
    };
    const auto files = std::make_shared<test::FaultyFileSystem>();
    const auto cache = Store::open({folder.file("cache" + std::to_string(count)), false}, files);
    files->reset_counts();
    EXPECT_EQ(run(options(4, 100), cache).status, ExitCode::ok);
    return static_cast<double>(files->count("open")) / static_cast<double>(count);
  };
  const double few = opens_per_node(8);
  EXPECT_LE(opens_per_node(64), 1.5 * few + 1);
}

/// A lock of the key that somebody else holds until `free` says so.
struct Elsewhere {
  Elsewhere(SchedulerTest& test, std::size_t i) : lock(test.store()->lock(test.key(i), {})) {}
  std::unique_ptr<KeyLock> lock;
};

TEST_F(SchedulerTest, waiting_for_the_key_of_another_process_holds_neither_worker_nor_memory) {
  for (const unsigned threads : {1u, 4u}) {
    SCOPED_TRACE(threads);
    dag = {};
    executor->started.clear();
    ears.waited.clear();
    node("before", {}, 0, 40);
    const auto busy = node("busy", {}, 1000 + static_cast<int>(threads), 40);
    node("after", {}, 0, 40);
    for (std::size_t i = 0; i < 3; ++i) {
      declarations[declarations.size() - 1 - i]->version += 10 * static_cast<int>(threads);
      output(i);
    }
    Elsewhere other(*this, busy);
    ASSERT_NE(other.lock, nullptr);
    const std::pair<std::size_t, std::string> for_the_key(busy, "another process computes the same");
    std::atomic<bool> cancel{false};
    int others_ended = 0;
    ears.hears = [&](const Event& event) {
      if (event.kind == Event::Kind::node_finished && event.node != busy) ++others_ended;
      const bool waits = std::count(ears.waited.begin(), ears.waited.end(), for_the_key) > 0;
      if (waits && others_ended == 2) other.lock.reset();
    };
    std::mutex mutex;
    std::condition_variable ended;
    bool done = false;
    std::thread watch([&] {  // instead of hanging for ever
      std::unique_lock lock(mutex);
      if (!ended.wait_for(lock, std::chrono::minutes(1), [&] { return done; })) cancel = true;
    });
    RunOptions with = options(threads, 100);
    with.cancel = &cancel;
    const RunResult result = run(with);
    {
      const std::lock_guard lock(mutex);
      done = true;
    }
    ended.notify_all();
    watch.join();
    EXPECT_EQ(result.status, ExitCode::ok);
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::run);
    EXPECT_EQ(executor->started.back(), "busy");
    EXPECT_EQ(executor->started.size(), 3u);
    EXPECT_EQ(std::count(ears.waited.begin(), ears.waited.end(), for_the_key), 1);
  }
}

TEST_F(SchedulerTest, what_the_other_process_leaves_is_a_hit) {
  const auto busy = node("busy");
  const auto after = node("after", {busy});
  output(after);
  for (const unsigned threads : {1u, 3u}) {
    SCOPED_TRACE(threads);
    declarations[busy]->version = static_cast<int>(threads);
    declarations[after]->version = 50 + static_cast<int>(threads);
    executor->started.clear();
    Elsewhere other(*this, busy);
    ears.hears = [&](const Event& event) {
      if (event.kind != Event::Kind::node_waiting) return;
      leave(busy, 7);
      other.lock.reset();
    };
    const RunResult result = run(options(threads));
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::hit);
    EXPECT_EQ(result.nodes[busy].reason, "computed meanwhile by another run");
    EXPECT_EQ(executor->started, std::vector<std::string>{"after"});
  }
}

TEST_F(SchedulerTest, a_run_that_waits_for_another_process_can_be_cancelled_and_a_failure_ends_it) {
  const auto busy = node("busy");
  const auto fail = node("fail");
  output(busy);
  output(fail);
  const Elsewhere other(*this, busy);
  std::atomic<bool> cancel{false};
  ears.hears = [&](const Event& event) {
    if (event.kind == Event::Kind::node_waiting) cancel = true;
  };
  for (const unsigned threads : {1u, 3u}) {
    cancel = false;
    RunOptions with = options(threads);
    with.cancel = &cancel;
    EXPECT_EQ(run(with).nodes[busy].status, NodeStatus::cancelled);
  }
  ears.hears = nullptr;
  declarations[fail]->version = 7;
  executor->during = [](const ExecutionRequest&) { throw Error(ExitCode::node_failed, "no"); };
  for (const unsigned threads : {1u, 3u}) {
    const RunResult result = run(options(threads));
    EXPECT_EQ(result.nodes[fail].status, NodeStatus::failed);
    EXPECT_EQ(result.nodes[busy].status, NodeStatus::skipped);
  }
}

TEST_F(SchedulerTest, a_result_that_another_process_left_meanwhile_is_compared) {
  const auto a = node("a");
  output(a);
  // As where a file system does not lock: the entry appears while the node runs.
  executor->during = [&](const ExecutionRequest&) { leave(a, 5); };
  RunOptions strict = options(1);
  strict.strict = true;
  const RunResult refused = run(strict);
  EXPECT_EQ(refused.nodes[a].status, NodeStatus::failed);
  EXPECT_NE(refused.nodes[a].cause.find("not deterministic"), std::string::npos) << refused.nodes[a].cause;

  declarations[a]->version = 2;
  ears.messages.clear();
  const RunResult told_of = run(options(1));
  EXPECT_EQ(told_of.nodes[a].status, NodeStatus::run);
  EXPECT_FALSE(told_of.nodes[a].deterministic);
  EXPECT_TRUE(told("not deterministic"));

  declarations[a]->version = 3;
  ears.messages.clear();
  executor->during = [&](const ExecutionRequest&) { leave(a, 1); };  // the same
  EXPECT_TRUE(run(options(1)).nodes[a].deterministic);
  EXPECT_TRUE(ears.messages.empty());
}

TEST_F(SchedulerTest, an_artifact_made_again_is_compared_with_what_another_process_left_as_well) {
  const auto a = node("a"), after = node("after", {a});
  output(a);
  run(options(1));
  std::filesystem::remove_all(folder.file("cache/cas"));
  dag.outputs.clear();
  output(after);
  executor->during = [&](const ExecutionRequest& request) {
    if (request.node->path == "a") leave(a, 5);
  };
  const RunResult result = run(options(1));
  EXPECT_EQ(result.status, ExitCode::ok);
  EXPECT_FALSE(result.nodes[a].deterministic);
  EXPECT_TRUE(told("not deterministic"));
}

TEST_F(SchedulerTest, an_entry_of_another_version_of_a_type_is_replaced_and_told) {
  const auto a = node("a");
  output(a);
  leave(a, 1, 2);
  const RunResult result = run(options(1));
  EXPECT_EQ(result.nodes[a].status, NodeStatus::run);
  EXPECT_TRUE(result.nodes[a].deterministic) << "it is the author who forgot something";
  EXPECT_TRUE(told("the author has not raised the behaviour version"));
}

TEST_F(SchedulerTest, equal_nodes_of_which_one_is_forced_never_keep_two_results) {
  for (const unsigned threads : {1u, 4u}) {
    for (const bool first : {true, false}) {
      SCOPED_TRACE(testing::Message() << threads << ' ' << first);
      dag = {};
      declarations.clear();
      const int version = static_cast<int>(threads) * 2 + (first ? 1 : 0);
      const auto a = node("a", {}, version), b = node("b", {}, version);
      const auto of_a = node("of a", {a}), of_b = node("of b", {b});
      output(of_a);
      output(of_b);
      leave(a, 5);
      executor->values = {{"a", 6}, {"b", 6}};
      RunOptions with = options(threads);
      with.force = {first ? a : b};
      const RunResult result = run(with);
      EXPECT_EQ(result.status, ExitCode::ok);
      EXPECT_EQ(result.nodes[a].outputs.at(0).digest, result.nodes[b].outputs.at(0).digest);
      EXPECT_EQ(result.nodes[a].outputs.at(0).digest, numbers(executor->live, 1, 6)->digest());
      EXPECT_FALSE(result.nodes[a].deterministic && result.nodes[b].deterministic);
    }
  }
}

TEST_F(SchedulerTest, equal_nodes_that_are_both_forced_run_once) {
  const auto a = node("a", {}, 1), b = node("b", {}, 1);
  output(node("sum", {a, b}));
  run(options(1));
  executor->started.clear();
  RunOptions with = options(4);
  with.force = {a, b};
  EXPECT_EQ(run(with).status, ExitCode::ok);
  EXPECT_EQ(executor->started.size(), 1u);
}

}  // namespace
}  // namespace ballflow
