#include "cover/verify_cover.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/local_search.hpp"
#include "cover/reduce.hpp"
#include "cover_oracle.hpp"
#include "search/membership.hpp"

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

TEST(verify_cover, a_sample_without_a_candidate_is_told_and_no_error) {
  const Balls balls{{{0, 0, 0}}, {1}, {}, {}};
  const PointSet points{{{3, 0, 0}, {0, 0.5, 0}}, {}};
  const CoverMatrix matrix = cover_matrix(balls, points);
  EXPECT_EQ(matrix.cover.uncovered, (Array<std::int32_t>{0}));
  verify_uncovered(matrix.cover, balls, points);
  const CoverCheck check = verify_cover(balls, points, {}, no_monitor(), matrix.cover.uncovered.span());
  EXPECT_EQ(check.uncovered, (Array<std::int32_t>{0}));
  // The other one has a candidate: without it the check fails whatever else is excused.
  EXPECT_THROW(verify_cover({}, points, {}, no_monitor(), matrix.cover.uncovered.span()), InputError);
}

TEST(verify_cover, a_cover_that_lists_a_sample_with_a_candidate_is_refused) {
  const PointSet points{{{3, 0, 0}, {0, 0.5, 0}}, {}};
  const Balls balls{{{0, 0, 0}}, {1}, {}, {}}, defined{{{9, 9, 9}}, {1}, {0, 1}, {1}};
  CoverState cover = cover_matrix(balls, points).cover;
  cover.uncovered = {0, 1};
  for (const Balls& candidates : {balls, defined}) {
    try {
      verify_uncovered(cover, candidates, points);
      FAIL() << "sample 1 has a candidate";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("sample 1 is in ball 0"), std::string::npos) << error.what();
    }
  }
  cover.uncovered = {7};
  EXPECT_THROW(verify_uncovered(cover, balls, points), InputError);
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

/// A pruned torus: its balls, samples, and a state with essential balls and a large component.
struct Pruned {
  Balls balls;
  PointSet points;
  CoverState cover;
};

Pruned pruned_torus(std::uint32_t seed) {
  const test::Scene scene = test::torus(1500, 0.02, seed);
  const CoverMatrix matrix = cover_matrix(scene.balls, scene.points);
  return {matrix.balls, scene.points, lagrangian_bound(reduce(matrix.cover))};
}

TEST(verify_certificate, confirms_from_geometry_what_the_strategy_claims) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const Pruned p = pruned_torus(seed);
    ASSERT_GT(p.cover.settled_groups, 0);
    EXPECT_EQ(verify_certificate(p.cover, p.balls, p.points), p.cover.lower_bound);
    const CoverState covered = local_search(p.cover, {.min_steps = 1000});
    EXPECT_EQ(verify_certificate(covered, p.balls, p.points), covered.lower_bound);
    EXPECT_LT(*covered.gap(), 0.2);
  }
}

TEST(verify_certificate, accepts_a_state_without_a_certificate_and_proves_nothing) {
  const test::Scene scene = test::torus(200, 0.05, 4);
  const CoverState cover = greedy(cover_matrix(scene.balls, scene.points).cover);
  EXPECT_EQ(verify_certificate(cover, scene.balls, scene.points), 0);
}

