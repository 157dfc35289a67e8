#include "power/minimal_union.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "contribution_oracle.hpp"
#include "covering_oracle.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;
using Numbers = std::vector<std::array<double, 4>>;  // x, y, z, r

constexpr MinimalUnionOptions space{UnionOf::balls}, plane{UnionOf::discs};

Balls balls_of(const Numbers& numbers) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const auto& [x, y, z, r] : numbers) {
    centers.push_back({x, y, z});
    radii.push_back(r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

Site site(const std::array<double, 4>& b) { return {{b[0], b[1], b[2]}, b[3] * b[3]}; }

std::vector<Site> sites_of(const Numbers& numbers, const Ids& ids, std::int32_t without) {
  std::vector<Site> sites;
  for (const std::int32_t id : ids) {
    if (id != without) sites.push_back(site(numbers[static_cast<std::size_t>(id)]));
  }
  return sites;
}

/// What is left of equal balls.
Ids distinct(const Numbers& numbers) {
  Ids ids;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::find(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(i), numbers[i]) ==
        numbers.begin() + static_cast<std::ptrdiff_t>(i))
      ids.push_back(static_cast<std::int32_t>(i));
  }
  return ids;
}

/// The pass that the header states, by enumeration: of what contributes.
Ids pass(const Numbers& numbers, const Ids& contributing, int dimensions) {
  Ids order = contributing, left = contributing;
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto key = [&](std::int32_t i) {
      const auto& [x, y, z, r] = numbers[static_cast<std::size_t>(i)];
      return std::tuple(r, x, y, z);
    };
    return key(a) < key(b);
  });
  for (const std::int32_t id : order) {
    if (test::covered_by_enumeration(site(numbers[static_cast<std::size_t>(id)]), sites_of(numbers, left, id),
                                     dimensions))
      left.erase(std::find(left.begin(), left.end(), id));
  }
  return left;
}

