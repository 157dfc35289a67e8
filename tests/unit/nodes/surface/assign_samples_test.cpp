// Samples and their vertices, against all pairs in whole numbers.
#include "surface/assign_samples.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <random>
#include <vector>

namespace ballflow::geometry {
namespace {

// Whole numbers small enough for 128 bits, too large for the 53 of doubles.
__extension__ typedef __int128 Whole;

Whole power(Vec3 p, Vec3 c, double radius) {
  const auto whole = [](double x) { return static_cast<Whole>(static_cast<std::int64_t>(x)); };
  const Whole x = whole(p.x) - whole(c.x), y = whole(p.y) - whole(c.y), z = whole(p.z) - whole(c.z);
  return x * x + y * y + z * z - whole(radius) * whole(radius);
}

struct Instance {
  Balls balls;
  PointSet points;
};

/// Whole coordinates up to `size`; radii up to `largest`, whose squares are doubles.
Instance random_instance(std::mt19937& random, std::int64_t size, std::int64_t largest) {
  std::uniform_int_distribution<std::int64_t> place(0, size), radius(0, largest);
  const auto point = [&] {
    return Vec3{double(place(random)), double(place(random)), double(place(random))};
  };
  std::vector<Vec3> centers, points;
  std::vector<double> radii;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> defining;
  for (int i = 0; i < 150; ++i) {
    centers.push_back(point());
    radii.push_back(static_cast<double>(radius(random)));
    defining.push_back(i);
    offsets.push_back(i + 1);
  }
  for (int i = 0; i < 400; ++i) points.push_back(point());
  return {{centers, radii, offsets, defining}, {points, {}}};
}

std::int32_t least(const Instance& instance, Vec3 p, const std::vector<std::int32_t>& among) {
  std::int32_t best = -1;
  for (const std::int32_t i : among) {
    const auto of = [&](std::int32_t k) {
      const auto at = static_cast<std::size_t>(k);
      return power(p, instance.balls.centers[at], instance.balls.radii[at]);
    };
    if (best < 0 || of(i) < of(best)) best = i;
  }
  return best;
}

TEST(assign_samples, to_the_ball_of_least_power_the_first_where_several_have_it) {
  std::mt19937 random(1);
  // Lattices of few points, where most samples have ties, to numbers whose squares are no doubles.
  for (const auto& [size, largest] : std::vector<std::pair<std::int64_t, std::int64_t>>{
           {4, 2}, {10, 10}, {1000, 100}, {std::int64_t{1} << 31, std::int64_t{1} << 20}}) {
    for (int round = 0; round < 5; ++round) {
      const Instance instance = random_instance(random, size, largest);
      std::vector<std::int32_t> all;
      for (std::int32_t i = 0; i < 150; ++i) all.push_back(i);
      const SampleAssignment found = assign_samples(instance.balls, instance.points, nullptr);
      EXPECT_TRUE(found.vertices.empty());
      for (std::size_t i = 0; i < instance.points.points.size(); ++i)
        ASSERT_EQ(found.balls[i], least(instance, instance.points.points[i], all)) << size << " " << i;
    }
  }
}

TEST(assign_samples, to_vertices_of_the_surface_only) {
  std::mt19937 random(2);
  const Instance instance = random_instance(random, 20, 6);
  SurfaceReport surface;
  // Vertices of every third ball, backwards, each twice, and midpoints between them.
  std::vector<std::int32_t> vertex_balls, among;
  for (std::int32_t i = 0; i < 150; i += 3) among.push_back(i);
  for (int copy = 0; copy < 2; ++copy) {
    for (std::int32_t i = 147; i >= 0; i -= 3) {
      vertex_balls.push_back(i);
      vertex_balls.push_back(-1);
    }
  }
  surface.vertex_balls = vertex_balls;
  const SampleAssignment found = assign_samples(instance.balls, instance.points, &surface);
  const SampleAssignment alone = assign_samples(instance.balls, instance.points, nullptr);
  EXPECT_EQ(found.balls, alone.balls);
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    const std::int32_t vertex = found.vertices[i];
    ASSERT_LT(vertex, 100);
    ASSERT_EQ(vertex_balls[static_cast<std::size_t>(vertex)],
              least(instance, instance.points.points[i], among));
  }
}

TEST(assign_samples, is_the_same_for_any_number_of_threads) {
  std::mt19937 random(3);
  Instance instance = random_instance(random, 50, 20);
  std::vector<Vec3> many;
  for (int i = 0; i < 12; ++i) {
    for (const Vec3& p : instance.points.points) many.push_back({p.x + 0.125 * i, p.y, p.z});
  }
  const PointSet points{many, {}};
  const auto with = [&](int threads) {
    return tbb::task_arena(threads).execute([&] { return assign_samples(instance.balls, points, nullptr); });
  };
  EXPECT_EQ(with(1).balls, with(4).balls);
}

TEST(assign_samples, refuses_what_has_no_answer) {
  std::mt19937 random(4);
  const Instance instance = random_instance(random, 50, 20);
  EXPECT_THROW(assign_samples({}, instance.points, nullptr), InputError);
  SurfaceReport surface;
  EXPECT_THROW(assign_samples(instance.balls, instance.points, &surface), InputError);
  surface.vertex_balls = {-1};
  EXPECT_THROW(assign_samples(instance.balls, instance.points, &surface), InputError);
  surface.vertex_balls = {150};
  EXPECT_THROW(assign_samples(instance.balls, instance.points, &surface), InputError);
  const PointSet fewer{{{0, 0, 0}}, {}};
  EXPECT_THROW(assign_samples(instance.balls, instance.points, nullptr, &fewer), InputError);
  EXPECT_EQ(assign_samples(instance.balls, fewer, nullptr, &fewer).points, fewer.points);
  EXPECT_TRUE(assign_samples(instance.balls, {}, nullptr).balls.empty());
}

}  // namespace
}  // namespace ballflow::geometry