std::string refusal(const CoverState& cover, const Balls& balls, const PointSet& points) {
  try {
    verify_certificate(cover, balls, points);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(verify_certificate, refuses_prices_that_were_raised_where_a_ball_has_no_room) {
  const Pruned p = pruned_torus(5);
  std::mt19937 random(81);
  std::vector<std::int32_t> prices(p.cover.certificate_prices.begin(), p.cover.certificate_prices.end());
  // Every price of a Lagrangian certificate is tight: some ball of the sample costs 1.
  for (int round = 0; round < 60; ++round) {
    const std::size_t k = random() % prices.size();
    auto forged = prices;
    if (forged[k] == price_unit) continue;
    ++forged[k];
    CoverState cover = p.cover;
    cover.certificate_prices = forged;
    cover.lower_bound = std::max(cover.lower_bound, cover.certified_bound());
    ASSERT_NE(refusal(cover, p.balls, p.points).find("more than 1"), std::string::npos) << k;
  }
}

TEST(verify_certificate, refuses_a_group_that_was_split_to_be_rounded_up_twice) {
  const Pruned p = pruned_torus(6);
  const auto& groups = p.cover.certificate_groups;
  int refused = 0;
  for (std::size_t k = 1; k < groups.size(); ++k) {
    if (groups[k] != groups[k - 1]) continue;
    std::vector<std::int32_t> forged(groups.begin(), groups.end());
    for (std::size_t i = k; i < forged.size(); ++i) ++forged[i];
    CoverState cover = p.cover;
    cover.certificate_groups = forged;
    cover.lower_bound = std::max(cover.lower_bound, cover.certified_bound());
    if (cover.certified_bound() == p.cover.certified_bound()) continue;
    ASSERT_NE(refusal(cover, p.balls, p.points).find("of the groups"), std::string::npos) << k;
    if (++refused == 40) break;
  }
  EXPECT_GT(refused, 0);
}

TEST(verify_certificate, refuses_more_than_its_prices_prove) {
  const Pruned p = pruned_torus(7);
  CoverState cover = p.cover;
  cover.lower_bound += 1;
  EXPECT_NE(refusal(cover, p.balls, p.points).find("called certified"), std::string::npos);
}

TEST(verify_certificate, refuses_another_sample_in_place_of_a_witness) {
  const Pruned p = pruned_torus(8);
  std::mt19937 random(82);
  std::vector<std::int32_t> samples(p.cover.certificate_samples.begin(), p.cover.certificate_samples.end());
  std::vector<bool> listed(p.points.points.size());
  for (const std::int32_t s : samples) listed[static_cast<std::size_t>(s)] = true;
  int refused = 0, tried = 0;
  for (std::size_t k = 0; k < samples.size() && tried < 50; ++k) {
    if (p.cover.certificate_prices[k] != price_unit) continue;
    std::int32_t other = 0;
    do {
      other = static_cast<std::int32_t>(random() % listed.size());
    } while (listed[static_cast<std::size_t>(other)]);
    auto forged = samples;
    forged[k] = other;
    CoverState cover = p.cover;
    cover.certificate_samples = forged;
    ++tried;
    refused += refusal(cover, p.balls, p.points).empty() ? 0 : 1;
  }
  EXPECT_GT(tried, 10);
  EXPECT_GE(refused * 10, tried * 9);  // another sample may be as hard to reach
}

TEST(verify_certificate, refuses_samples_in_no_ball_for_which_nobody_pays) {
  Pruned p = pruned_torus(11);
  const CoverState honest = p.cover;
  std::vector<Vec3> places(p.points.points.begin(), p.points.points.end());
  const auto far = static_cast<std::int32_t>(places.size());
  places.push_back({50, 0, 0});
  places.push_back({60, 0, 0});
  p.points.points = places;
  p.cover.samples += 2;
  ASSERT_EQ(refusal(p.cover, p.balls, p.points), "") << "samples in no ball that have no price";
  // Each in a group of its own and at price 1: the bound claims two balls more.
  std::vector<std::int32_t> samples(honest.certificate_samples.begin(), honest.certificate_samples.end()),
      prices(honest.certificate_prices.begin(), honest.certificate_prices.end()),
      groups(honest.certificate_groups.begin(), honest.certificate_groups.end());
  for (const std::int32_t s : {far, far + 1}) {
    samples.push_back(s);
    prices.push_back(static_cast<std::int32_t>(price_unit));
    groups.push_back(groups.back() + 1);
  }
  p.cover.certificate_samples = samples;
  p.cover.certificate_prices = prices;
  p.cover.certificate_groups = groups;
  p.cover.lower_bound = p.cover.certified_bound();
  ASSERT_EQ(p.cover.lower_bound, honest.certified_bound() + 2);
  ASSERT_EQ(broken_invariant(p.cover), "");
  const std::string cause = refusal(p.cover, p.balls, p.points);
  EXPECT_NE(cause.find("sample " + std::to_string(far) + " at (50, 0, 0) is in none of the"),
            std::string::npos)
      << cause;
  // A ball of its own, and it is true.
  std::vector<Vec3> centers(p.balls.centers.begin(), p.balls.centers.end());
  std::vector<double> radii(p.balls.radii.begin(), p.balls.radii.end());
  for (const double x : {50.0, 60.0}) {
    centers.push_back({x, 0, 0});
    radii.push_back(1);
  }
  p.cover.balls += 2;
  EXPECT_EQ(verify_certificate(p.cover, {centers, radii, {}, {}}, p.points), p.cover.lower_bound);
}

template <class Run>
auto with_threads(int threads, Run run) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(run);
}

TEST(verify_cover, does_not_depend_on_the_number_of_threads) {
  const test::Scene scene = test::torus(6000, 0.02, 12);
  // Every third ball, so that some samples are in none.
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < scene.balls.size(); i += 3) {
    centers.push_back(scene.balls.centers[i]);
    radii.push_back(0.9 * scene.balls.radii[i]);
  }
  const Balls balls{centers, radii, {}, {}};
  const auto check = [&] { return verify_cover(balls, scene.points, {.on_uncovered = OnUncovered::report}); };
  const CoverCheck one = with_threads(1, check);
  std::vector<std::int32_t> expected;  // by brute force
  for (std::size_t s = 0; s < scene.points.points.size(); ++s) {
    bool in_one = false;
    for (std::size_t i = 0; i < balls.size() && !in_one; ++i) {
      in_one = in_reach(balls.centers[i], squared_reach(balls.radii[i]), scene.points.points[s]);
    }
    if (!in_one) expected.push_back(static_cast<std::int32_t>(s));
  }
  EXPECT_GT(expected.size(), 10u);
  EXPECT_LT(expected.size(), scene.points.points.size());
  EXPECT_EQ(one.uncovered, Array<std::int32_t>(expected));
  for (const int threads : {2, 4}) EXPECT_EQ(with_threads(threads, check).uncovered, one.uncovered);
}

