#include "topology/topology_repair.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cech_oracle.hpp"
#include "homology/inclusion_homology.hpp"
#include "topology/listing_3_2.hpp"
#include "topology/superfluous_balls.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

Ids all_but(std::size_t n, std::set<std::int32_t> without) {
  Ids ids;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(n); ++i) {
    if (!without.contains(i)) ids.push_back(i);
  }
  return ids;
}

Ids merged(Ids a, const Ids& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  return a;
}

Balls make_balls(std::vector<Vec3> centers, double radius) {
  std::vector<double> radii(centers.size(), radius);
  return {std::move(centers), std::move(radii), {}, {}};
}

std::vector<Vec3> circle(int n, double radius = 1) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n;
    points.push_back({radius * std::cos(t), radius * std::sin(t), 0});
  }
  return points;
}

std::vector<Vec3> sphere(int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * i + 1) / n, t = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(t), r * std::sin(t), z});
  }
  return points;
}

/// The repair, whose result is compared with the whole again, by another object.
TopologyRepair repaired(const Balls& balls, const Ids& kept, const TopologyRepairOptions& options = {}) {
  const TopologyRepair repair = repair_topology(balls, kept, options, no_monitor());
  EXPECT_EQ(broken_invariant(repair.check), "");
  EXPECT_TRUE(std::is_sorted(repair.returned.begin(), repair.returned.end()));
  const Ids after = merged(kept, repair.returned);
  EXPECT_EQ(std::adjacent_find(after.begin(), after.end()), after.end()) << "a kept ball was returned";
  EXPECT_TRUE(UnionOfBalls(balls, no_monitor()).inclusion_of(after).isomorphism());
  EXPECT_TRUE(repair.check.inclusion_after().isomorphism());
  EXPECT_EQ(repair.check.returned, static_cast<std::int64_t>(repair.returned.size()));
  return repair;
}

TEST(topology_repair, returns_nothing_where_nothing_is_wrong) {
  const Balls ring = make_balls(circle(24), 0.4);
  const TopologyRepair repair = repaired(ring, {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22});
  EXPECT_TRUE(repair.returned.empty());
  EXPECT_EQ(repair.check.inclusions, 1);
}

