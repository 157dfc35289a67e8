#include "cover/ip_solve.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include "cover/components.hpp"
#include "cover/greedy.hpp"
#include "cover/load_cover.hpp"
#include "cover/reduce.hpp"
#include "cover/verify_cover.hpp"
#include "cover_oracle.hpp"
#include "io/read_mesh.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using test::Sets;
using test::state_of;

/// Answers what it was told to, and counts.
class FakeSolver final : public IpSolver {
 public:
  explicit FakeSolver(IpAnswer answer) : answer_(std::move(answer)) {}
  IpAnswer solve(const IpProblem&, Monitor&) override {
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

struct Solver {
  const char* name;
  std::unique_ptr<IpSolver> (*make)();
};
void PrintTo(const Solver& solver, std::ostream* out) { *out << solver.name; }

class EverySolver : public testing::TestWithParam<Solver> {
 protected:
  const std::unique_ptr<IpSolver> solver = GetParam().make();
};

/// Of a library in this process: its file name, links followed; empty where it is not there or linked
/// statically.
std::string file_in_memory(const std::string& library) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t at = line.find("/" + library);
    if (at != std::string::npos) return line.substr(at + 1);
  }
  return {};
}

TEST(ip_solve, tells_the_versions_of_the_libraries_that_run) {
  for (const auto& [library, version] :
       {std::pair{"libCbc.so", cbc_version()}, std::pair{"libCgl.so", cgl_version()}}) {
    const std::string file = file_in_memory(library);
    if (file.empty()) GTEST_SKIP() << library << " is linked statically";
    EXPECT_EQ(version, file);
  }
  EXPECT_NE(clp_version().find('.'), std::string::npos);
  EXPECT_NE(lp_solve_version().find('.'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(ip_solve, EverySolver,
                         testing::Values(Solver{"lp_solve", make_lp_solve}, Solver{"cbc", make_cbc}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(EverySolver, finds_the_optimum_of_random_instances) {
  std::mt19937 random(21);
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
    ASSERT_TRUE(test::certificate_error(state, solved).empty()) << "round " << round;
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
  FakeSolver gives_up({});
  const CoverState left = ip_solve(state, gives_up);
  EXPECT_EQ(left.columns, state.columns);
  EXPECT_TRUE(left.chosen.empty());
  EXPECT_EQ(left.lower_bound, 3);  // ceil(7 / 3)
  EXPECT_EQ(gives_up.calls, 1);
}

/// 120 columns of 3 among 40 rows at random: needs branching.
CoverState hard_instance() {
  std::mt19937 random(4);
  Sets rows(40);
  for (std::int32_t c = 0; c < 120; ++c) {
    std::set<std::size_t> members;
    while (members.size() < 3) members.insert(random() % 40);
    for (const std::size_t i : members) rows[i].push_back(c);
  }
  return state_of(rows, 120);
}

TEST_P(EverySolver, node_limit_ends_the_search_the_same_way_every_time) {
  const CoverState state = hard_instance();
  const Csr columns = transpose(rows_of(state), state.cols());
  const auto answer = [&](std::int64_t limit) {
    return solver->solve({40, columns, 41, limit}, no_monitor());
  };
  const IpAnswer full = answer(1'000'000);
  ASSERT_TRUE(full.finished);
  ASSERT_GT(full.nodes, 20) << "the instance is too easy to test the limit";
  const IpAnswer half = answer(full.nodes / 2);
  EXPECT_FALSE(half.finished);
  EXPECT_LE(half.lower_bound, static_cast<std::int64_t>(full.rows.size()));
  for (int k = 0; k < 3; ++k) {
    const IpAnswer again = answer(1'000'000);
    EXPECT_EQ(again.rows, full.rows);
    EXPECT_EQ(again.nodes, full.nodes);
    EXPECT_EQ(again.duals, full.duals);
  }
}

TEST(ip_solve, solvers_agree_on_what_is_too_large_for_exhaustive_search) {
  std::mt19937 random(31);
  for (int round = 0; round < 60; ++round) {
    const std::size_t columns = 20 + random() % 60;
    const CoverState state = state_of(test::random_sets(random, 20 + random() % 30, columns, 0.1), columns);
    const CoverState a = ip_solve(state, *make_lp_solve()), b = ip_solve(state, *make_cbc());
    EXPECT_EQ(a.remaining(), 0u);
    EXPECT_EQ(a.chosen.size(), b.chosen.size());
    EXPECT_TRUE(test::covers(state, b));
  }
}

TEST_P(EverySolver, improves_a_known_cover_or_proves_it_the_best) {
  std::mt19937 random(23);
  int improved = 0, kept = 0;
  for (int round = 0; round < 500; ++round) {
    const std::size_t rows = 4 + random() % 9, columns = 4 + random() % 16;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.1 + 0.2 * test::unit(random)), columns);
    const CoverState known = greedy(state);
    const CoverState solved = ip_solve(state, *solver, {}, no_monitor(), &known);
    ASSERT_EQ(broken_invariant(solved), "");
    ASSERT_TRUE(test::covers(state, solved));
    ASSERT_EQ(static_cast<std::int64_t>(solved.chosen.size()), test::optimum(state)) << "round " << round;
    ASSERT_EQ(solved.lower_bound, test::optimum(state));
    ASSERT_EQ(solved.count(Choice::exact), test::optimum(state));
    ++(solved.chosen.size() < known.chosen.size() ? improved : kept);
  }
  EXPECT_GT(improved, 10);
  EXPECT_GT(kept, 10);
}

TEST(ip_solve, falls_back_on_the_known_cover) {
  const CoverState state = state_of(fano_planes(2), 14), known = greedy(state);
  FakeSolver gives_up({});
  const CoverState by_limit = ip_solve(state, gives_up, {}, no_monitor(), &known);
  const CoverState by_size = ip_solve(state, gives_up, {.max_balls = 6}, no_monitor(), &known);
  EXPECT_EQ(gives_up.calls, 2);
  for (const CoverState& cover : {by_limit, by_size}) {
    EXPECT_EQ(broken_invariant(cover), "");
    EXPECT_TRUE(test::covers(state, cover));
    EXPECT_EQ(cover.chosen.size(), known.chosen.size());
    EXPECT_EQ(cover.count(Choice::greedy), known.count(Choice::greedy)) << "nothing is claimed about it";
  }
  // A better cover from a search that did not end is nobody's optimum.
  const CoverState plane = state_of(fano_planes(1), 7), all = greedy(plane, {.mode = GreedyMode::all});
  FakeSolver stops_early({.rows = {0, 1, 2, 3}, .lower_bound = 3});
  const CoverState better = ip_solve(plane, stops_early, {}, no_monitor(), &all);
  EXPECT_EQ(better.count(Choice::trusted), 4);
  EXPECT_EQ(better.lower_bound, 3);
}

TEST(ip_solve, keeps_the_better_bound_of_the_known_cover) {
  const CoverState state = state_of(fano_planes(1), 7);
  CoverState known = greedy(state);
  ASSERT_EQ(known.chosen.size(), 3u);
  known.lower_bound = 3;
  known.lower_bound_how = static_cast<std::uint8_t>(BoundHow::share);
  FakeSolver gives_up({});
  const CoverState kept = ip_solve(state, gives_up, {}, no_monitor(), &known);
  EXPECT_EQ(kept.lower_bound, 3);
  EXPECT_EQ(kept.lower_bound_how, static_cast<std::uint8_t>(BoundHow::share));
}

TEST(ip_solve, refuses_a_known_cover_of_something_else) {
  const CoverState state = state_of(fano_planes(1), 7), other = state_of({{0}}, 1);
  const CoverState unfinished = state, of_other = greedy(other);
  CoverState gap = greedy(state);
  gap.chosen = {0};
  gap.chosen_how = {2};
  for (const CoverState* known : {&unfinished, &of_other, &std::as_const(gap)}) {
    EXPECT_THROW(ip_solve(state, *make_lp_solve(), {}, no_monitor(), known), InputError);
  }
}

TEST(ip_solve, proves_the_coverage_axis_instance_with_cbc) {
  const std::string balls = test::data_file("coverage_axis/01Ants-27_candidates.txt.gz"),
                    samples = test::data_file("coverage_axis/01Ants-27_samples.pts.gz");
  if (balls.empty() || samples.empty()) GTEST_SKIP() << "no test data";
  const PointSet points = read_mesh_file(samples).points;
  const LoadedCover loaded = load_cover({.file = balls, .dilation = 0.03}, &points);
  const CoverState solved = ip_solve(reduce(loaded.cover), *make_cbc(), {.max_balls = 2000});
  EXPECT_EQ(solved.remaining(), 0u);
  EXPECT_EQ(solved.chosen.size(), 41u);
  EXPECT_EQ(solved.lower_bound, 41);
  EXPECT_TRUE(verify_cover(select(loaded.balls, solved.chosen), points).uncovered.empty());
}

TEST(ip_solve, finds_published_optima_with_cbc) {
  // Points that block all lines of a plane over three elements: all but a largest cap.
  EXPECT_EQ(ip_solve(load_cover({.file = "steiner:9"}).cover, *make_cbc()).lower_bound, 9 - 4);
  const std::string file = test::data_file("setcover/scpe1.txt.gz");
  if (file.empty()) GTEST_SKIP() << "no test data";
  const CoverState solved =
      ip_solve(reduce(load_cover({.file = file}).cover), *make_cbc(), {.max_balls = 500});
  EXPECT_EQ(solved.chosen.size(), 5u);
}

TEST_P(EverySolver, prints_nothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  ip_solve(hard_instance(), *solver, {.node_limit = 20});
  std::fflush(nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(EverySolver, gives_equal_answers_in_concurrent_threads) {
  const CoverState state = state_of(fano_planes(20), 140);
  const CoverState alone = ip_solve(state, *solver);
  CoverState a, b;
  std::thread other([&] { a = ip_solve(state, *GetParam().make()); });
  b = ip_solve(state, *solver);
  other.join();
  EXPECT_TRUE(test::same(a, alone));
  EXPECT_TRUE(test::same(b, alone));
}

TEST(ip_solve, never_takes_a_solver_at_its_word) {
  const CoverState state = state_of(fano_planes(1), 7), known = greedy(state, {.mode = GreedyMode::all});
  for (const IpAnswer& wrong :
       {IpAnswer{.finished = true, .rows = {0, 1}, .lower_bound = 2},        // two lines cover no plane
        IpAnswer{.finished = true, .rows = {0, 1, 2, 3}, .lower_bound = 5},  // contradicts itself
        IpAnswer{.finished = true, .rows = {0, 1, 2, 3, 4, 5, 6}},           // no better than all
        IpAnswer{.finished = false, .rows = {}, .lower_bound = 8}}) {        // more than all
    FakeSolver solver(wrong);
    try {
      ip_solve(state, solver, {}, no_monitor(), &known);
      ADD_FAILURE() << "believed " << wrong.rows.size() << " rows";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("component 0"), std::string::npos) << error.what();
    }
  }
  FakeSolver nothing({.finished = true});
  EXPECT_THROW(ip_solve(state, nothing), InputError) << "all rows are a cover";
}

TEST(ip_solve, prices_of_a_solver_prove_no_more_than_they_may) {
  const CoverState state = state_of(fano_planes(1), 7);
  for (const double price : {-1.0, 0.0, 0.2, 1.0 / 3, 0.5, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    FakeSolver solver({.finished = true,
                       .rows = {0, 1, 2},
                       .lower_bound = 3,
                       .nodes = 0,
                       .duals = std::vector<double>(7, price)});
    const CoverState solved = ip_solve(state, solver);
    EXPECT_TRUE(test::certificate_error(state, solved).empty()) << price;
    EXPECT_EQ(solved.certified_bound(), price > 0.3 ? 3 : price > 0 ? 2 : 0) << price;
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

/// Wants no more after `seconds`.
class StopAfter final : public Monitor {
 public:
  explicit StopAfter(double seconds) : until_(now() + seconds) {}
  bool cancelled() override { return now() > until_; }
  double late() const { return now() - until_; }

 private:
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  double until_;
};

TEST_P(EverySolver, stops_when_cancelled_inside_the_solver) {
  // Neither ends this within minutes.
  StopAfter stop(0.1);
  EXPECT_THROW(ip_solve(load_cover({.file = "steiner:243"}).cover, *solver,
                        {.max_balls = 243, .node_limit = 1'000'000'000}, stop),
               Cancelled);
  EXPECT_LT(stop.late(), 1 + 2) << "two more seconds for a busy machine";
}

TEST(ip_solve, stops_cbc_inside_a_large_linear_program) {
  std::mt19937 random(6);
  const CoverState state = state_of(test::random_sets(random, 3000, 3000, 0.01), 3000);
  StopAfter stop(0.3);
  EXPECT_THROW(ip_solve(state, *make_cbc(), {.max_balls = 3000}, stop), Cancelled);
  EXPECT_LT(stop.late(), 1 + 2) << "two more seconds for a busy machine";
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