TEST(verify_certificate, names_the_same_ball_whatever_the_number_of_threads) {
  // All prices are doubled: most balls cost too much, in many blocks.
  const test::Scene scene = test::torus(3000, 0.05, 13);
  CoverState cover = lagrangian_bound(cover_matrix(scene.balls, scene.points).cover);
  std::vector<std::int32_t> prices(cover.certificate_prices.begin(), cover.certificate_prices.end());
  for (std::int32_t& price : prices) price = std::min<std::int32_t>(2 * price, price_unit);
  cover.certificate_prices = prices;
  cover.lower_bound = std::max(cover.lower_bound, cover.certified_bound());
  const auto run = [&] { return refusal(cover, scene.balls, scene.points); };
  const std::string one = with_threads(1, run);
  EXPECT_NE(one.find("more than 1"), std::string::npos) << one;
  for (const int threads : {2, 4}) {
    for (int round = 0; round < 5; ++round) EXPECT_EQ(with_threads(threads, run), one);
  }
}

TEST(verify_certificate, a_mutated_certificate_is_refused_or_still_true) {
  // Small enough for the optimum: whatever passes must be a true bound.
  std::mt19937 random(83);
  int refused = 0, passed = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto coordinate = [&] { return 0.25 * static_cast<double>(random() % 9); };
    std::vector<Vec3> points, centers;
    std::vector<double> radii;
    for (int j = 0; j < 14; ++j) points.push_back({coordinate(), coordinate(), 0.1 * j});
    for (int i = 0; i < 10; ++i) {
      centers.push_back({coordinate(), coordinate(), 0.7});
      radii.push_back(0.3 + 0.1 * static_cast<double>(random() % 10));
    }
    const Balls balls{centers, radii, {}, {}};
    const PointSet samples{points, {}};
    const CoverMatrix matrix = cover_matrix(balls, samples, {.uncovered = UncoveredPolicy::report});
    const std::int64_t best = test::optimum(matrix.cover);
    CoverState cover = lagrangian_bound(reduce(matrix.cover));
    ASSERT_EQ(verify_certificate(cover, balls, samples), cover.certified_bound());
    if (cover.certificate_samples.empty()) continue;
    std::vector<std::int32_t> ids(cover.certificate_samples.begin(), cover.certificate_samples.end());
    std::vector<std::int32_t> prices(cover.certificate_prices.begin(), cover.certificate_prices.end());
    std::vector<std::int32_t> groups(cover.certificate_groups.begin(), cover.certificate_groups.end());
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t k = random() % ids.size();
      switch (random() % 4) {
        case 0:
          ids[k] = static_cast<std::int32_t>(random() % 16) - 1;
          break;
        case 1:
          prices[k] = static_cast<std::int32_t>(random() % (price_unit + 2));
          break;
        case 2:
          groups[k] = static_cast<std::int32_t>(random() % 4) - 1;
          break;
        default:
          for (std::size_t i = k; i < groups.size(); ++i) ++groups[i];
      }
    }
    cover.certificate_samples = ids;
    cover.certificate_prices = prices;
    cover.certificate_groups = groups;
    cover.settled_groups = 0;
    cover.lower_bound = cover.certified_bound();
    try {
      ASSERT_LE(verify_certificate(cover, balls, samples), best);
      ++passed;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(passed, 10);
}

TEST(verify_certificate, refuses_other_balls_and_samples_than_it_is_about) {
  const Pruned p = pruned_torus(9);
  const test::Scene other = test::torus(300, 0.02, 10);
  EXPECT_NE(refusal(p.cover, other.balls, p.points).find("it is about"), std::string::npos);
  EXPECT_NE(refusal(p.cover, p.balls, other.points).find("it is about"), std::string::npos);
  Balls larger = p.balls;
  std::vector<double> radii;
  for (const double r : p.balls.radii) radii.push_back(1.5 * r);
  larger.radii = radii;
  EXPECT_NE(refusal(p.cover, larger, p.points), "");
}

}  // namespace
}  // namespace ballflow::geometry
