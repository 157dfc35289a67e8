// Every method on matrices that have much of one thing: a million components, or one block of ones.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "cover/greedy.hpp"
#include "cover/ip_solve.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/local_search.hpp"
#include "cover/reduce.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

struct Method {
  std::string name;
  std::function<CoverState(const CoverState&, Monitor&)> run;
};

const Method methods[]{
    {"Reduce", [](const CoverState& state, Monitor& monitor) { return reduce(state, {}, monitor); }},
    {"Greedy", [](const CoverState& state, Monitor& monitor) { return greedy(state, {}, monitor); }},
    {"IPSolve", [](const CoverState& state,
                   Monitor& monitor) { return ip_solve(state, *make_lp_solve(), {}, monitor); }},
    {"LagrangianBound",
     [](const CoverState& state, Monitor& monitor) { return lagrangian_bound(state, {}, monitor); }},
    {"LocalSearch",
     [](const CoverState& state, Monitor& monitor) { return local_search(state, {}, monitor); }}};

/// Whatever a method leaves, greedy picks cover it: `optimum` balls in all, and no bound above.
void expect_optimal(const CoverState& state, const Method& method, std::int64_t optimum) {
  SCOPED_TRACE(method.name);
  const CoverState next = method.run(state, no_monitor());
  ASSERT_EQ(broken_invariant(next), "");
  EXPECT_LE(next.lower_bound, optimum);
  EXPECT_EQ(*greedy(next).upper_bound(), optimum);
  struct Cancelling final : Monitor {
    bool cancelled() override { return true; }
  } cancelling;
  EXPECT_THROW(method.run(state, cancelling), Cancelled);
}

TEST(degenerate, a_million_components_of_one_ball) {
  constexpr std::size_t n = 1'000'000;
  std::vector<std::int32_t> ids(n);
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<std::int64_t> offsets(n + 1);
  std::iota(offsets.begin(), offsets.end(), 0);
  CoverState state;
  state.balls = state.samples = n;
  state.row_offsets = offsets;
  state.columns = state.row_ids = state.column_ids = ids;
  for (const Method& method : methods) expect_optimal(state, method, n);
}

TEST(degenerate, one_block_of_ones) {
  std::vector<std::int32_t> all(5000);
  std::iota(all.begin(), all.end(), 0);
  const CoverState state = test::state_of(test::Sets(5000, all), 5000);
  for (const Method& method : methods) expect_optimal(state, method, 1);
}

}  // namespace
}  // namespace ballflow::geometry
