#include "homology/inclusion_homology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <ostream>
#include <random>
#include <vector>

#include "cech_oracle.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry {

void PrintTo(const InclusionHomology& h, std::ostream* out) {
  for (const auto& [what, b] : {std::pair("part", h.part), {"whole", h.whole}, {"rank", h.rank}}) {
    *out << what << " " << b[0] << " " << b[1] << " " << b[2] << "  ";
  }
}

namespace {

using Ids = std::vector<std::int32_t>;

InclusionHomology inclusion(const Balls& balls, const Ids& part) {
  return UnionOfBalls(balls, no_monitor()).inclusion_of(part);
}

Balls make_balls(std::vector<Vec3> centers, double radius) {
  std::vector<double> radii(centers.size(), radius);
  return {std::move(centers), std::move(radii), {}, {}};
}

Ids all(std::size_t n) {
  Ids ids(n);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

std::vector<Vec3> circle(int n, double radius = 1) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n;
    points.push_back({radius * std::cos(t), radius * std::sin(t), 0});
  }
  return points;
}

TEST(inclusion, of_everything_is_an_isomorphism) {
  const Balls ring = make_balls(circle(12), 0.4);
  const InclusionHomology h = inclusion(ring, all(12));
  EXPECT_EQ(h, (InclusionHomology{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}));
  EXPECT_TRUE(h.isomorphism());
}

