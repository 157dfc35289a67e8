// Covering: the matrix, and the subset tests of Reduce side by side. The counters `looked_at` and `compared`
// are pairs of sets: those that a test proposes, and those whose elements had to be read.
//
//   bench_cover --benchmark_filter=reduce      # K 3.8.2: what the thesis' two speedups and the index look at
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "balls/enlarge.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/reduce.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

struct Instance {
  Balls balls;
  PointSet points;
};

/// The inner polar balls of a model; made once.
const Instance& instance(const std::string& file) {
  static std::map<std::string, Instance> instances;
  const auto [at, fresh] = instances.try_emplace(file);
  if (fresh) {
    SampleOptions options;
    options.file = file;
    const MeshFile model = sample(options, 0);
    at->second = {label_poles(voronoi_poles(model.points, {}), model.mesh, {}).inner, model.points};
  }
  return at->second;
}

Balls enlarged(const Instance& instance, double epsilon) {
  return enlarge(instance.balls, instance.points, {}, {.epsilon = epsilon}).balls;
}

void matrix(benchmark::State& state, const std::string& file, double epsilon) {
  const Instance& model = instance(file);
  const Balls balls = enlarged(model, epsilon);
  std::size_t entries = 0;
  for (auto _ : state) entries = cover_matrix(balls, model.points).cover.nnz();
  state.counters["entries"] = static_cast<double>(entries);
}

void reduction(benchmark::State& state, const std::string& file, double epsilon, SubsetTest test) {
  const Instance& model = instance(file);
  const CoverState cover = cover_matrix(enlarged(model, epsilon), model.points).cover;
  ReduceStatistics statistics;
  for (auto _ : state)
    benchmark::DoNotOptimize(reduce(cover, {.subset_test = test}, no_monitor(), &statistics));
  state.counters["looked_at"] = static_cast<double>(statistics.candidates);
  state.counters["compared"] = static_cast<double>(statistics.compared);
  state.counters["passes"] = static_cast<double>(statistics.passes);
}

void add_all() {
  std::map<std::string, std::string> models{{"torus", "shape:torus?n=5000"}};
  if (const std::string file = test::data_file("models/stanford_bunny.obj.gz"); !file.empty())
    models["bunny"] = file;
  const std::pair<const char*, SubsetTest> tests[] = {{"inverted_index", SubsetTest::inverted_index},
                                                      {"hash", SubsetTest::hash},
                                                      {"bandwidth", SubsetTest::bandwidth}};
  // CPU time of all threads: what a shared machine pays.
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
  };
  for (const auto& [name, file] : models) {
    for (const auto& [label, epsilon] : {std::pair{"0.05", 0.05}, std::pair{"0.5", 0.5}}) {
      const std::string on = name + "/" + label;
      add("matrix/" + on,
          [file = file, epsilon = epsilon](benchmark::State& s) { matrix(s, file, epsilon); });
      for (const auto& [test_name, test] : tests) {
        add("reduce/" + on + "/" + test_name,
            [file = file, epsilon = epsilon, test = test](benchmark::State& s) {
              reduction(s, file, epsilon, test);
            });
      }
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry

int main(int argc, char** argv) {
  ballflow::geometry::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
