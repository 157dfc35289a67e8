// Sums of discs, and what CGAL's regular triangulation of all pairs takes: bench_plane A B [REPETITIONS],
// with two files of discs; without files the discs of two generated polygons. CPU seconds of one thread, the
// least.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "io/load_balls.hpp"
#include "minkowski/minkowski_sum_2.hpp"
#include "planar/disc_poles.hpp"
#include "planar/read_polygon.hpp"

namespace {

using namespace ballflow::geometry;

double best_of(int repetitions, const std::function<void()>& work) {
  double best = 1e9;
  for (int k = 0; k < repetitions; ++k) {
    timespec begin{}, end{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    work();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    best = std::min(best, static_cast<double>(end.tv_sec - begin.tv_sec) +
                              1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec));
  }
  return best;
}

Balls discs(const char* file, const char* polygon) {
  if (file != nullptr) return load_balls({file}).balls;
  return disc_poles(read_polygon({polygon}).polygon, {.spacing = 2}).inner;
}

}  // namespace

int main(int count, char** arguments) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const bool files = count > 2;
  const Balls a = discs(files ? arguments[1] : nullptr, "polygon:sqroot"),
              b = discs(files ? arguments[2] : nullptr, "polygon:euro");
  const int repetitions = count > 3 ? std::atoi(arguments[3]) : 3;
  std::printf("%zu x %zu = %zu pairs\n", a.size(), b.size(), a.size() * b.size());

  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::size_t vertices = 0;
  const double cgal = best_of(repetitions, [&] {
    std::vector<Kernel::Weighted_point_2> points;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        const Vec3 c = a.centers[i] + b.centers[j];
        const double r = a.radii[i] + b.radii[j];
        points.emplace_back(Kernel::Point_2(c.x, c.y), r * r);
      }
    }
    vertices = CGAL::Regular_triangulation_2<Kernel>(points.begin(), points.end()).number_of_vertices();
  });
  std::printf("  %-14s %.4f s  %9zu vertices\n", "CGAL, insertion", cgal, vertices);
  for (const auto& [name, algorithm] : {std::pair("filtered", MinkowskiAlgorithm2::filtered),
                                        std::pair("quadratic", MinkowskiAlgorithm2::quadratic),
                                        std::pair("hierarchical", MinkowskiAlgorithm2::hierarchical)}) {
    MinkowskiSum2 sum;
    const double seconds =
        best_of(repetitions, [&, algorithm = algorithm] { sum = minkowski_sum_2(a, b, {algorithm}); });
    std::printf("  %-14s %.4f s  %9lld triangulated, %lld contribute, %lld with an arc, %lld avoided\n", name,
                seconds, static_cast<long long>(sum.report.survivors),
                static_cast<long long>(sum.report.count),
                static_cast<long long>(sum.report.touching_boundary), static_cast<long long>(sum.avoided));
  }
}
