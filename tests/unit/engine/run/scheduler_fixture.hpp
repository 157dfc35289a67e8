// A run with an executor that runs no node: it gives artifacts of the wanted size and content.
#pragma once

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

inline ArtifactPtr numbers(Live& live, std::size_t count, double value, int version = 1) {
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

inline constexpr std::size_t megabyte = (1u << 20) / sizeof(double);
constexpr std::uint64_t megabytes(std::uint64_t n) { return n << 20; }

}  // namespace ballflow
