// What Minkowski sums refuse, hold and stop for.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "minkowski_cases.hpp"

namespace ballflow::geometry {
namespace {

TEST(minkowski_sum, refuses_balls_it_cannot_add) {
  const Balls ball = balls_of({{0, 0, 0, 1}});
  const auto message = [&](const Balls& a, const Balls& b) -> std::string {
    try {
      minkowski_sum(a, b);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(ball, balls_of({{0, 0, 0, 1}, {0, 0, 0, -1}})).find("input b: ball 1"),
            std::string::npos);
  EXPECT_NE(message(balls_of({{NAN, 0, 0, 1}}), ball).find("input a"), std::string::npos);
  EXPECT_NE(message(ball, balls_of({{0, 1e200, 0, 1}})).find("1e+200"), std::string::npos);
  EXPECT_NE(message(ball, balls_of({{0, 0, 0, 1e-200}})).find("1e-200"), std::string::npos);
  EXPECT_EQ(message(ball, balls_of({{1e150, 0, 0, 1e-150}})), "");
}

TEST(minkowski_sum, refuses_more_sums_than_it_can_hold_before_it_makes_them) {
  const Balls many = balls_of(Numbers(50'000, {0, 0, 0, 1}));
  try {
    minkowski_sum(many, many, {.algorithm = MinkowskiAlgorithm::time});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2500000000 sums"), std::string::npos) << error.what();
  }
}

/// Grants some memory.
struct GrantMemory final : Monitor {
  explicit GrantMemory(std::uint64_t bytes) : granted(bytes) {}
  std::uint64_t memory_bytes() override { return granted; }
  std::uint64_t granted;
};

TEST(minkowski_sum, refuses_more_sums_than_the_memory_it_is_granted_holds) {
  RandomBalls random(3);
  Numbers a(200);
  for (auto& ball : a)
    ball = {random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9), random.uniform(0.1, 0.3)};
  const Balls balls = balls_of(a);
  for (const MinkowskiAlgorithm algorithm : algorithms) {
    SCOPED_TRACE(static_cast<int>(algorithm));
    GrantMemory enough(1 << 30), little(1 << 20);
    const MinkowskiSum sum = minkowski_sum(balls, balls, {.algorithm = algorithm}, enough);
    ASSERT_GT(sum.report.survivors, 5000) << "more than a megabyte";
    try {
      minkowski_sum(balls, balls, {.algorithm = algorithm}, little);
      ADD_FAILURE() << "not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("; the run may use 1.05 MB"), std::string::npos)
          << error.what();
    }
  }
}

TEST(minkowski_sum, streams_more_pairs_than_it_stores) {
  // All but a few are inside others.
  Numbers a{{0, 0, 0, 10}, {1, 0, 0, 10}};
  for (int k = 0; k < 9'998; ++k) a.push_back({0.001 * (k % 200), 0.001 * (k / 200), 0, 0.5});
  const MinkowskiSum sum = minkowski_sum(balls_of(a), balls_of(a));
  EXPECT_EQ(sum.report.pairs, 100'000'000);
  EXPECT_LT(sum.report.survivors, 100);
  EXPECT_EQ(numbers_of(sum.balls), (Numbers{{0, 0, 0, 20}, {1, 0, 0, 20}, {2, 0, 0, 20}}));
}

class CancelAfter final : public Monitor {
 public:
  explicit CancelAfter(int looks) : left_(looks) {}
  bool cancelled() override { return --left_ < 0; }

 private:
  std::atomic<int> left_;
};

TEST(minkowski_sum, ends_when_it_is_cancelled) {
  RandomBalls random(9);
  Numbers a(300);
  for (auto& ball : a)
    ball = {random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 1)};
  for (const MinkowskiAlgorithm algorithm : algorithms) {
    for (const int looks : {0, 1, 5, 20}) {
      CancelAfter monitor(looks);
      EXPECT_THROW(minkowski_sum(balls_of(a), balls_of(a), {.algorithm = algorithm}, monitor), Cancelled)
          << static_cast<int>(algorithm) << " " << looks;
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
