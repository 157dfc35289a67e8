// Alpha-shapes against those of GUDHI.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "alpha_cases.hpp"
#include "gudhi_oracle.hpp"
#include "power/regular_cells.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using alpha_cases::grid_balls;
using alpha_cases::make_balls;
using alpha_cases::random_balls;
using alpha_cases::shape_of;
using alpha_cases::simplices_of;
using alpha_cases::uniform;
using alpha_cases::uniform_point;

void expect_as_gudhi(const Balls& balls) {
  const SimplicialComplex complex = shape_of(balls);
  const test::GudhiComplex expected = test::gudhi_complex(complex.centers, complex.weights);
  EXPECT_EQ(simplices_of(complex), expected.simplices);
  EXPECT_EQ(complex.betti, expected.betti);
}

TEST(alpha_shape, agrees_with_gudhi_on_small_random_sets) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 150; ++round) {
    const int n = 4 + static_cast<int>(random() % 40);
    expect_as_gudhi(random_balls(random, n, 0, uniform(random, 0.05, 0.6)));
    if (HasFailure()) FAIL() << "round " << round << ", " << n << " balls";
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_degenerate_grids) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 150; ++round) {
    Balls balls = grid_balls(random, 6 + static_cast<int>(random() % 40), 2 + static_cast<int>(random() % 4));
    if (regular_cells(balls.centers, balls.radii, no_monitor()).dimension < 3) continue;
    expect_as_gudhi(balls);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_thousands_of_balls) {
  std::mt19937_64 random(3);
  expect_as_gudhi(random_balls(random, 3000, 0, 0.09));
}

TEST(alpha_shape, agrees_with_gudhi_when_radii_span_twelve_orders_of_magnitude) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 10; ++round) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(10.0, uniform(random, -12, 0));
      centers.push_back(0.5 * (uniform_point(random) - Vec3{0.5, 0.5, 0.5}));
      if (i % 2 == 1) centers.back() = centers[static_cast<std::size_t>(i) - 1] + 3 * size * centers.back();
      radii.push_back(0.3 * size);
    }
    expect_as_gudhi(make_balls(std::move(centers), std::move(radii)));
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_a_real_model) {
  const std::string path = test::data_file("models/kitten_points.xyz.gz");
  if (path.empty()) GTEST_SKIP() << "models/kitten_points.xyz.gz is not there";
  std::vector<Vec3> centers;
  gzFile file = gzopen(path.c_str(), "rb");
  char line[256];
  Vec3 p;
  while (gzgets(file, line, sizeof line) != nullptr) {
    if (std::sscanf(line, "%lf %lf %lf", &p.x, &p.y, &p.z) == 3) centers.push_back(p);
  }
  gzclose(file);
  ASSERT_GT(centers.size(), 5000u);
  expect_as_gudhi(make_balls(centers, 0.02 * bounding_box(centers).longest_edge()));
}

TEST(alpha_shape, of_flat_input_is_that_of_the_input_with_far_points_added) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 60; ++round) {
    const bool collinear = round % 3 == 0;
    std::vector<Vec3> centers;
    std::vector<double> radii;
    const int n = 1 + static_cast<int>(random() % 30);
    for (int i = 0; i < n; ++i) {
      const double x = static_cast<double>(random() % 16),
                   y = collinear ? 3 : static_cast<double>(random() % 16);
      centers.push_back({x, y, x + y});
      radii.push_back(0.25 * static_cast<double>(random() % 12));
    }
    const SimplicialComplex flat = shape_of(make_balls(centers, radii));
    EXPECT_EQ(flat.betti[2], 0);
    for (const auto kind : flat.edge_classes) EXPECT_NE(kind, 0);
    for (const auto kind : flat.vertex_classes) EXPECT_NE(kind, 0);

    for (const Vec3 far : {Vec3{0, 0, 4096}, {0, 0, -4096}, {0, 4096, 0}, {4096, 0, 0}}) {
      centers.push_back(far);
      radii.push_back(0);
    }
    std::vector<double> weights;
    for (const double r : radii) weights.push_back(r * r);
    test::GudhiComplex expected = test::gudhi_complex(centers, weights);
    std::erase_if(expected.simplices, [n](const auto& s) { return s.back() >= n; });
    EXPECT_EQ(simplices_of(flat), expected.simplices) << "round " << round;
    EXPECT_EQ(flat.betti, (Betti{expected.betti[0] - 4, expected.betti[1], expected.betti[2]}));
  }
}

}  // namespace
}  // namespace ballflow::geometry
