#include "cover/cover_matrix.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <string>

#include "cover_oracle.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

using test::row_sets;
using test::Sets;

/// The definition, pair by pair.
Sets brute_force(const Balls& balls, const PointSet& points) {
  Sets rows;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    rows.emplace_back();
    const auto defining = balls.samples_of(i);
    for (std::size_t j = 0; j < points.points.size(); ++j) {
      if (in_reach(balls.centers[i], squared_reach(balls.radii[i]), points.points[j]) ||
          std::find(defining.begin(), defining.end(), static_cast<std::int32_t>(j)) != defining.end()) {
        rows.back().push_back(static_cast<std::int32_t>(j));
      }
    }
  }
  return rows;
}

class Warnings final : public Monitor {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

std::string error_of(const Balls& balls, const PointSet& points, const CoverMatrixOptions& options = {}) {
  try {
    cover_matrix(balls, points, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(cover_matrix, equals_the_definition_tried_pair_by_pair) {
  for (const double epsilon : {0.0, 0.003, 0.05, 0.3}) {
    const auto [balls, points] = test::torus(1500, epsilon, 7);
    const CoverMatrix matrix = cover_matrix(balls, points);
    EXPECT_EQ(broken_invariant(matrix.cover), "");
    EXPECT_EQ(row_sets(matrix.cover), brute_force(balls, points)) << epsilon;
    EXPECT_TRUE(matrix.cover.chosen.empty());
  }
}

TEST(cover_matrix, equals_the_definition_for_balls_of_all_sizes_anywhere) {
  std::mt19937 random(3);
  std::vector<Vec3> samples, centers;
  std::vector<double> radii;
  for (int k = 0; k < 900; ++k) {
    samples.push_back({test::unit(random), test::unit(random), 1e-3 * test::unit(random)});
    centers.push_back({3 * test::unit(random) - 1, 3 * test::unit(random) - 1, test::unit(random)});
    const double u = test::unit(random);
    radii.push_back(u * u * u * 3);
  }
  const Balls balls{centers, radii, {}, {}};
  const PointSet points{samples, {}};
  const CoverMatrix matrix = cover_matrix(balls, points, {.uncovered = UncoveredPolicy::report});
  EXPECT_EQ(broken_invariant(matrix.cover), "");
  EXPECT_EQ(row_sets(matrix.cover), brute_force(balls, points));
  EXPECT_GT(matrix.cover.nnz(), 50'000u);
  EXPECT_LT(matrix.cover.nnz(), 750'000u);
}

TEST(cover_matrix, equals_the_definition_where_every_sample_is_about_as_far_as_the_radius) {
  // Balls around the centre of a noisy sphere: their surfaces cross every leaf of the tree of samples, so
  // answers are too large to be kept from the first pass to the second.
  std::mt19937 random(11);
  std::vector<Vec3> samples, centers;
  std::vector<double> radii;
  while (samples.size() < 9000) {
    const Vec3 p{2 * test::unit(random) - 1, 2 * test::unit(random) - 1, 2 * test::unit(random) - 1};
    if (const double l = length(p); l > 0.1 && l < 1)
      samples.push_back(((1 + 1e-3 * test::unit(random)) / l) * p);
  }
  for (int k = 0; k < 300; ++k) {
    centers.push_back({1e-4 * test::unit(random), 1e-4 * test::unit(random), 1e-4 * test::unit(random)});
    radii.push_back(1 + 1e-3 * test::unit(random));
  }
  const Balls balls{centers, radii, {}, {}};
  const PointSet points{samples, {}};
  EXPECT_EQ(row_sets(cover_matrix(balls, points, {.uncovered = UncoveredPolicy::report}).cover),
            brute_force(balls, points));
}

TEST(cover_matrix, gives_the_same_bytes_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const auto [balls, points] = test::torus(6000, 0.02, 11);
  const auto with_threads = [&, &b = balls, &p = points](int threads) {
    return tbb::task_arena(threads).execute([&] { return cover_matrix(b, p).cover; });
  };
  const CoverState one = with_threads(1);
  EXPECT_TRUE(test::same(one, with_threads(2)));
  EXPECT_TRUE(test::same(one, with_threads(4)));
}

TEST(cover_matrix, counts_defining_samples_that_lie_outside_their_ball) {
  const Balls balls{{{0, 0, 0}}, {1}, {0, 2}, {0, 2}};
  const PointSet points{{{5, 0, 0}, {0, 0.5, 0}, {1, 0, 0}}, {}};
  EXPECT_EQ(row_sets(cover_matrix(balls, points).cover), (Sets{{0, 1, 2}}));
}

TEST(cover_matrix, tolerates_rounding_of_the_radius_and_no_more) {
  const PointSet points{{{1, 0, 0}, {1 + 4e-10, 0, 0}, {1 + 6e-10, 0, 0}}, {}};
  const CoverMatrix matrix =
      cover_matrix({{{0, 0, 0}}, {1}, {}, {}}, points, {.uncovered = UncoveredPolicy::report});
  EXPECT_EQ(row_sets(matrix.cover), (Sets{{0, 1}}));
}

TEST(cover_matrix, gives_an_uncovered_sample_a_ball_of_radius_zero) {
  const Balls balls{{{0, 0, 0}}, {1}, {0, 1}, {1}};
  const PointSet points{{{3, 0, 0}, {0, 0.5, 0}, {4, 0, 0}}, {}};
  Warnings warnings;
  const CoverMatrix matrix = cover_matrix(balls, points, {.uncovered = UncoveredPolicy::ball}, warnings);
  EXPECT_EQ(broken_invariant(matrix.cover), "");
  EXPECT_EQ(row_sets(matrix.cover), (Sets{{1}, {0}, {2}}));
  EXPECT_EQ(matrix.cover.balls, 3);
  EXPECT_TRUE(matrix.cover.uncovered.empty());
  ASSERT_EQ(matrix.balls.size(), 3u);
  EXPECT_EQ(matrix.balls.centers[1], points.points[0]);
  EXPECT_EQ(matrix.balls.centers[2], points.points[2]);
  EXPECT_EQ(matrix.balls.radii[2], 0);
  ASSERT_EQ(matrix.balls.samples_of(2).size(), 1u);
  EXPECT_EQ(matrix.balls.samples_of(2)[0], 2);
  ASSERT_EQ(warnings.texts.size(), 1u);
  EXPECT_NE(warnings.texts[0].find("2 of 3 samples"), std::string::npos) << warnings.texts[0];
  EXPECT_EQ(row_sets(cover_matrix(matrix.balls, points, {.uncovered = UncoveredPolicy::error}).cover),
            row_sets(matrix.cover));
}

TEST(cover_matrix, names_the_first_uncovered_sample) {
  const Balls balls{{{0, 0, 0}}, {1}, {}, {}};
  const PointSet points{{{0, 0.5, 0}, {3, 0, 0}, {4, 0, 0}}, {}};
  const std::string text = error_of(balls, points, {.uncovered = UncoveredPolicy::error});
  EXPECT_NE(text.find("2 of 3 samples lie in no ball, the first is sample 1 at (3, 0, 0)"), std::string::npos)
      << text;
}

TEST(cover_matrix, lists_uncovered_samples_and_leaves_them_out) {
  const Balls balls{{{0, 0, 0}, {0, 0, 9}}, {1, 1}, {}, {}};
  const PointSet points{{{3, 0, 0}, {0, 0.5, 0}, {4, 0, 0}, {0, 0, 9}}, {}};
  const CoverMatrix matrix = cover_matrix(balls, points, {.uncovered = UncoveredPolicy::report});
  EXPECT_EQ(broken_invariant(matrix.cover), "");
  EXPECT_EQ(row_sets(matrix.cover), (Sets{{1}, {3}}));
  EXPECT_EQ(matrix.cover.uncovered, (Array<std::int32_t>{0, 2}));
  EXPECT_EQ(matrix.balls.size(), 2u);
}

TEST(cover_matrix, keeps_a_ball_that_covers_nothing) {
  const CoverState cover = cover_matrix({{{9, 0, 0}, {0, 0, 0}}, {1, 1}, {}, {}}, {{{0, 0, 0.5}}, {}}).cover;
  EXPECT_EQ(row_sets(cover), (Sets{{}, {0}}));
}

TEST(cover_matrix, accepts_no_balls_and_no_samples) {
  const CoverMatrix nothing = cover_matrix({}, {});
  EXPECT_EQ(broken_invariant(nothing.cover), "");
  EXPECT_EQ(nothing.cover.lower_bound, 0);
  const CoverMatrix only_samples = cover_matrix({}, {{{0, 0, 0}, {1, 0, 0}}, {}});
  EXPECT_EQ(broken_invariant(only_samples.cover), "");
  EXPECT_EQ(only_samples.balls.size(), 0u);
  EXPECT_EQ(only_samples.cover.uncovered.size(), 2u);
  const CoverMatrix only_balls = cover_matrix({{{0, 0, 0}}, {1}, {}, {}}, {});
  EXPECT_EQ(broken_invariant(only_balls.cover), "");
  EXPECT_EQ(only_balls.cover.rows(), 1u);
}

TEST(cover_matrix, one_ball_around_everything_is_a_row_of_ones) {
  const auto [balls, points] = test::torus(3000, 0, 5);
  const CoverMatrix matrix = cover_matrix({{{0, 0, 0}}, {2}, {}, {}}, points);
  EXPECT_EQ(matrix.cover.nnz(), 3000u);
  EXPECT_EQ(matrix.cover.lower_bound, 1);
}

TEST(cover_matrix, first_bound_divides_by_the_longest_row) {
  const PointSet points{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {}};
  const CoverMatrix matrix =
      cover_matrix({{{0.5, 0, 0}, {2.5, 0, 0}, {4, 0, 0}}, {0.6, 0.6, 0.1}, {}, {}}, points);
  EXPECT_EQ(matrix.cover.lower_bound, 3);
}

TEST(cover_matrix, does_not_change_when_model_and_balls_are_scaled_by_a_power_of_two) {
  const auto [balls, points] = test::torus(800, 0.01, 2);
  const auto scaled = [](const Array<Vec3>& in) {
    std::vector<Vec3> out;
    for (const Vec3& p : in) out.push_back(0x1p-300 * p);
    return out;
  };
  std::vector<double> radii;
  for (const double r : balls.radii) radii.push_back(0x1p-300 * r);
  const CoverMatrix small =
      cover_matrix({scaled(balls.centers), radii, balls.defining_offsets, balls.defining_samples},
                   {scaled(points.points), {}});
  EXPECT_EQ(row_sets(small.cover), row_sets(cover_matrix(balls, points).cover));
}

TEST(cover_matrix, refuses_a_matrix_above_the_limit_before_it_is_made) {
  const auto [balls, points] = test::torus(500, 0.5, 5);
  const auto entries = static_cast<std::int64_t>(cover_matrix(balls, points).cover.nnz());
  const std::string text = error_of(balls, points, {.max_entries = entries - 1});
  EXPECT_NE(text.find("the matrix would have " + std::to_string(entries) + " entries"), std::string::npos)
      << text;
  EXPECT_EQ(error_of(balls, points, {.max_entries = entries}), "no error");
}

TEST(cover_matrix, refuses_a_matrix_larger_than_the_memory_it_is_granted) {
  struct Grant final : Monitor {
    std::uint64_t memory_bytes() override { return bytes; }
    std::uint64_t bytes = 0;
  } grant;
  const auto [balls, points] = test::torus(500, 0.5, 5);
  const std::uint64_t entries = cover_matrix(balls, points).cover.nnz();
  grant.bytes = 4 * entries;
  EXPECT_EQ(cover_matrix(balls, points, {}, grant).cover.nnz(), entries);
  grant.bytes = 4 * entries - 1;
  try {
    cover_matrix(balls, points, {}, grant);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("; the run may use "), std::string::npos) << error.what();
  }
}

TEST(cover_matrix, refuses_coordinates_whose_squares_overflow) {
  EXPECT_NE(error_of({{{1e200, 0, 0}}, {1}, {}, {}}, {{{0, 0, 0}}, {}}).find("ball 0"), std::string::npos);
  EXPECT_NE(error_of({{{0, 0, 0}}, {1e155}, {}, {}}, {{{0, 0, 0}}, {}}).find("ball 0"), std::string::npos);
  EXPECT_NE(error_of({{{0, 0, 0}}, {1}, {}, {}}, {{{0, 0, 0}, {0, -1e200, 0}}, {}}).find("sample 1"),
            std::string::npos);
}

TEST(cover_matrix, refuses_defining_samples_of_other_points) {
  const std::string text = error_of({{{0, 0, 0}}, {1}, {0, 1}, {7}}, {{{0, 0, 0}}, {}});
  EXPECT_NE(text.find("ball 0 is defined by sample 7 of 1"), std::string::npos) << text;
}

TEST(cover_matrix, stops_when_cancelled) {
  class Stop final : public Monitor {
    bool cancelled() override { return true; }
  } stop;
  const auto [balls, points] = test::torus(500, 0.5, 5);
  EXPECT_THROW(cover_matrix(balls, points, {}, stop), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
