#include "run/memory_budget.hpp"

#include <gtest/gtest.h>

namespace ballflow {
namespace {

using Nodes = std::vector<std::size_t>;

struct MemoryBudgetTest : testing::Test {
  bool start(std::size_t i, std::uint64_t claim, std::uint64_t reads_held = 0) {
    return budget.start(i, claim, reads_held, [this] { ++waits; });
  }
  static ArtifactPtr artifact(std::size_t bytes) {
    const auto data = std::make_shared<std::vector<std::uint8_t>>(bytes);
    return Artifact::seal("Bytes", 1, {{"bytes", BF_U8, {bytes}, data->data()}}, "{}", data);
  }
  MemoryBudget budget{10'000};
  int waits = 0;
};

TEST_F(MemoryBudgetTest, claims_stay_under_the_budget_and_those_that_wait_start_when_they_fit) {
  EXPECT_TRUE(start(0, 6000));
  EXPECT_FALSE(start(1, 6000));
  EXPECT_TRUE(start(2, 4000));
  EXPECT_FALSE(start(3, 1));
  EXPECT_EQ(waits, 2);
  EXPECT_EQ(budget.end(2), Nodes{3});
  EXPECT_EQ(budget.end(0), Nodes{1});
  EXPECT_EQ(budget.used(), 6001u);
}

TEST_F(MemoryBudgetTest, one_that_claims_more_than_there_is_runs_alone_when_nothing_else_can) {
  EXPECT_TRUE(start(0, 10));
  EXPECT_FALSE(start(1, 20'000));
  EXPECT_TRUE(start(2, 1));
  EXPECT_EQ(budget.start_one(), Nodes{}) << "others run";
  EXPECT_EQ(budget.end(0), Nodes{});
  EXPECT_EQ(budget.end(2), Nodes{});
  EXPECT_EQ(budget.start_one(), Nodes{1});
  EXPECT_FALSE(start(3, 1));
  EXPECT_EQ(budget.end(1), Nodes{3});
}

TEST_F(MemoryBudgetTest, what_is_held_counts_until_the_last_one_lets_it_go) {
  const ArtifactPtr large = artifact(9000), mapped = artifact(9000);
  EXPECT_TRUE(start(0, 10));
  budget.hold(large);
  budget.share(large);
  budget.share(mapped);  // was never held
  EXPECT_EQ(budget.used(), 10 + large->file_size());
  EXPECT_FALSE(start(1, 2000));
  budget.let_go(mapped);
  budget.let_go(large);
  EXPECT_EQ(budget.admit_waiting(), Nodes{});
  EXPECT_EQ(budget.held(large), large->file_size());
  budget.let_go(large);
  EXPECT_EQ(budget.held(large), 0u);
  EXPECT_EQ(budget.admit_waiting(), Nodes{1});
  EXPECT_EQ(budget.used(), 2010u);
}

TEST_F(MemoryBudgetTest, who_reads_most_of_what_is_held_starts_first) {
  EXPECT_TRUE(start(0, 10'000));
  EXPECT_FALSE(start(1, 10));
  EXPECT_FALSE(start(2, 10, 500));
  EXPECT_FALSE(start(3, 10, 700));
  EXPECT_EQ(budget.end(0), (Nodes{3, 2, 1}));
}

TEST_F(MemoryBudgetTest, who_only_adds_does_not_pass_one_that_frees) {
  EXPECT_TRUE(start(0, 6000));
  EXPECT_TRUE(start(1, 100));
  EXPECT_FALSE(start(2, 8000, 500)) << "does not fit";
  EXPECT_FALSE(start(3, 10)) << "fits, but would only add to what is held";
  EXPECT_TRUE(start(4, 10, 1)) << "fits, and frees";
  EXPECT_EQ(budget.end(1), Nodes{});
  EXPECT_EQ(budget.end(0), (Nodes{2, 3}));
}

TEST_F(MemoryBudgetTest, something_can_always_run_whatever_is_held) {
  const ArtifactPtr large = artifact(30'000);
  budget.hold(large);
  EXPECT_FALSE(start(0, 10));
  EXPECT_FALSE(start(1, 10, 5));
  EXPECT_EQ(budget.start_one(), Nodes{1}) << "the one that frees";
  EXPECT_EQ(budget.start_one(), Nodes{});
  EXPECT_EQ(budget.end(1), Nodes{});
  EXPECT_EQ(budget.start_one(), Nodes{0});
}

}  // namespace
}  // namespace ballflow
