// The samples that Compare takes, how many they may be, and how it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <string>
#include <vector>

#include "compare_cases.hpp"
#include "measure/surface_samples.hpp"

namespace ballflow::geometry {
namespace {

using compare_cases::balls_of;
using compare_cases::cube;
using compare_cases::refusal;
using compare_cases::unit;

TEST(compare, counts_the_samples_of_all_spheres_together) {
  // Every sphere alone has 32 samples.
  std::vector<Vec3> centers;
  for (int i = 0; i < 100; ++i) centers.push_back({0.02 * (i % 10), 0.02 * (i / 10), 0});
  const Balls balls = balls_of(centers, std::vector<double>(100, 0.005));
  CompareOptions options{.spacing = 0.15, .most_samples = 10'000'000};
  const Comparison c = compare(balls, {{Vec3{0, 0, 0}, Vec3{2, 2, 2}}, {}}, {}, options);
  ASSERT_GE(c.union_samples, 100 * 8);
  ASSERT_LT(c.union_samples, 100 * 256) << "or one sphere alone exceeds the budget";
  options.most_samples = c.union_samples - 1;
  EXPECT_NE(refusal(balls, {{Vec3{0, 0, 0}, Vec3{2, 2, 2}}, {}}, {}, options).find("samples of the boundary"),
            std::string::npos);
}

TEST(compare, shares_one_large_triangle_out) {
  class Steps final : public Monitor {
   public:
    void progress(double fraction) override { many += fraction > 0.3 && fraction < 0.5 ? 1 : 0; }
    std::atomic<int> many{0};
  } steps;
  const TriangleMesh triangle{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, {Triangle{0, 1, 2}}};
  const Comparison c = compare(balls_of({{0.3, 0.3, 0}}, {0.2}), {}, triangle, {.spacing = 1}, steps);
  EXPECT_GT(c.surface_samples, 5000);
  EXPECT_GT(steps.many, c.surface_samples / 200) << "each step is a task of its own";
}

TEST(compare, samples_stand_for_the_whole_area_however_blocks_fall) {
  std::mt19937 random(9);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::int32_t t = 0; t < 40; ++t) {
    for (int k = 0; k < 3; ++k) vertices.push_back({unit(random), unit(random), 0.2 * unit(random)});
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const TriangleMesh mesh{vertices, triangles};
  ComparedSurface surface({}, mesh);
  Budget budget(1'000'000, "samples");
  surface.sample(0.05, budget);
  double area = 0, of_samples = 0;
  Vec3 moment, of_sample_moments;
  for (const Triangle& t : triangles) {
    const auto corner = [&](std::size_t k) { return vertices[static_cast<std::size_t>(t[k])]; };
    const double own = length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    area += own;
    moment = moment + own / 3 * (corner(0) + corner(1) + corner(2));
  }
  std::vector<Vec3> at_once, piecemeal;
  surface.for_samples(0, surface.samples(), [&](Vec3 p, double of_part) {
    at_once.push_back(p);
    of_samples += of_part;
    of_sample_moments = of_sample_moments + of_part * p;
  });
  for (std::size_t first = 0; first < surface.samples(); first += 7) {
    surface.for_samples(first, std::min(first + 7, surface.samples()),
                        [&](Vec3 p, double) { piecemeal.push_back(p); });
  }
  EXPECT_EQ(at_once.size(), surface.samples());
  EXPECT_EQ(at_once, piecemeal);
  EXPECT_NEAR(of_samples, area, 1e-12);
  EXPECT_LT(distance(of_sample_moments, moment), 1e-12)
      << "the centroids of the parts have that of the whole";
}

TEST(compare, refuses_what_cannot_be_compared) {
  const Balls ball = balls_of({{0, 0, 0}}, {1});
  EXPECT_NE(refusal(balls_of({}, {}), {}, cube()).find("no balls"), std::string::npos);
  EXPECT_NE(refusal(ball, {}, {}).find("no surface"), std::string::npos);
  EXPECT_NE(refusal(ball, {}, cube(), {.spacing = 0}).find("spacing is 0"), std::string::npos);
  EXPECT_NE(refusal(ball, {}, cube(), {.spacing = 1e-3}).find("30 million samples of the surface"),
            std::string::npos);
  TriangleMesh broken = cube();
  broken.triangles = {Triangle{0, 1, 99}};
  EXPECT_NE(refusal(ball, {}, broken).find("damaged"), std::string::npos);
}

TEST(compare, stops_when_cancelled) {
  class Stop final : public Monitor {
   public:
    bool cancelled() override { return ++looks > 5; }
    std::atomic<int> looks{0};
  } stop;
  EXPECT_THROW(compare(balls_of({{0, 0, 0}}, {1}), {}, cube(), {.spacing = 0.05}, stop), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