TEST(inclusion, of_nothing_is_one_in_nothing_only) {
  EXPECT_TRUE(inclusion({}, {}).isomorphism());
  EXPECT_EQ(inclusion(make_balls({{0, 0, 0}}, 1), {}), (InclusionHomology{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
}

TEST(inclusion, tells_a_loop_lost_and_another_one_gained_from_none) {
  // Two rings far apart; the second is filled by a ball in the middle that the part leaves out, and the first
  // lacks a ball. One loop each, and yet no isomorphism.
  std::vector<Vec3> centers = circle(12);
  for (const Vec3 p : circle(12)) centers.push_back(p + Vec3{10, 0, 0});
  std::vector<double> radii(24, 0.4);
  centers.push_back({10, 0, 0});
  radii.push_back(0.9);
  const Balls balls{centers, radii, {}, {}};
  Ids part = all(24);
  part.erase(part.begin() + 3);
  EXPECT_EQ(inclusion(balls, part), (InclusionHomology{{2, 1, 0}, {2, 1, 0}, {2, 0, 0}}));
  EXPECT_EQ(inclusion(balls, all(24)), (InclusionHomology{{2, 2, 0}, {2, 1, 0}, {2, 1, 0}}));
}

TEST(inclusion, follows_a_ball_that_the_whole_hides) {
  // The small ball has no power cell in the whole; the part is a component of its own at first.
  const Balls balls{{{0, 0, 0}, {0.1, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {2, 0.1, 1, 1, 1}, {}, {}};
  EXPECT_EQ(inclusion(balls, {1, 2, 3, 4}), (InclusionHomology{{4, 0, 0}, {4, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(inclusion(balls, {1}), (InclusionHomology{{1, 0, 0}, {4, 0, 0}, {1, 0, 0}}));
}

TEST(inclusion, of_a_swallowed_ring_kills_its_loop) {
  std::vector<Vec3> centers = circle(12, 0.5);
  std::vector<double> radii(12, 0.15);
  centers.push_back({0, 0, 0});
  radii.push_back(3);
  const Balls balls{centers, radii, {}, {}};
  EXPECT_EQ(inclusion(balls, all(12)), (InclusionHomology{{1, 1, 0}, {1, 0, 0}, {1, 0, 0}}));
}

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Ids random_part(std::mt19937_64& random, std::size_t n, std::uint64_t keep_of_ten) {
  Ids part;
  for (std::size_t i = 0; i < n; ++i) {
    if (random() % 10 < keep_of_ten) part.push_back(static_cast<std::int32_t>(i));
  }
  return part;
}

struct Met {
  int isomorphisms = 0, lost_loops = 0, killed_loops = 0, lost_cavities = 0, filled_cavities = 0, through = 0;
  void count(const InclusionHomology& h) {
    isomorphisms += h.isomorphism();
    lost_loops += h.rank[1] < h.whole[1];
    killed_loops += h.rank[1] < h.part[1];
    lost_cavities += h.rank[2] < h.whole[2];
    filled_cavities += h.rank[2] < h.part[2];
    through += h.rank[1] > 0;
  }
};

TEST(inclusion, agrees_with_nerves_on_random_balls) {
  std::mt19937_64 random(1);
  Met met;
  for (int round = 0; round < 150; ++round) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    const std::size_t n = 5 + random() % 12;
    const double size = 0.15 + 0.35 * unit(random), height = round % 3 == 0 ? 0.2 : 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = unit(random), y = unit(random), z = unit(random);
      centers.push_back({x, y, height * z});
      radii.push_back(size * (round % 5 == 0 ? unit(random) : 0.6 + 0.4 * unit(random)));
    }
    const Balls balls{centers, radii, {}, {}};
    const Ids part = random_part(random, n, 5 + random() % 5);
    const InclusionHomology expected = test::cech_inclusion(balls, part);
    ASSERT_EQ(inclusion(balls, part), expected) << "round " << round;
    met.count(expected);
  }
  EXPECT_GT(met.isomorphisms, 10);
  EXPECT_GT(met.lost_loops, 5);
  EXPECT_GT(met.killed_loops, 5);
  EXPECT_GT(met.through, 5);
}

TEST(inclusion, agrees_with_nerves_on_shells) {
  std::mt19937_64 random(2);
  Met met;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> centers;
    const std::size_t n = 15 + random() % 4;
    for (std::size_t i = 0; i < n; ++i) {  // spread over the unit sphere
      const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(n);
      const double t = 2.399963229728653 * static_cast<double>(i), r = std::sqrt(1 - z * z);
      centers.push_back({r * std::cos(t) + 0.1 * unit(random), r * std::sin(t), z + 0.1 * unit(random)});
    }
    std::vector<double> radii(n, 0.62 + 0.2 * unit(random));
    if (round % 2 == 0) {  // something that fills the cavity, or an island in it
      centers.push_back({0, 0, 0});
      radii.push_back(round % 4 == 0 ? 0.1 : 0.5);
    }
    const Balls balls{centers, radii, {}, {}};
    Ids part = random_part(random, radii.size(), 9);
    if (round % 4 == 2) part = all(n);
    const InclusionHomology expected = test::cech_inclusion(balls, part);
    ASSERT_EQ(inclusion(balls, part), expected) << "round " << round;
    met.count(expected);
  }
  EXPECT_GT(met.lost_cavities, 5);
  EXPECT_GT(met.filled_cavities, 2);
}

TEST(inclusion, agrees_with_nerves_on_degenerate_grids) {
  std::mt19937_64 random(3);
  Met met;
  for (int round = 0; round < 250; ++round) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    const std::size_t n = 4 + random() % 10;
    const auto flat = random() % 4;  // also collinear and coplanar centres
    for (std::size_t i = 0; i < n; ++i) {
      const auto digit = [&] { return static_cast<double>(random() % 3); };
      const double x = digit(), y = digit(), z = digit();
      centers.push_back({x, flat == 1 ? x : y, flat == 1 || flat == 2 ? 0 : z});
      radii.push_back(0.25 * static_cast<double>(1 + random() % 5));
    }
    const Balls balls{centers, radii, {}, {}};
    const Ids part = random_part(random, n, 6 + random() % 4);
    const InclusionHomology expected = test::cech_inclusion(balls, part);
    ASSERT_EQ(inclusion(balls, part), expected) << "round " << round;
    met.count(expected);
  }
  EXPECT_GT(met.isomorphisms, 20);
  EXPECT_GT(met.through, 5);
}

}  // namespace
}  // namespace ballflow::geometry