TEST(topology_repair, closes_a_ring_with_the_balls_of_the_gap) {
  const Balls ring = make_balls(circle(24), 0.2);
  const TopologyRepair repair = repaired(ring, all_but(24, {5, 6, 7}));
  EXPECT_EQ(repair.check.inclusion_before(), (InclusionHomology{{1, 0, 0}, {1, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(repair.returned, (Ids{5, 6, 7}));
}

TEST(topology_repair, joins_parts_by_the_shortest_way) {
  // Two balls, a bridge of two between them and a detour that leads elsewhere.
  const Balls balls =
      make_balls({{0, 0, 0}, {9, 0, 0}, {3, 0, 0}, {6, 0, 0}, {0, 3, 0}, {0, 6, 0}, {9, 3, 0}}, 1.6);
  EXPECT_EQ(repaired(balls, {0, 1}).returned, (Ids{2, 3}));
}

TEST(topology_repair, begins_a_component_that_is_missing) {
  std::vector<Vec3> centers = circle(24);
  for (const Vec3 p : circle(24)) centers.push_back(p + Vec3{10, 0, 0});
  const Balls balls = make_balls(centers, 0.2);
  Ids first(24);
  std::iota(first.begin(), first.end(), 0);
  const TopologyRepair repair = repaired(balls, first);
  EXPECT_EQ(repair.check.inclusion_before(), (InclusionHomology{{1, 1, 0}, {2, 2, 0}, {1, 1, 0}}));
  EXPECT_EQ(repair.returned.size(), 24u) << "every ball meets its two neighbours only";
}

TEST(topology_repair, fills_a_loop_with_the_ball_that_filled_it) {
  std::vector<Vec3> centers = circle(24);
  std::vector<double> radii(24, 0.2);
  for (const Vec3 p : circle(6, 0.4)) {  // nothing that these can do
    centers.push_back(p);
    radii.push_back(0.1);
  }
  centers.push_back({0, 0, 0});
  radii.push_back(0.9);
  const Balls balls{centers, radii, {}, {}};
  const TopologyRepair repair = repaired(balls, all_but(24, {}));
  EXPECT_EQ(repair.check.inclusion_before(), (InclusionHomology{{1, 1, 0}, {1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(repair.returned, Ids{30});
}

TEST(topology_repair, keeps_the_wall_between_the_inside_and_the_outside_of_a_shell) {
  const Balls shell = make_balls(sphere(200), 0.2);
  const TopologyRepair repair = repaired(shell, all_but(200, {50, 58, 63, 71, 84}));
  EXPECT_EQ(repair.check.whole, (Betti{1, 0, 1}));
  EXPECT_EQ(repair.check.before_rank[2], repair.check.before[2]);
  EXPECT_LE(repair.returned.size(), 5u);
}

TEST(topology_repair, fills_a_cavity_that_the_whole_fills) {
  std::vector<Vec3> centers = sphere(200);
  std::vector<double> radii(200, 0.2);
  centers.push_back({0, 0, 0});
  radii.push_back(1);
  centers.push_back({0.1, 0, 0});
  radii.push_back(0.3);
  const TopologyRepair repair = repaired({centers, radii, {}, {}}, all_but(200, {}));
  EXPECT_EQ(repair.check.inclusion_before(), (InclusionHomology{{1, 0, 1}, {1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(repair.returned, Ids{200});
}

TEST(topology_repair, tells_a_tunnel_lost_and_another_one_gained) {
  std::vector<Vec3> centers = circle(12);
  for (const Vec3 p : circle(12)) centers.push_back(p + Vec3{10, 0, 0});
  std::vector<double> radii(24, 0.4);
  centers.push_back({10, 0, 0});
  radii.push_back(0.9);
  const TopologyRepair repair = repaired({centers, radii, {}, {}}, all_but(25, {3, 24}));
  EXPECT_EQ(repair.check.before, repair.check.whole);
  EXPECT_EQ(repair.returned, (Ids{3, 24}));
  EXPECT_EQ(describe(repair.check.inclusion_before()), "1 tunnel is lost, 1 tunnel is extra");
}

double random_unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

struct Instance {
  Balls balls;
  Ids kept;
};

Instance random_instance(std::mt19937_64& random, std::size_t n, double size, bool grid) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    if (grid) {
      const auto digit = [&] { return static_cast<double>(random() % 4); };
      const double x = digit(), y = digit(), z = digit();
      centers.push_back({x, y, z});
      radii.push_back(0.25 * static_cast<double>(1 + random() % 4));
    } else {
      const double x = random_unit(random), y = random_unit(random), z = random_unit(random);
      centers.push_back({x, y, z});
      radii.push_back(size * (0.5 + 0.5 * random_unit(random)));
    }
  }
  Ids kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (random() % 3 != 0) kept.push_back(static_cast<std::int32_t>(i));
  }
  return {{centers, radii, {}, {}}, kept};
}

TEST(topology_repair, makes_an_isomorphism_that_nerves_confirm) {
  std::mt19937_64 random(1);
  std::int64_t returned = 0, left_out = 0;
  for (int round = 0; round < 120; ++round) {
    const std::size_t n = 6 + random() % 10;
    const Instance instance = random_instance(random, n, 0.2 + 0.3 * random_unit(random), round % 3 == 0);
    const TopologyRepair repair = repaired(instance.balls, instance.kept);
    const Ids after = merged(instance.kept, repair.returned);
    const InclusionHomology truth = test::cech_inclusion(instance.balls, after);
    ASSERT_TRUE(truth.isomorphism()) << "round " << round;
    ASSERT_EQ(repair.check.inclusion_before(), test::cech_inclusion(instance.balls, instance.kept));
    // No returned ball is superfluous by itself.
    for (const std::int32_t ball : repair.returned) {
      Ids less = after;
      less.erase(std::find(less.begin(), less.end(), ball));
      EXPECT_FALSE(test::cech_inclusion(instance.balls, less).isomorphism())
          << "round " << round << ", ball " << ball;
    }
    returned += static_cast<std::int64_t>(repair.returned.size());
    left_out += static_cast<std::int64_t>(n - after.size());
  }
  EXPECT_GT(returned, 50);
  EXPECT_GT(left_out, 50);
}

TEST(topology_repair, mends_larger_random_unions) {
  std::mt19937_64 random(2);
  std::int64_t defective = 0, everything = 0;
  for (int round = 0; round < 12; ++round) {
    const Instance instance = random_instance(random, 150, 0.1 + 0.015 * round, round % 4 == 3);
    const TopologyRepair repair = repaired(instance.balls, instance.kept);
    defective += !repair.check.inclusion_before().isomorphism();
    everything += repair.check.everything;
  }
  EXPECT_GT(defective, 6);
  EXPECT_LT(everything, 3);
}

TEST(topology_repair, only_joins_components_where_more_is_wrong_than_wanted_and_says_so) {
  const Balls ring = make_balls(circle(30), 0.15);
  const Ids kept = all_but(30, {4, 12, 20, 28});  // four pieces: three components extra, one tunnel lost
  const TopologyRepair some = repair_topology(ring, kept, {.most_defects = 3}, no_monitor());
  EXPECT_EQ(some.returned.size(), 3u);
  EXPECT_EQ(some.check.after, (Betti{1, 0, 0}));
  EXPECT_EQ(describe(some.check),
            "3 components are extra, 1 tunnel is lost: 3 balls returned to 26, and still 1 tunnel is lost");
  EXPECT_EQ(repaired(ring, kept, {.most_defects = 4}).returned, (Ids{4, 12, 20, 28}));
}

TEST(without_superfluous, leaves_what_the_union_of_all_needs) {
  std::mt19937_64 random(7);
  std::size_t left = 0, taken = 0;
  for (int round = 0; round < 8; ++round) {
    const Instance instance = random_instance(random, 160, 0.12 + 0.02 * round, round % 4 == 3);
    const UnionOfBalls whole(instance.balls, no_monitor());
    const Ids kept(instance.kept.begin(), instance.kept.begin() + 20);
    const Ids others = all_but(160, {kept.begin(), kept.end()});
    Ids needed, alone;
    tbb::task_arena(4).execute(
        [&] { needed = without_superfluous(instance.balls, kept, others, no_monitor()); });
    tbb::task_arena(1).execute(
        [&] { alone = without_superfluous(instance.balls, kept, others, no_monitor()); });
    EXPECT_EQ(needed, alone) << "round " << round;
    const Ids after = merged(kept, needed);
    EXPECT_TRUE(whole.inclusion_of(after).isomorphism()) << "round " << round;
    for (const std::int32_t ball : needed) {
      Ids less = after;
      less.erase(std::find(less.begin(), less.end(), ball));
      EXPECT_FALSE(whole.inclusion_of(less).isomorphism()) << "round " << round << ", ball " << ball;
    }
    left += needed.size();
    taken += others.size() - needed.size();
  }
  EXPECT_GT(left, 100u);
  EXPECT_GT(taken, 100u);
}

TEST(listing_3_2, keeps_the_topology_of_balls_that_overlap_deeply) {
  const Balls ring = make_balls(circle(30), 0.25);
  const Ids kept = all_but(30, {4, 5, 6, 17});
  const Ids returned = listing_3_2(ring, kept, no_monitor());
  EXPECT_TRUE(UnionOfBalls(ring, no_monitor()).inclusion_of(merged(kept, returned)).isomorphism());
  EXPECT_GE(returned.size(), 1u);
}

TEST(listing_3_2, misses_two_balls_inside_a_third) {
  const Balls balls{{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {0.5, 0.5, 3}, {}, {}};
  EXPECT_TRUE(listing_3_2(balls, Ids{0, 1}, no_monitor()).empty());
  const TopologyRepair repair = repaired(balls, {0, 1}, {.method = RepairMethod::literal});
  EXPECT_EQ(repair.returned, Ids{2}) << "what the comparison in the end is for";
}

TEST(topology_repair, by_listing_3_2_is_an_isomorphism_and_returns_no_fewer_balls) {
  std::mt19937_64 random(3);
  std::size_t literal = 0, localised = 0, missed = 0;
  for (int round = 0; round < 100; ++round) {
    const Instance instance = random_instance(random, 24, 0.3 + 0.1 * random_unit(random), false);
    literal += repaired(instance.balls, instance.kept, {.method = RepairMethod::literal}).returned.size();
    localised += repaired(instance.balls, instance.kept).returned.size();
    const Ids listed = listing_3_2(instance.balls, instance.kept, no_monitor());
    const InclusionHomology h =
        UnionOfBalls(instance.balls, no_monitor()).inclusion_of(merged(instance.kept, listed));
    missed += !h.isomorphism();
    // It sees what crosses something; only components that meet nothing escape it here.
    EXPECT_EQ((std::array{h.part[1], h.part[2]}), (std::array{h.rank[1], h.rank[2]})) << "round " << round;
    EXPECT_EQ((std::array{h.whole[1], h.whole[2]}), (std::array{h.rank[1], h.rank[2]})) << "round " << round;
  }
  EXPECT_GT(localised, 10u);
  EXPECT_LT(localised, literal);
  EXPECT_GT(missed, 0u);
  EXPECT_LT(missed, 10u);
}

TEST(topology_repair, does_not_depend_on_the_order_of_the_balls) {
  std::mt19937_64 random(4);
  const Instance instance = random_instance(random, 60, 0.2, false);
  const Ids straight = repaired(instance.balls, instance.kept).returned;
  EXPECT_EQ(repaired(instance.balls, instance.kept).returned, straight);
  for (const double scale : {-1.0, 0x1p-30, 0x1p20}) {  // mirrored, scaled
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (std::size_t i = 0; i < instance.balls.size(); ++i) {
      centers.push_back(scale * instance.balls.centers[i]);
      radii.push_back(std::abs(scale) * instance.balls.radii[i]);
    }
    EXPECT_EQ(repaired({centers, radii, {}, {}}, instance.kept).returned, straight) << scale;
  }
}

TEST(topology_repair, takes_bad_sets_of_balls) {
  EXPECT_TRUE(repaired({}, {}).returned.empty());
  EXPECT_EQ(repaired(make_balls({{1, 2, 3}}, 0), {}).returned, Ids{0});
  EXPECT_EQ(repaired(make_balls({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 1), {}).returned, Ids{0});
  EXPECT_TRUE(repaired(make_balls({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 1), {2}).returned.empty());
  EXPECT_TRUE(repaired({{{0, 0, 0}, {0, 0, 0.5}}, {2, 1}, {}, {}}, {1}).returned.empty()) << "nested";
  EXPECT_EQ(repaired(make_balls({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}}, 1), {0, 3}).returned,
            (Ids{1, 2}));
  std::vector<Vec3> line, plane;
  for (int i = 0; i < 9; ++i) line.push_back({1.0 * i, 2.0 * i, 3.0 * i});
  for (int i = 0; i < 25; ++i) plane.push_back({1.0 * (i % 5), 1.0 * (i / 5), 0});
  EXPECT_EQ(repaired(make_balls(line, 2), {0, 4, 8}).returned.size(), 6u);
  EXPECT_EQ(repaired(make_balls(plane, 0.55), {0, 12, 24}).check.whole, (Betti{1, 16, 0}));
  const Balls wide{
      {{0, 0, 0}, {1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6 + 1 + 2e-6, 0, 0}}, {1e6, 1, 1e-6, 1e-6}, {}, {}};
  EXPECT_TRUE(repaired(wide, {0, 3}).check.inclusion_after().isomorphism());
}

TEST(topology_repair, adds_to_a_cover_what_it_returns) {
  const Balls ring = make_balls(circle(24), 0.2);
  CoverState cover;
  cover.balls = 24;
  cover.row_offsets = {0};
  std::vector<std::int32_t> chosen = all_but(24, {5, 6, 7});
  std::reverse(chosen.begin(), chosen.end());
  cover.chosen = chosen;
  cover.chosen_how = std::vector<std::uint8_t>(21, static_cast<std::uint8_t>(Choice::searched));
  struct Listener final : Monitor {
    void warn(const std::string& text) override { warnings.push_back(text); }
    std::vector<std::string> warnings;
  } listener;
  const TopologyRepair repair = repair_topology(ring, cover, {}, listener);
  EXPECT_EQ(listener.warnings,
            (std::vector<std::string>{"1 tunnel is lost: 3 balls returned to 21, which are all there "
                                      "are: nothing less had the right topology"}));
  const CoverState after = with_returned(cover, repair.returned);
  EXPECT_EQ(broken_invariant(after), "");
  EXPECT_EQ(after.chosen.size(), 24u);
  EXPECT_EQ(after.count(Choice::returned), 3);
  EXPECT_EQ(after.chosen[21], 5);
  EXPECT_THROW(repair_topology(make_balls(circle(23), 0.2), cover, {}, no_monitor()), InputError);
  CoverState unfinished = cover;
  unfinished.column_ids = std::vector<std::int32_t>{0};
  EXPECT_THROW(repair_topology(ring, unfinished, {}, no_monitor()), InputError);
}

TEST(topology_repair, refuses_ids_that_are_none) {
  const Balls ring = make_balls(circle(12), 0.4);
  for (const Ids& kept : {Ids{12}, Ids{-1}, Ids{3, 3}, Ids{4, 2}}) {
    EXPECT_THROW(repair_topology(ring, kept, {}, no_monitor()), InputError);
  }
  EXPECT_THROW(
      repair_topology(make_balls(circle(2001), 0.1), Ids{}, {.method = RepairMethod::literal}, no_monitor()),
      InputError);
}

TEST(topology_repair, stops_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return ++asked > 40; }
    int asked = 0;
  } monitor;
  std::mt19937_64 random(5);
  const Instance instance = random_instance(random, 400, 0.1, false);
  EXPECT_THROW(repair_topology(instance.balls, instance.kept, {}, monitor), Cancelled);
}

TEST(topology_check, reports_what_does_not_fit) {
  TopologyCheck check;
  check.whole = {1, 3, 0};
  check.before = check.after = check.before_rank = check.after_rank = {1, 2, 0};
  EXPECT_EQ(broken_invariant(check), "");
  check.after_rank[1] = 3;
  EXPECT_NE(broken_invariant(check), "");
  check.after_rank[1] = -1;
  EXPECT_NE(broken_invariant(check), "");
  check.after_rank = check.before_rank;
  check.returned = -1;
  EXPECT_NE(broken_invariant(check), "");
}

}  // namespace
}  // namespace ballflow::geometry
