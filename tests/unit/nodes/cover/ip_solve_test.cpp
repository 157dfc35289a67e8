#include "cover/ip_solve.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "cover/components.hpp"
#include "cover/greedy.hpp"
#include "cover/reduce.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::Sets;
using test::state_of;

/// Answers what it was told to, and counts.
class FakeSolver final : public IpSolver {
 public:
  explicit FakeSolver(IpAnswer answer) : answer_(std::move(answer)) {}
  IpAnswer solve(std::size_t, const Csr&, std::int64_t, Monitor&) override {
    ++calls;
    return answer_;
  }
  int calls = 0;

 private:
  IpAnswer answer_;
};

/// Blocks of three lines through seven points (Fano planes): 3 of 7 rows cover, reductions do nothing.
Sets fano_planes(int count) {
  Sets rows;
  for (int k = 0; k < count; ++k) {
    for (const auto& line :
         Sets{{0, 1, 2}, {0, 3, 4}, {0, 5, 6}, {1, 3, 5}, {1, 4, 6}, {2, 3, 6}, {2, 4, 5}}) {
      rows.emplace_back();
      for (const std::int32_t p : line) rows.back().push_back(7 * k + p);
    }
  }
  return rows;
}

TEST(ip_solve, finds_the_optimum_of_random_instances) {
  std::mt19937 random(21);
  const auto solver = make_lp_solve();
  for (int round = 0; round < 3000; ++round) {
    const std::size_t rows = 1 + random() % 12, columns = 1 + random() % 20;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.08 + 0.4 * test::unit(random)), columns);
    const CoverState solved = ip_solve(state, *solver);
    ASSERT_EQ(broken_invariant(solved), "");
    ASSERT_EQ(solved.remaining(), 0u);
    ASSERT_TRUE(test::covers(state, solved));
    ASSERT_EQ(static_cast<std::int64_t>(solved.chosen.size()), test::optimum(state)) << "round " << round;
    ASSERT_EQ(solved.lower_bound, test::optimum(state));
    ASSERT_EQ(solved.count(Choice::exact), static_cast<std::int64_t>(solved.chosen.size()));
  }
}

TEST(ip_solve, whole_strategy_covers_within_its_bounds) {
  std::mt19937 random(22);
  const auto solver = make_lp_solve();
  for (int round = 0; round < 2000; ++round) {
    const std::size_t rows = 4 + random() % 9, columns = 4 + random() % 16;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.1 + 0.15 * test::unit(random)), columns);
    const IpSolveOptions small{.max_balls = static_cast<std::int64_t>(random() % 6)};
    const std::int64_t best = test::optimum(state);
    const CoverState once = greedy(ip_solve(reduce(state), *solver, small));
    ASSERT_EQ(broken_invariant(once), "");
    ASSERT_TRUE(test::covers(state, once));
    ASSERT_LE(once.lower_bound, best);
    ASSERT_GE(*once.upper_bound(), best);

    CoverState hybrid = state;  // Figure 3.2
    while (hybrid.remaining() > 0) {
      hybrid = greedy(ip_solve(reduce(hybrid), *solver, small), {.mode = GreedyMode::one_per_component});
    }
    ASSERT_EQ(broken_invariant(hybrid), "");
    ASSERT_TRUE(test::covers(state, hybrid));
    ASSERT_LE(hybrid.lower_bound, best);
    ASSERT_GE(hybrid.lower_bound, *hybrid.upper_bound() - hybrid.count(Choice::greedy)) << "Lemma 3.7";
    ASSERT_GE(*hybrid.upper_bound(), best);
  }
}

TEST(ip_solve, solves_every_component_by_itself) {
  const CoverState solved = ip_solve(state_of(fano_planes(5), 35), *make_lp_solve(), {.max_balls = 7});
  EXPECT_EQ(solved.chosen.size(), 15u);
  EXPECT_EQ(solved.lower_bound, 15);
  EXPECT_EQ(solved.remaining(), 0u);
}

TEST(ip_solve, leaves_components_that_are_too_large) {
  Sets rows = fano_planes(1);
  rows.push_back({7, 8});
  rows.push_back({8});
  const CoverState solved = ip_solve(state_of(rows, 9), *make_lp_solve(), {.max_balls = 6});
  EXPECT_EQ(solved.chosen, (Array<std::int32_t>{7}));
  EXPECT_EQ(solved.rows(), 7u);
  EXPECT_EQ(solved.cols(), 7u);
  EXPECT_EQ(solved.lower_bound, 1 + 3);  // ceil(7 / 3) for the plane
}

