#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <random>

#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

/// Balls of which many touch in one point, and some lie in a plane.
Balls random_balls(unsigned seed, std::size_t count, bool flat) {
  std::mt19937 random(seed);
  const auto step = [&] { return static_cast<double>(random() % 40) / 4; };
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = step(), y = step(), z = step();
    centers.push_back({x, y, flat ? 0 : z});
    radii.push_back(0.125 * static_cast<double>(random() % 4 + 1));
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

TEST(alpha_shape, is_the_same_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  for (const bool flat : {false, true}) {
    const Balls balls = random_balls(3, 6000, flat);
    const auto with_threads = [&](int threads) {
      return tbb::task_arena(threads).execute([&] { return alpha_shape(balls, {}, no_monitor()); });
    };
    const SimplicialComplex one = with_threads(1);
    EXPECT_GT(one.edges.size(), 100u);
    for (const int threads : {2, 4}) {
      const SimplicialComplex many = with_threads(threads);
      EXPECT_EQ(many.vertices, one.vertices);
      EXPECT_EQ(many.edges, one.edges);
      EXPECT_EQ(many.triangles, one.triangles);
      EXPECT_EQ(many.tetrahedra, one.tetrahedra);
      EXPECT_EQ(many.vertex_classes, one.vertex_classes);
      EXPECT_EQ(many.edge_classes, one.edge_classes);
      EXPECT_EQ(many.triangle_classes, one.triangle_classes);
      EXPECT_EQ(many.betti, one.betti);
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
