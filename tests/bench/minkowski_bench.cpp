// Minkowski sums of the sizes of the thesis (Table 5.2) and larger, beside CGAL's insertion of all pairs into
// one regular triangulation, hidden points discarded. Every measurement is a process of its own, because peak
// memory counts; CPU seconds are the minimum of the repetitions. Not a Google benchmark: memory and ratios
// matter.
//
//   bench_minkowski             # all sizes; a few minutes
//   bench_minkowski 400k 3      # those whose names begin so, three repetitions
//   bench_minkowski write DIR   # the balls of 4M ear + knot as text: tests/data/minkowski, packed with xz -9
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "balls/enlarge.hpp"
#include "balls/select_balls.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "minkowski/minkowski_sum.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

/// A model of the test data, or the generated one that stands for it; its surface is sampled where `samples`
/// > 0.
struct Model {
  const char *file, *stand_in;
  std::int64_t samples;
  double epsilon;  // of the pruning
  double size;     // its longest bounding-box edge becomes this; 0: stays
};

Balls pruned(const Model& model) {
  SampleOptions options;
  options.file = test::data_file(model.file);
  if (options.file.empty()) options.file = model.stand_in;
  if (model.samples > 0) {
    options.mode = SampleMode::surface;
    options.count = model.samples;
  }
  const MeshFile mesh = sample(options, 0);
  const Box box = bounding_box(mesh.points.points);
  const Balls inner = label_poles(voronoi_poles(mesh.points, {}), mesh.mesh, {}).inner;
  const CoverMatrix matrix =
      cover_matrix(enlarge(inner, mesh.points, {}, {.epsilon = model.epsilon}).balls, mesh.points);
  const Balls few = select_balls(greedy(matrix.cover), matrix.balls, {});
  const double scale = model.size > 0 ? model.size / box.longest_edge() : 1;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < few.size(); ++i) {
    centers.push_back(scale * few.centers[i]);
    radii.push_back(scale * few.radii[i]);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

struct Case {
  const char* name;
  Model a, b;
};

const Model ear{"generated/innerEarLike.off.gz", "shape:doubleTorus?n=40000", 0, 0.07, 0};
const Model coarse_ear{"generated/innerEarLike.off.gz", "shape:doubleTorus?n=40000", 0, 0.23, 0};
const Model tube{"generated/stube_500.off.gz", "shape:sTube?n=3000", 3000, 0.36, 0};
const Model knot{"generated/knot_992.off.gz", "shape:knot?n=6000", 6000, 0.26, 0};
const Model coarse_knot{"generated/knot_992.off.gz", "shape:knot?n=2000", 2500, 0.26, 0};
// The bunny is 40 times smaller than the knot; both get one size.
const Model bunny{"models/stanford_bunny.obj.gz", "shape:3cross?n=36000", 0, 0.05, 1};
const Model dense_knot{"generated/knot_992.off.gz", "shape:knot?n=15000", 15000, 0.125, 1};

const Model densest_knot{"generated/knot_992.off.gz", "shape:knot?n=100000", 100'000, 0.03, 1};

const std::vector<Case> cases{{"400k ear + s-tube", ear, tube},
                              {"400k coarse ear + coarse knot", coarse_ear, coarse_knot},
                              {"4M ear + knot", ear, knot},
                              {"18M bunny + dense knot", bunny, dense_knot},
                              {"115M bunny + densest knot", bunny, densest_knot}};

struct Result {
  double seconds = 0, megabytes = 0, survivors = 0, count = 0, touching = 0, first_thread = 0;
};

/// What work() returns, computed in a process of its own: the peak memory of a process begins with what its
/// parent holds.
std::vector<double> in_a_process(const std::function<std::vector<double>()>& work) {
  int channel[2];
  if (pipe(channel) != 0) std::abort();
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const std::vector<double> numbers = work();
    std::FILE* out = fdopen(channel[1], "wb");
    const bool written = std::fwrite(numbers.data(), sizeof(double), numbers.size(), out) == numbers.size();
    _exit(std::fclose(out) == 0 && written ? 0 : 1);
  }
  close(channel[1]);
  std::vector<double> numbers;
  std::FILE* in = fdopen(channel[0], "rb");
  for (double x = 0; std::fread(&x, sizeof x, 1, in) == 1;) numbers.push_back(x);
  std::fclose(in);
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0) {
    std::printf("a measurement failed\n");
    std::exit(1);
  }
  return numbers;
}

Balls make(const Model& model) {
  const std::vector<double> numbers = in_a_process([&model] {
    const Balls balls = pruned(model);
    std::vector<double> flat;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Vec3 c = balls.centers[i];
      flat.insert(flat.end(), {c.x, c.y, c.z, balls.radii[i]});
    }
    return flat;
  });
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    centers.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    radii.push_back(numbers[i + 3]);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

/// CPU time and peak memory of `work`, which fills in the numbers of balls.
Result measure(const std::function<void(Result&)>& work) {
  const std::vector<double> numbers = in_a_process([&work]() -> std::vector<double> {
    Result result;
    timespec begin{}, end{}, thread{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    work(result);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &thread);  // of a process that has done nothing else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {static_cast<double>(end.tv_sec - begin.tv_sec) +
                1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec),
            static_cast<double>(usage.ru_maxrss) / 1024,
            result.survivors,
            result.count,
            result.touching,
            static_cast<double>(thread.tv_sec) + 1e-9 * static_cast<double>(thread.tv_nsec)};
  });
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

