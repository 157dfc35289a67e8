#include "search/box_tree.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Vec3> random_points(std::mt19937& random, std::size_t count) {
  const auto coordinate = [&] { return static_cast<double>(random() % 1000) / 999; };
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(), coordinate(), coordinate()};
  return points;
}

/// Spheres of different radii, as boxes of their centres with slacks.
struct Spheres {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  BoxTree tree(std::size_t leaf_size = BoxTree::default_leaf_size) const {
    BoxTree result(centers, leaf_size);
    result.set_slacks(radii);
    return result;
  }
  double value(std::size_t i, Vec3 p) const { return distance(p, centers[i]) - radii[i]; }
};

Spheres random_spheres(std::mt19937& random, std::size_t count) {
  Spheres spheres{random_points(random, count), {}};
  for (std::size_t i = 0; i < count; ++i) spheres.radii.push_back(static_cast<double>(random() % 100) / 300);
  return spheres;
}

TEST(box_tree, finds_the_smallest_value_of_all) {
  std::mt19937 random(1);
  for (const std::size_t count : {1, 2, 8, 9, 100, 777}) {
    const Spheres spheres = random_spheres(random, count);
    const BoxTree tree = spheres.tree();
    for (const Vec3& p : random_points(random, 50)) {
      double least = infinity;
      for (std::size_t i = 0; i < count; ++i) least = std::min(least, spheres.value(i, p));
      EXPECT_EQ(tree.smallest(p, infinity, -infinity, [&](auto i) { return spheres.value(i, p); }), least);
      EXPECT_EQ(tree.smallest(p, least, -infinity, [&](auto i) { return spheres.value(i, p); }), least);
      EXPECT_EQ(tree.smallest(p, least - 1, -infinity, [&](auto i) { return spheres.value(i, p); }),
                least - 1);
      const double some =
          tree.smallest(p, infinity, least + 0.25, [&](auto i) { return spheres.value(i, p); });
      EXPECT_TRUE(some >= least && some < least + 0.25) << some << " " << least;
    }
  }
}

TEST(box_tree, answers_to_the_last_bit_whatever_the_order_and_the_leaves) {
  std::mt19937 random(2);
  const Spheres spheres = random_spheres(random, 2000);
  const BoxTree tree = spheres.tree();
  std::vector<std::size_t> name(spheres.centers.size());
  for (std::size_t i = 0; i < name.size(); ++i) name[i] = i;
  std::shuffle(name.begin(), name.end(), random);
  Spheres other;
  for (const std::size_t i : name) {
    other.centers.push_back(spheres.centers[i]);
    other.radii.push_back(spheres.radii[i]);
  }
  for (const std::size_t leaf_size : {1, 5, 64}) {
    const BoxTree permuted = other.tree(leaf_size);
    for (const Vec3& p : random_points(random, 200)) {
      EXPECT_EQ(tree.smallest(p, infinity, -infinity, [&](auto i) { return spheres.value(i, p); }),
                permuted.smallest(p, infinity, -infinity, [&](auto i) { return other.value(i, p); }));
    }
  }
}

TEST(box_tree, stops_only_below_what_is_enough) {
  // Both are at distance 1 of the origin, and one is deeper: exactly `enough` must not hide it.
  const Spheres spheres{{{1, 0, 0}, {-1, 0, 0}, {0, 5, 0}}, {0.5, 0.75, 0}};
  const BoxTree tree = spheres.tree(1);
  EXPECT_EQ(tree.smallest({}, infinity, 0.5, [&](auto i) { return spheres.value(i, {}); }), 0.25);
}

TEST(box_tree, visits_everything_below_a_limit) {
  std::mt19937 random(3);
  const Spheres spheres = random_spheres(random, 500);
  const BoxTree tree = spheres.tree();
  for (const Vec3& p : random_points(random, 50)) {
    std::set<std::size_t> visited;
    tree.below(p, 0.1, [&](std::size_t i) { EXPECT_TRUE(visited.insert(i).second); });
    for (std::size_t i = 0; i < spheres.centers.size(); ++i) {
      EXPECT_TRUE(spheres.value(i, p) >= 0.1 || visited.count(i) == 1) << i;
    }
    EXPECT_LT(visited.size(), spheres.centers.size());
  }
}

TEST(box_tree, is_a_function_of_its_items_alone) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  std::vector<Vec3> points(50'000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {static_cast<double>(i % 7), static_cast<double>(i % 11), static_cast<double>(i % 3)};
  }
  const auto built = [&](int threads) {
    return tbb::task_arena(threads).execute([&] { return BoxTree(points, 4); });
  };
  const BoxTree one = built(1), four = built(4);
  EXPECT_EQ(one.order(), four.order());
  ASSERT_EQ(one.nodes().size(), four.nodes().size());
  for (std::size_t k = 0; k < one.nodes().size(); ++k) {
    const BoxTree::Node &a = one.nodes()[k], &b = four.nodes()[k];
    EXPECT_EQ(std::tie(a.box.lower, a.box.upper, a.first, a.last, a.second),
              std::tie(b.box.lower, b.box.upper, b.first, b.last, b.second));
    if (a.second != 0) {
      EXPECT_EQ(a.first, one.nodes()[k + 1].first);
      EXPECT_EQ(one.nodes()[k + 1].last, one.nodes()[static_cast<std::size_t>(a.second)].first);
      EXPECT_EQ(a.last, one.nodes()[static_cast<std::size_t>(a.second)].last);
    } else {
      EXPECT_LE(a.last - a.first, 4);
    }
  }
}

TEST(box_tree, of_nothing_finds_nothing) {
  const BoxTree tree(std::span<const Vec3>{});
  EXPECT_EQ(tree.smallest({}, 3, 0, [](std::size_t) { return 0.0; }), 3);
  tree.below({}, 3, [](std::size_t) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace ballflow::geometry
