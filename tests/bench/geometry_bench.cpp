// Poles, alpha-shapes and medial axes against what CGAL alone needs for the same input. Ours and the
// yardstick take turns within one run; every figure is the minimum over the turns, because other work on the
// machine can only add to it.
//
//   bench_geometry                                     # all
//   bench_geometry --benchmark_filter=alpha_shape      # one part
//
// Counters: `cpu` seconds of all threads, `wall` seconds, `per_...` cpu divided by that of the yardstick,
// `MB` the most memory taken on top of the input, `load` of the machine in the last minute.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "balls/enlarge.hpp"
#include "balls/select_balls.hpp"
#include "cgal_baselines.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/alpha_classes.hpp"
#include "power/alpha_shape.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"

namespace ballflow::bench {
namespace {

using namespace geometry;

// A number in KB of /proc/self/status.
double status_kilobytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double value = 0;
    if (word == name + ":" && status >> value) return value;
  }
  return 0;
}

double cpu_seconds() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

/// The least of what something costs over several turns.
struct Cost {
  double cpu = std::numeric_limits<double>::infinity();
  double wall = std::numeric_limits<double>::infinity();
  double megabytes = std::numeric_limits<double>::infinity();

  template <class Work>
  void take(const Work& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    const double resident = status_kilobytes("VmRSS");
    const auto start = std::chrono::steady_clock::now();
    const double before = cpu_seconds();
    work();
    const double after = cpu_seconds();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    cpu = std::min(cpu, after - before);
    wall = std::min(wall, passed.count());
    megabytes = std::min(megabytes, (status_kilobytes("VmHWM") - resident) / 1024);
  }
  void report(benchmark::State& state, const std::string& prefix = {}) const {
    state.counters[prefix + "cpu"] = cpu;
    state.counters[prefix + "wall"] = wall;
    if (prefix.empty()) state.counters["MB"] = megabytes;
  }
};

void report_load(benchmark::State& state) {
  double load = 0;
  getloadavg(&load, 1);
  state.counters["load"] = load;
}

int turns(std::size_t size) { return size < 50'000 ? 7 : 3; }

/// The sample of a model and, where they are asked for, its inner polar balls; made once.
struct Model {
  explicit Model(const std::string& file) {
    SampleOptions options;
    options.file = file;
    mesh = sample(options, 0);
  }
  const Balls& inner() {
    if (inner_.size() == 0) inner_ = label_poles(voronoi_poles(mesh.points, {}), mesh.mesh, {}).inner;
    return inner_;
  }
  Balls enlarged(double epsilon) { return enlarge(inner(), mesh.points, {}, {.epsilon = epsilon}).balls; }
  MeshFile mesh;

 private:
  Balls inner_;
};

Model& model(const std::string& file) {
  static std::map<std::string, std::unique_ptr<Model>> models;
  auto& at = models[file];
  if (at == nullptr) at = std::make_unique<Model>(file);
  return *at;
}

void poles(benchmark::State& state, const std::string& file) {
  const Model& m = model(file);
  Cost both, voronoi, labels, yardstick;
  for (auto _ : state) {
    for (int turn = 0; turn < turns(m.mesh.points.points.size()); ++turn) {
      yardstick.take([&] { benchmark::DoNotOptimize(delaunay(m.mesh.points.points)); });
      PoleSet found;
      voronoi.take([&] { found = voronoi_poles(m.mesh.points, {}); });
      labels.take([&] { benchmark::DoNotOptimize(label_poles(found, m.mesh.mesh, {})); });
      found = {};
      both.take(
          [&] { benchmark::DoNotOptimize(label_poles(voronoi_poles(m.mesh.points, {}), m.mesh.mesh, {})); });
    }
  }
  both.report(state);
  voronoi.report(state, "voronoi_");
  labels.report(state, "label_");
  yardstick.report(state, "delaunay_");
  state.counters["points"] = static_cast<double>(m.mesh.points.points.size());
  state.counters["per_delaunay"] = both.cpu / yardstick.cpu;
  report_load(state);
}

void alpha(benchmark::State& state, const std::string& file, double epsilon) {
  const Balls balls = model(file).enlarged(epsilon);
  Cost whole, classes, triangulation, fixed;
  for (auto _ : state) {
    for (int turn = 0; turn < turns(balls.size()); ++turn) {
      std::unique_ptr<RegularTriangulation> regular;
      triangulation.take([&] { regular = std::make_unique<RegularTriangulation>(balls); });
      fixed.take([&] { benchmark::DoNotOptimize(regular->fixed_alpha_shape()); });
      regular.reset();
      const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
      classes.take([&] { benchmark::DoNotOptimize(alpha_classes(diagram, no_monitor())); });
      whole.take([&] { benchmark::DoNotOptimize(alpha_shape(balls, {}, no_monitor())); });
    }
  }
  whole.report(state);
  classes.report(state, "classes_");
  triangulation.report(state, "regular_");
  fixed.report(state, "fixed_alpha_");
  state.counters["balls"] = static_cast<double>(balls.size());
  state.counters["per_regular"] = whole.cpu / triangulation.cpu;
  state.counters["fixed_alpha_per_classes"] = fixed.cpu / classes.cpu;
  report_load(state);
}

void axis(benchmark::State& state, const std::string& file, double epsilon) {
  Model& m = model(file);
  const CoverMatrix matrix = cover_matrix(m.enlarged(epsilon), m.mesh.points);
  const Balls balls = select_balls(greedy(matrix.cover), matrix.balls, {});
  const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
  Cost cost;
  for (auto _ : state) {
    for (int turn = 0; turn < turns(balls.size()); ++turn) {
      cost.take([&] { benchmark::DoNotOptimize(medial_axis(complex, {}, no_monitor())); });
    }
  }
  cost.report(state);
  const auto n = static_cast<double>(balls.size());
  state.counters["balls"] = n;
  state.counters["ns_per_n_log_n"] = 1e9 * cost.cpu / (n * std::log2(n));
  report_load(state);
}

void add_all() {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kSecond)->Iterations(1);
  };
  std::map<std::string, std::string> models{{"torus", "shape:torus?n=5000"}, {"knot", "shape:knot?n=50000"}};
  for (const auto& [name, file] : {std::pair{"bunny", "models/stanford_bunny.obj.gz"},
                                   std::pair{"dragon2", "models/stanford_dragon_res2.ply.gz"},
                                   std::pair{"dragon1", "models/stanford_dragon_res1.ply.gz"}}) {
    if (const std::string path = test::data_file(file); !path.empty()) models[name] = path;
  }
  for (const auto& [name, file] : models) {
    add("poles/" + name, [file = file](benchmark::State& s) { poles(s, file); });
    if (name == "dragon1") continue;
    add("alpha_shape/" + name, [file = file](benchmark::State& s) { alpha(s, file, 0.1); });
    for (const auto& [label, epsilon] :
         {std::pair{"0.3", 0.3}, std::pair{"0.1", 0.1}, std::pair{"0.04", 0.04}, std::pair{"0.015", 0.015}}) {
      add("medial_axis/" + name + "/" + label,
          [file = file, epsilon = epsilon](benchmark::State& s) { axis(s, file, epsilon); });
    }
  }
}

}  // namespace
}  // namespace ballflow::bench

int main(int argc, char** argv) {
  ballflow::bench::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