TEST(ip_solve, leaves_a_component_that_needs_too_many_nodes) {
  const CoverState state = state_of(fano_planes(1), 7);
  FakeSolver gives_up({.proven = false, .rows = {}, .nodes = 0});
  EXPECT_TRUE(test::same(ip_solve(state, gives_up), state));
  EXPECT_EQ(gives_up.calls, 1);
}

TEST(ip_solve, node_limit_ends_the_search_the_same_way_every_time) {
  // Random 3-of-40 columns need branching.
  std::mt19937 random(4);
  Sets rows(40);
  for (std::int32_t c = 0; c < 120; ++c) {
    std::set<std::size_t> members;
    while (members.size() < 3) members.insert(random() % 40);
    for (const std::size_t i : members) rows[i].push_back(c);
  }
  const CoverState state = state_of(rows, 120);
  const Csr columns = transpose({state.row_offsets, state.columns}, state.cols());
  const auto solver = make_lp_solve();
  const IpAnswer full = solver->solve(40, columns, 1'000'000, no_monitor());
  ASSERT_TRUE(full.proven);
  ASSERT_GT(full.nodes, 20) << "the instance is too easy to test the limit";
  EXPECT_FALSE(solver->solve(40, columns, full.nodes / 2, no_monitor()).proven);
  for (int k = 0; k < 3; ++k) {
    const IpAnswer again = solver->solve(40, columns, 1'000'000, no_monitor());
    EXPECT_EQ(again.rows, full.rows);
    EXPECT_EQ(again.nodes, full.nodes);
  }
}

TEST(ip_solve, gives_equal_answers_in_concurrent_threads) {
  const CoverState state = state_of(fano_planes(20), 140);
  const CoverState alone = ip_solve(state, *make_lp_solve());
  CoverState a, b;
  std::thread other([&] { a = ip_solve(state, *make_lp_solve()); });
  b = ip_solve(state, *make_lp_solve());
  other.join();
  EXPECT_TRUE(test::same(a, alone));
  EXPECT_TRUE(test::same(b, alone));
}

TEST(ip_solve, never_takes_a_solver_at_its_word) {
  FakeSolver wrong({.proven = true, .rows = {0, 1}, .nodes = 1});
  try {
    ip_solve(state_of(fano_planes(1), 7), wrong);
    FAIL() << "two lines do not cover a Fano plane";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("component 0"), std::string::npos) << error.what();
  }
}

TEST(ip_solve, asks_no_solver_where_one_row_covers_the_component) {
  Sets rows;
  for (std::int32_t k = 0; k < 100'000; ++k) rows.push_back({k});
  rows.push_back({0});  // as good as row 0
  FakeSolver unused({});
  const CoverState solved = ip_solve(state_of(rows, 100'000), unused);
  EXPECT_EQ(unused.calls, 0);
  EXPECT_EQ(solved.chosen.size(), 100'000u);
  EXPECT_EQ(solved.lower_bound, 100'000);
  EXPECT_EQ(solved.chosen[0], 0);
}

TEST(ip_solve, accepts_an_empty_matrix) {
  FakeSolver unused({});
  EXPECT_TRUE(ip_solve(state_of({}, 0), unused).chosen.empty());
}

TEST(ip_solve, stops_when_cancelled_inside_the_solver) {
  class StopInside final : public Monitor {
   public:
    bool cancelled() override { return ++looks > 2; }
    int looks = 0;
  } stop;
  EXPECT_THROW(ip_solve(state_of(fano_planes(1), 7), *make_lp_solve(), {}, stop), Cancelled);
}

TEST(components, are_those_of_the_incidence_graph) {
  const Components parts = components(state_of({{4, 5}, {0, 1}, {}, {2, 5}, {1, 3}}, 6));
  EXPECT_EQ(parts.of_column, (std::vector<std::int32_t>{0, 0, 1, 0, 1, 1}));
  EXPECT_EQ(parts.of_row, (std::vector<std::int32_t>{1, 0, -1, 1, 0}));
  EXPECT_EQ(parts.rows, (std::vector<std::int32_t>{2, 2}));
  EXPECT_EQ(parts.columns, (std::vector<std::int32_t>{3, 3}));
}

}  // namespace
}  // namespace ballflow::geometry
