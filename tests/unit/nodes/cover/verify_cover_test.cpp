#include "cover/verify_cover.hpp"

#include <gtest/gtest.h>

#include "cover/cover_matrix.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

const VerifyCoverOptions report{.on_uncovered = OnUncovered::report};

TEST(verify_cover, finds_the_same_uncovered_samples_as_the_matrix) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> samples, centers;
    std::vector<double> radii;
    const std::size_t n = random() % 400, m = random() % 40;
    const double flat = round % 3 == 0 ? 0 : 1;
    for (std::size_t j = 0; j < n; ++j) {
      samples.push_back({10 * test::unit(random), test::unit(random), flat * test::unit(random)});
    }
    for (std::size_t i = 0; i < m; ++i) {
      centers.push_back({14 * test::unit(random) - 2, test::unit(random), flat * test::unit(random)});
      radii.push_back(test::unit(random) * (i % 9 == 0 ? 3 : 0.3));
    }
    const Balls balls{centers, radii, {}, {}};
    const PointSet points{samples, {}};
    const CoverCheck check = verify_cover(balls, points, report);
    EXPECT_EQ(check.uncovered,
              cover_matrix(balls, points, {.uncovered = UncoveredPolicy::report}).cover.uncovered);
    EXPECT_EQ(check.samples, static_cast<std::int64_t>(n));
    EXPECT_EQ(check.balls, static_cast<std::int64_t>(m));
  }
}

TEST(verify_cover, notices_each_single_ball_that_is_missing) {
  std::vector<Vec3> points;
  for (int k = 0; k < 30; ++k) points.push_back({1.0 * k, 0, 0});
  for (std::size_t missing = 0; missing < points.size(); ++missing) {
    std::vector<Vec3> centers = points;
    centers.erase(centers.begin() + static_cast<std::ptrdiff_t>(missing));
    const Balls balls{centers, std::vector<double>(centers.size(), 0.9), {}, {}};
    EXPECT_EQ(verify_cover(balls, {points, {}}, report).uncovered,
              (Array<std::int32_t>{static_cast<std::int32_t>(missing)}));
  }
}

TEST(verify_cover, counts_defining_samples_as_covered) {
  const PointSet points{{{0, 0, 0}, {5, 0, 0}}, {}};
  EXPECT_TRUE(verify_cover({{{0, 0, 0}}, {1}, {0, 1}, {1}}, points).uncovered.empty());
}

TEST(verify_cover, names_the_first_uncovered_sample) {
  try {
    verify_cover({{{0, 0, 0}}, {1}, {}, {}}, {{{0, 0, 0}, {5, 0, 0}, {6, 0, 0}}, {}});
    FAIL() << "two samples are uncovered";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("2 of 3 samples are in none of the 1 balls, the first is sample 1"),
        std::string::npos)
        << error.what();
  }
}

TEST(verify_cover, accepts_no_balls_and_no_samples) {
  EXPECT_TRUE(verify_cover({}, {}).uncovered.empty());
  EXPECT_EQ(verify_cover({}, {{{0, 0, 0}}, {}}, report).uncovered.size(), 1u);
}

TEST(verify_cover, finds_samples_far_from_a_dense_cluster) {
  std::vector<Vec3> samples;
  for (int k = 0; k < 2000; ++k) samples.push_back({1e-6 * k, 0, 0});
  samples.push_back({1e6, 1e6, -1e6});
  const Balls balls{{{1e-3, 0, 0}}, {2e-3}, {}, {}};
  EXPECT_EQ(verify_cover(balls, {samples, {}}, report).uncovered, (Array<std::int32_t>{2000}));
}

}  // namespace
}  // namespace ballflow::geometry
