#include "base/lists.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ballflow::geometry {
namespace {

std::vector<int> in(const Lists<int>& lists, std::size_t list) {
  const std::span<const int> values = lists[list];
  return {values.begin(), values.end()};
}

TEST(lists, keep_the_order_in_which_values_are_put) {
  const Lists<int> lists = lists_of<int>(4, [](auto&& put) {
    put(2, 7);
    put(0, 1);
    put(2, 5);
    put(2, 6);
  });
  EXPECT_EQ(lists.size(), 4u);
  EXPECT_EQ(in(lists, 0), std::vector<int>{1});
  EXPECT_EQ(in(lists, 1), std::vector<int>{});
  EXPECT_EQ(in(lists, 2), (std::vector<int>{7, 5, 6}));
  EXPECT_EQ(in(lists, 3), std::vector<int>{});
}

TEST(lists, of_nothing_are_empty) {
  EXPECT_EQ(Lists<int>().size(), 0u);
  EXPECT_EQ(lists_of<int>(0, [](auto&&) {}).size(), 0u);
  EXPECT_EQ(in(lists_of<int>(2, [](auto&&) {}), 1), std::vector<int>{});
}

TEST(lists, hold_everything_that_threads_put_at_once) {
  constexpr std::size_t count = 3;
  constexpr int values = 30'000;
  Lists<int> lists(count);
  for (std::size_t k = 0; k < count; ++k) lists.count(k, values / count);
  lists.allocate();
  tbb::parallel_for(0, values,
                    [&](int v) { lists.put_concurrently(static_cast<std::size_t>(v) % count, v); });
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<int> list = lists[k];
    std::sort(list.begin(), list.end());
    ASSERT_EQ(list.size(), values / count);
    for (std::size_t i = 0; i < list.size(); ++i) ASSERT_EQ(list[i], static_cast<int>(count * i + k));
  }
}

}  // namespace
}  // namespace ballflow::geometry
