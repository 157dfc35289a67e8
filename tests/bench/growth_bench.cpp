// Growing inner polar balls, beside the alpha-shape that every comparison of topologies costs, and labels
// with and without a mesh: on a generated torus, and on the bunny where there are test data.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "balls/enlarge.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/alpha_shape.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

struct Instance {
  MeshFile model;
  PoleSet poles;
  Balls inner;
};

/// Made once.
const Instance& instance(const std::string& file) {
  static std::map<std::string, Instance> instances;
  const auto [at, fresh] = instances.try_emplace(file);
  if (fresh) {
    SampleOptions options;
    options.file = file;
    Instance& made = at->second;
    made.model = sample(options, 0);
    made.poles = voronoi_poles(made.model.points, {});
    made.inner = label_poles(made.poles, made.model.mesh, {}).inner;
  }
  return at->second;
}

void growth(benchmark::State& state, const std::string& file, EnlargeMode mode) {
  const Instance& model = instance(file);
  EnlargeOptions options;
  options.mode = mode;
  Enlarged grown;
  for (auto _ : state) grown = enlarge(model.inner, model.model.points, model.poles, options);
  state.counters["balls"] = static_cast<double>(model.inner.size());
  state.counters["comparisons"] = static_cast<double>(grown.unions);
}

void topology(benchmark::State& state, const std::string& file) {
  const Instance& model = instance(file);
  const Balls grown = enlarge(model.inner, model.model.points, {}, {}).balls;
  for (auto _ : state) benchmark::DoNotOptimize(alpha_shape(grown, {}, no_monitor()));
}

void labels(benchmark::State& state, const std::string& file, LabelMethod method) {
  const Instance& model = instance(file);
  LabelPolesOptions options;
  options.method = method;
  for (auto _ : state) benchmark::DoNotOptimize(label_poles(model.poles, model.model.mesh, options));
}

void add_all() {
  std::map<std::string, std::string> models{{"torus", "shape:torus?n=5000"}};
  if (const std::string file = test::data_file("models/stanford_bunny.obj.gz"); !file.empty())
    models["bunny"] = file;
  // CPU time of all threads: what a shared machine pays.
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
  };
  for (const auto& [name, file] : models) {
    add("alpha_shape/" + name, [file = file](benchmark::State& s) { topology(s, file); });
    add("pole_bound/" + name,
        [file = file](benchmark::State& s) { growth(s, file, EnlargeMode::pole_bound); });
    add("power_diagram/" + name,
        [file = file](benchmark::State& s) { growth(s, file, EnlargeMode::power_diagram); });
    add("labels_mesh/" + name,
        [file = file](benchmark::State& s) { labels(s, file, LabelMethod::automatic); });
    add("labels_angle/" + name, [file = file](benchmark::State& s) { labels(s, file, LabelMethod::angle); });
  }
}

}  // namespace
}  // namespace ballflow::geometry

int main(int argc, char** argv) {
  ballflow::geometry::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