Result sum(const Balls& a, const Balls& b, const MinkowskiSumOptions& options) {
  return measure([&](Result& result) {
    const MinkowskiReport report = minkowski_sum(a, b, options).report;
    result.survivors = static_cast<double>(report.survivors);
    result.count = static_cast<double>(report.count);
    result.touching = static_cast<double>(report.touching_boundary);
  });
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Weighted_point_3;
using Cell = CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_3<Kernel>,
                                                     CGAL::Discard_hidden_points>;
using Bare = CGAL::Regular_triangulation_vertex_base_3<Kernel>;
using Indexed = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel, Bare>;

/// What there is to beat, and nothing but the insertion: no test of the vertices.
template <class Vertex>
Result cgal(const Balls& a, const Balls& b) {
  using Triangulation =
      CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  constexpr bool indexed = std::is_same_v<Vertex, Indexed>;
  using Item = std::conditional_t<indexed, std::pair<Point, std::int32_t>, Point>;
  return measure([&](Result& result) {
    std::vector<Item> points;
    points.reserve(a.size() * b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        const Vec3 c = a.centers[i] + b.centers[j];
        const double r = a.radii[i] + b.radii[j];
        const Point point(Kernel::Point_3(c.x, c.y, c.z), r * r);
        if constexpr (indexed) {
          points.emplace_back(point, static_cast<std::int32_t>(points.size()));
        } else {
          points.push_back(point);
        }
      }
    }
    const Triangulation triangulation(points.begin(), points.end());
    result.survivors = static_cast<double>(triangulation.number_of_vertices());
  });
}

Result best_of(int repetitions, const std::function<Result()>& run) {
  Result best = run();
  for (int k = 1; k < repetitions; ++k) {
    const Result next = run();
    best.seconds = std::min(best.seconds, next.seconds);
    best.megabytes = std::max(best.megabytes, next.megabytes);
  }
  return best;
}

void report(const Case& size, int repetitions) {
  const Balls a = make(size.a), b = make(size.b);
  std::printf("%s: %zu x %zu = %zu pairs\n", size.name, a.size(), b.size(), a.size() * b.size());
  if (a.size() * b.size() > 50'000'000) {  // what has a list of all pairs takes gigabytes
    const Result r = sum(a, b, {});
    std::printf(
        "  filtered   %8.2f s (%.2f s of the first thread) %6.0f MB  %9.0f survivors %8.0f contribute\n",
        r.seconds, r.first_thread, r.megabytes, r.survivors, r.count);
    return;
  }
  const Result with_index = best_of(repetitions, [&] { return cgal<Indexed>(a, b); });
  const Result bare = best_of(repetitions, [&] { return cgal<Bare>(a, b); });
  for (const auto& [name, r] : {std::pair{"CGAL", with_index}, std::pair{"CGAL, bare", bare}}) {
    std::printf("  %-10s %8.2f s %6.0f MB  %9.0f vertices\n", name, r.seconds, r.megabytes, r.survivors);
  }
  struct Algorithm {
    const char* name;
    MinkowskiAlgorithm value;
  };
  for (const auto& [name, value] :
       {Algorithm{"filtered", MinkowskiAlgorithm::filtered}, Algorithm{"time", MinkowskiAlgorithm::time},
        Algorithm{"memory", MinkowskiAlgorithm::memory},
        Algorithm{"hierarchical", MinkowskiAlgorithm::hierarchical}}) {
    if (value == MinkowskiAlgorithm::memory && a.size() * b.size() > 1'000'000) continue;  // minutes
    const Result r = best_of(value == MinkowskiAlgorithm::memory ? 1 : repetitions,
                             [&, algorithm = value] { return sum(a, b, {.algorithm = algorithm}); });
    std::printf(
        "  %-10s %8.2f s %6.0f MB  %9.0f survivors %8.0f contribute %7.0f on the boundary  %.2f x CGAL, %.2f "
        "x bare\n",
        name, r.seconds, r.megabytes, r.survivors, r.count, r.touching, r.seconds / with_index.seconds,
        r.seconds / bare.seconds);
  }
  const Result least = sum(a, b, {.keep = MinkowskiKeep::minimal});
  std::printf("  minimal    %8.2f s %6.0f MB  %8.0f are needed\n", least.seconds, least.megabytes,
              least.count);
}

/// x y z r in a line, such that reading gives the same doubles.
void write(const Model& model, const std::string& file) {
  const Balls balls = make(model);
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) {
    std::printf("%s cannot be written\n", file.c_str());
    std::exit(1);
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    std::fprintf(out, "%.17g %.17g %.17g %.17g\n", c.x, c.y, c.z, balls.radii[i]);
  }
  std::fclose(out);
  std::printf("%s: %zu balls\n", file.c_str(), balls.size());
}

}  // namespace
}  // namespace ballflow::geometry

int main(int argc, char** argv) {
  if (argc > 2 && std::strcmp(argv[1], "write") == 0) {
    ballflow::geometry::write(ballflow::geometry::ear, std::string(argv[2]) + "/inner_ear.xyzr");
    ballflow::geometry::write(ballflow::geometry::knot, std::string(argv[2]) + "/knot.xyzr");
    return 0;
  }
  const std::string wanted = argc > 1 ? argv[1] : "";
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 3;
  double load[3] = {0, 0, 0};
  if (getloadavg(load, 3) > 0) std::printf("load %.1f\n", load[0]);
  for (const auto& size : ballflow::geometry::cases) {
    if (std::string(size.name).rfind(wanted, 0) == 0) ballflow::geometry::report(size, repetitions);
  }
}
