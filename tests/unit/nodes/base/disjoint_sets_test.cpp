#include "base/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace ballflow::geometry {
namespace {

TEST(DisjointSets, name_a_set_by_its_least_element_in_any_order_of_joins) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    constexpr std::int32_t n = 40;
    DisjointSets sets(n);
    std::vector<std::set<std::int32_t>> expected(n);  // the set of every element
    for (std::int32_t i = 0; i < n; ++i) expected[static_cast<std::size_t>(i)] = {i};
    for (int k = 0; k < trial % 60; ++k) {
      const auto a = static_cast<std::int32_t>(random() % n), b = static_cast<std::int32_t>(random() % n);
      std::set<std::int32_t> both = expected[static_cast<std::size_t>(a)];
      EXPECT_EQ(sets.join(a, b), both.count(b) == 0);
      both.insert(expected[static_cast<std::size_t>(b)].begin(), expected[static_cast<std::size_t>(b)].end());
      for (const std::int32_t i : both) expected[static_cast<std::size_t>(i)] = both;
    }
    for (std::int32_t i = 0; i < n; ++i) {
      EXPECT_EQ(sets.root(i), *expected[static_cast<std::size_t>(i)].begin());
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