/// Random sets of every kind that has no general position, and of some that have.
class RandomSets {
 public:
  explicit RandomSets(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double integer(int low, int high) {
    return low + static_cast<double>(below(static_cast<std::uint64_t>(high - low + 1)));
  }

  Numbers operator()(std::size_t most) {
    const std::uint64_t kind = below(10);
    Numbers numbers((kind < 7 ? 1 : 4) + below(most));
    for (auto& [x, y, z, r] : numbers) {
      x = integer(-2, 2), y = integer(-2, 2), z = integer(-2, 2), r = 0.5 * integer(0, 6);
      if (kind == 1) z = 0;                      // in a plane
      if (kind == 2) y = z = 0;                  // on a line
      if (kind == 3) y = z = x;                  // on another
      if (kind == 4) x = y = z = 1;              // concentric
      if (kind == 5 && below(3) == 0) r = 0;     // points among balls
      if (kind == 6) r = 2;                      // of one size
      if (kind >= 7) around_a_ball(x, y, z, r);  // spheres with many common points
      if (kind == 9) {                           // in general position
        x += uniform(-0.1, 0.1), y += uniform(-0.1, 0.1), z += uniform(-0.1, 0.1), r += uniform(0, 0.1);
      }
    }
    if (kind >= 7) numbers.push_back({0, 0, 0, 0.5 * integer(1, 5)});
    if (kind == 8) numbers.push_back({0, 0.5, 0, 0.5 * integer(1, 5)});
    if (below(4) == 0) numbers.push_back(numbers.front());  // equal balls
    return numbers;
  }

 private:
  /// A ball whose sphere passes through the origin, or past it.
  void around_a_ball(double& x, double& y, double& z, double& r) {
    constexpr std::array<std::array<double, 3>, 4> at_distance_3{
        {{1, 2, 2}, {2, 1, 2}, {2, 2, 1}, {3, 0, 0}}};
    const auto& p = at_distance_3[below(4)];
    x = below(2) == 0 ? p[0] : -p[0];
    y = below(2) == 0 ? p[1] : -p[1];
    z = below(2) == 0 ? p[2] : -p[2];
    r = below(3) == 0 ? 3 : 3.5;
  }

  std::mt19937_64 random_;
};

struct Tally {
  int rounds = 0, smaller = 0, whole = 0;
};

/// One set, against enumeration.
void check(const Numbers& numbers, int dimensions, Tally& tally) {
  const MinimalUnionOptions options = dimensions == 3 ? space : plane;
  const MinimalUnion found = minimal_union(balls_of(numbers), options);
  const Ids all = distinct(numbers);
  Ids contributing;
  for (const std::int32_t id : all) {
    if (test::contributes_by_enumeration(site(numbers[static_cast<std::size_t>(id)]),
                                         sites_of(numbers, all, id)))
      contributing.push_back(id);
  }
  ASSERT_EQ(found.contributing, static_cast<std::int64_t>(contributing.size()));
  ASSERT_EQ(found.kept, pass(numbers, contributing, dimensions));
  ASSERT_LE(found.touching_boundary, static_cast<std::int64_t>(found.kept.size()));
  // The union is the same, and nothing more can go.
  for (const std::int32_t id : all) {
    const bool kept = std::binary_search(found.kept.begin(), found.kept.end(), id);
    ASSERT_EQ(test::covered_by_enumeration(site(numbers[static_cast<std::size_t>(id)]),
                                           sites_of(numbers, found.kept, id), dimensions),
              !kept)
        << "ball " << id;
  }
  ++tally.rounds;
  tally.smaller += found.kept.size() < contributing.size();
  tally.whole += contributing.size() > 4;
}

TEST(minimal_union, is_what_enumeration_keeps_in_space) {
  RandomSets random(1);
  Tally tally;
  for (int round = 0; round < 2500; ++round) {
    SCOPED_TRACE(round);
    check(random(round % 50 == 0 ? 11 : 6), 3, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.smaller, 30);
  EXPECT_GT(tally.whole, 300);
}

TEST(minimal_union, is_what_enumeration_keeps_in_the_plane) {
  RandomSets random(2);
  Tally tally;
  for (int round = 0; round < 2500; ++round) {
    SCOPED_TRACE(round);
    Numbers numbers = random(round % 50 == 0 ? 13 : 8);
    for (auto& ball : numbers) ball[2] = 0;
    if (round % 3 == 0) {  // circles through the origin
      for (auto& [x, y, z, r] : numbers) {
        const bool along_x = random.below(2) == 0;
        x = (along_x ? 3 : 4) * (random.below(2) == 0 ? 1 : -1);
        y = (along_x ? 4 : 3) * (random.below(2) == 0 ? 1 : -1);
        r = random.below(4) == 0 ? 5.5 : 5;
      }
      numbers.push_back({0, 0, 0, random.integer(1, 4)});
    }
    check(numbers, 2, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.smaller, 150);
  EXPECT_GT(tally.whole, 300);
}

TEST(minimal_union, keeps_four_balls_that_cover_a_fifth) {
  const double r = 1.05 * std::sqrt(3.0), s = 0.33 * std::sqrt(3.0);
  const MinimalUnion found =
      minimal_union(balls_of({{0, 0, 0, s}, {1, 1, 1, r}, {1, -1, -1, r}, {-1, 1, -1, r}, {-1, -1, 1, r}}));
  EXPECT_EQ(found.kept, (Ids{1, 2, 3, 4}));
  EXPECT_EQ(found.contributing, 5);
  EXPECT_EQ(found.touching_boundary, 4);
}

TEST(minimal_union, decides_by_the_last_bit_what_is_covered) {
  // Eight spheres through the origin, which closed balls cover: a ball around it is covered by these.
  const auto eight = [](double r) {
    Numbers numbers{{0, 0, 0, 0.5}};
    for (const double x : {-1, 1}) {
      for (const double y : {-2, 2}) {
        for (const double z : {-2, 2}) numbers.push_back({x, y, z, r});
      }
    }
    return numbers;
  };
  EXPECT_EQ(minimal_union(balls_of(eight(3))).kept, (Ids{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(minimal_union(balls_of(eight(3))).contributing, 9);
  EXPECT_EQ(minimal_union(balls_of(eight(std::nextafter(3, 0)))).kept.size(), 9u);
  // In the plane four circles.
  const auto four = [](double r) {
    return Numbers{{3, 4, 0, r}, {-3, 4, 0, r}, {0, 0, 0, 1}, {3, -4, 0, r}, {-3, -4, 0, r}};
  };
  EXPECT_EQ(minimal_union(balls_of(four(5)), plane).kept, (Ids{0, 1, 3, 4}));
  EXPECT_EQ(minimal_union(balls_of(four(std::nextafter(5, 0))), plane).kept.size(), 5u);
  EXPECT_EQ(minimal_union(balls_of(four(5)), space).kept.size(), 5u)
      << "as balls they reach out of the plane";
}

TEST(minimal_union, of_balls_that_cover_each_other_in_turn_keeps_some) {
  // Either of two small balls is covered when the other is there: the first asked goes, the second stays.
  // Around a hole that each fills nearly alone.
  Numbers numbers;
  for (const double x : {-1, 1}) {
    for (const double y : {-2, 2}) {
      for (const double z : {-2, 2}) numbers.push_back({x, y, z, 2.9375});
    }
  }
  numbers.push_back({0, 0, 0, 0.75});
  numbers.push_back({0, 0, 0.0625, 0.75});
  const MinimalUnion found = minimal_union(balls_of(numbers));
  EXPECT_EQ(found.contributing, 10);
  EXPECT_EQ(found.kept, (Ids{0, 1, 2, 3, 4, 5, 6, 7, 9}));
}

TEST(minimal_union, keeps_one_of_equal_balls_and_none_inside_others) {
  EXPECT_EQ(minimal_union({}).kept, Ids{});
  EXPECT_EQ(minimal_union({}, plane).kept, Ids{});
  EXPECT_EQ(minimal_union(balls_of({{1, 2, 3, 0}})).kept, Ids{0});
  EXPECT_EQ(minimal_union(balls_of({{1, 2, 3, 1}, {1, 2, 3, 1}})).kept, Ids{0});
  EXPECT_EQ(minimal_union(balls_of({{1, 2, 3, 1}, {1, 2, 3, 2}})).kept, Ids{1});
  EXPECT_EQ(minimal_union(balls_of({{0, 0, 0, 2}, {1, 0, 0, 1}, {2, 0, 0, 0}, {3, 0, 0, 0}})).kept,
            (Ids{0, 3}));
}

TEST(minimal_union, does_not_depend_on_the_order_of_the_balls) {
  RandomSets random(3);
  std::mt19937_64 shuffle(4);
  for (int round = 0; round < 300; ++round) {
    Numbers numbers = random(40);
    for (const int dimensions : {2, 3}) {
      if (dimensions == 2) {
        for (auto& ball : numbers) ball[2] = 0;
      }
      const auto left = [&](const Numbers& given) {
        Numbers kept;
        for (const std::int32_t id : minimal_union(balls_of(given), dimensions == 3 ? space : plane).kept)
          kept.push_back(given[static_cast<std::size_t>(id)]);
        std::sort(kept.begin(), kept.end());
        return kept;
      };
      Numbers other = numbers;
      std::shuffle(other.begin(), other.end(), shuffle);
      ASSERT_EQ(left(numbers), left(other)) << "round " << round;
    }
  }
}

TEST(minimal_union, refuses_what_has_no_union) {
  const auto message = [](const Numbers& numbers, const MinimalUnionOptions& options) -> std::string {
    try {
      minimal_union(balls_of(numbers), options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({{0, 0, 0, 1}, {NAN, 0, 0, 1}}, space).find("ball 1"), std::string::npos);
  EXPECT_NE(message({{0, 0, 0, -1}}, space).find("radius"), std::string::npos);
  EXPECT_NE(message({{0, 0, 1e200, 1}}, space).find("1e+200"), std::string::npos);
  EXPECT_NE(message({{0, 0, 0, 1}, {0, 0, 2, 1}}, plane).find("ball 1 has its center at z = 2"),
            std::string::npos);
  EXPECT_EQ(message({{0, 0, 2, 1}}, space), "");
}

}  // namespace
}  // namespace ballflow::geometry
