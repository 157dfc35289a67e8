// Figures of Distance: CPU and wall seconds for sets of balls of a size (10^6 unless another one is given).
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "motion/distance.hpp"

namespace ballflow::geometry {
namespace {

Balls cloud(int n, Vec3 corner, double largest, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    centers.push_back(corner + Vec3{u(random), u(random), u(random)});
    radii.push_back(largest * u(random));
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

Balls lattice(int side, double z) {
  std::vector<Vec3> centers;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) centers.push_back({0.125 * i, 0.125 * j, z});
  }
  return {centers, std::vector<double>(centers.size(), 0.0625), {}, {}};
}

void report(const char* name, const Balls& a, const Balls& b, const DistanceOptions& options) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  const BallDistance d = ball_distance(a, b, options, no_monitor());
  std::printf("%-48s %7.3f CPU s %7.3f s   separation %.6g, %zu pairs\n", name,
              static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(), d.separation,
              d.pairs.size());
}

}  // namespace
}  // namespace ballflow::geometry

int main(int count, char** arguments) {
  using namespace ballflow::geometry;
  const int n = count > 1 ? std::atoi(arguments[1]) : 1000000;
  const int side = static_cast<int>(std::sqrt(static_cast<double>(n)));
  const Balls a = cloud(n, {0, 0, 0}, 0.002, 1), apart = cloud(n, {1.1, 0, 0}, 0.002, 2),
              overlapping = cloud(n, {0.5, 0, 0}, 0.002, 3), one = cloud(1, {1.1, 0, 0}, 0.1, 4);
  const Balls equal{std::vector<Vec3>(static_cast<std::size_t>(n), {1, 2, 3}),
                    std::vector<double>(static_cast<std::size_t>(n), 0.5),
                    {},
                    {}};
  report("one ball", a, one, {});
  report("apart", a, apart, {});
  report("apart, all pairs below .05", a, apart, {.threshold = 0.05});
  report("apart, the nearest 1000 pairs", a, apart, {.threshold = 1});
  report("overlapping, no list", a, overlapping, {.most_pairs = 0});
  report("overlapping, the deepest 1000 pairs", a, overlapping, {});
  report("a set and itself", a, a, {});
  report("lattices face to face: as many ties as balls", lattice(side, 0), lattice(side, 1),
         {.threshold = 2});
  report("all balls equal", equal, equal, {});
  report("apart, and the clearance of every ball", a, apart, {.every_ball = true});
}
