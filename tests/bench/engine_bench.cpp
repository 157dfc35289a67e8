// What the engine costs beside the nodes. All times are CPU time of the process, of children where there are
// any, because wall time on a busy machine says little.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <thread>

#include "ballflow/run.hpp"
#include "test_data.hpp"

extern char** environ;

namespace ballflow {
namespace {

class Silent final : public EventSink {
 public:
  void on(const Event&) override {}
};

const Registry& registry() {
  static const auto instance = Registry::load({BENCH_NODES});
  return *instance;
}

double process_cpu() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// start -> pass -> ... -> pass, `nodes` in all, of `count` numbers. Reads `file` when it is not empty.
std::string chain(std::size_t nodes, std::int64_t count = 1, const std::string& file = "") {
  std::string text = R"({"doc": "A chain.", "nodes": {"n0": {"type": "BenchStart", "params": {"count": )" +
                     std::to_string(count) + (file.empty() ? "" : R"(, "file": ")" + file + '"') + "}}";
  for (std::size_t i = 1; i < nodes; ++i) {
    text += ",\n\"n" + std::to_string(i) + R"(": {"type": "BenchPass", "params": {"mark": )" +
            std::to_string(i) + R"(}, "inputs": {"numbers": "n)" + std::to_string(i - 1) + R"(.numbers"}})";
  }
  return text + R"(}, "outputs": {"numbers": "n)" + std::to_string(nodes - 1) + R"(.numbers"}})";
}

void expect(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

void run_and_check(const Dag& dag, const std::shared_ptr<Store>& store, NodeStatus expected) {
  Silent silent;
  RunOptions options;
  options.threads = 1;
  Runner runner(dag, registry(), store, options, silent);
  const RunResult& result = runner.run();
  expect(result.status == ExitCode::ok && result.nodes.back().status == expected, "the chain did not run");
}

/// Reports the least CPU time of all iterations, as a whole and per unit.
template <class Work>
void measure(benchmark::State& state, double units, const char* unit, const Work& work) {
  double least = 1e9;
  for (auto _ : state) {
    const double seconds = work();
    state.SetIterationTime(seconds);
    least = std::min(least, seconds);
  }
  state.counters["least_ms"] = 1e3 * least;
  if (units > 1) state.counters[std::string("least_us_per_") + unit] = 1e6 * least / units;
}

void no_op_nodes_without_a_cache(benchmark::State& state) {
  const auto nodes = static_cast<std::size_t>(state.range(0));
  const Dag dag = parse_graph(chain(nodes), "chain.json", registry());
  const auto store = Store::open({});
  measure(state, static_cast<double>(nodes), "node", [&] {
    const double start = process_cpu();
    run_and_check(dag, store, NodeStatus::run);
    return process_cpu() - start;
  });
}
BENCHMARK(no_op_nodes_without_a_cache)->Arg(100)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

void hits(benchmark::State& state) {
  const auto nodes = static_cast<std::size_t>(state.range(0));
  const test::TempFolder folder;
  const Dag dag = parse_graph(chain(nodes), "chain.json", registry());
  const auto store = Store::open({folder.path(), false});
  run_and_check(dag, store, NodeStatus::run);
  measure(state, static_cast<double>(nodes), "node", [&] {
    const double start = process_cpu();
    run_and_check(dag, store, NodeStatus::hit);
    return process_cpu() - start;
  });
}
BENCHMARK(hits)->Arg(100)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

void iterations_of_a_loop(benchmark::State& state) {
  const test::TempFolder folder;
  test::write_file(folder.file("body.json"), R"({"doc": "One more.",
    "inputs": {"numbers": {"type": "BenchNumbers", "doc": "any"}},
    "nodes": {"count": {"type": "BenchCount", "inputs": {"numbers": "inputs.numbers"}}},
    "outputs": {"numbers": "count.numbers"}})");
  const std::string rounds = std::to_string(state.range(0));
  const Dag dag = parse_graph(R"({"doc": "A loop.", "nodes": {"start": {"type": "BenchStart"},
    "loop": {"loop": "body.json", "inputs": {"numbers": "start.numbers"}, "until": "numbers.first == )" +
                                  rounds + R"("}}, "outputs": {"numbers": "loop.numbers"}})",
                              folder.file("loop.json"), registry());
  const auto store = Store::open({});
  measure(state, static_cast<double>(state.range(0)), "iteration", [&] {
    const double start = process_cpu();
    run_and_check(dag, store, NodeStatus::run);
    return process_cpu() - start;
  });
}
BENCHMARK(iterations_of_a_loop)->Arg(100)->Arg(1000)->UseManualTime()->Unit(benchmark::kMillisecond);

/// CPU seconds of "ballflow run" in a process of its own.
double cold_run(const std::string& graph, const std::string& cache) {
  const std::string program = test::binary_file("bin/ballflow");
  std::vector<std::string> words = {program, "--plugin", BENCH_NODES, "run",
                                    graph,   "--cache",  cache,       "--quiet"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  expect(posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) == 0,
         "cannot spawn");
  int status = 0;
  rusage usage{};
  expect(wait4(child, &status, 0, &usage) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0,
         "ballflow run failed");
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void cold_process_with_everything_cached(benchmark::State& state) {
  const test::TempFolder folder;
  const auto nodes = static_cast<std::size_t>(state.range(0));
  test::write_file(folder.file("chain.json"), chain(nodes));
  cold_run(folder.file("chain.json"), folder.file("cache"));
  measure(state, static_cast<double>(nodes), "node",
          [&] { return cold_run(folder.file("chain.json"), folder.file("cache")); });
}
BENCHMARK(cold_process_with_everything_cached)
    ->Arg(1)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Ten nodes of 24 MB each, the first of which reads a file of 24 MB.
void cold_process_with_ten_cached_nodes_of_a_million_points(benchmark::State& state) {
  const test::TempFolder folder;
  test::write_file(folder.file("scan"), std::string(24'000'000, 'x'));
  test::write_file(folder.file("chain.json"), chain(10, 3'000'000, folder.file("scan")));
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // the digest of a younger file is not kept
  cold_run(folder.file("chain.json"), folder.file("cache"));
  measure(state, 1, "", [&] { return cold_run(folder.file("chain.json"), folder.file("cache")); });
}
BENCHMARK(cold_process_with_ten_cached_nodes_of_a_million_points)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ballflow

BENCHMARK_MAIN();
