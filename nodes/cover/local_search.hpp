// Covers of few balls by local search with weighted rows (Gao, Weise and Li 2015, "RWLS").
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// How long is searched. More effort never ends with more balls: it begins as less does.
enum class SearchEffort : std::uint8_t {
  low,     // a quarter of the first search
  normal,  // two searches, see local_search
  high,  // and both again from the best covers: with 10 times the steps for each ball, 1000 times min_steps,
         // and 100 times the steps in cores, where 6 * 10^9 entries are enough for them
};

struct LocalSearchOptions {
  SearchEffort effort = SearchEffort::normal;
  double steps_per_ball = 300;           // of the matrix
  double work_per_ball = 15'000;         // matrix entries visited: a step visits an average row and column
  std::int64_t min_steps = 200'000;      // for the whole matrix, also when it has few balls
  std::int64_t max_steps = 100'000'000;  // for the whole matrix; 0 is greedy without redundant balls
  double core_steps_per_ball = 13'000;   // of the second search, times the gap that the first leaves
  double target_gap = 0;                 // stop when (balls - lower bound) / lower bound is at most this
  std::int64_t seed = 1;
};

/// How many balls there were after how many steps, both of all components; steps ascend.
struct SearchCurve {
  std::vector<double> steps;
  std::vector<std::int64_t> balls;
};

/// Covers what is left of the matrix, component by component; the balls are marked Choice::searched.
///
/// A component starts from the greedy cover without its redundant balls. A step drops the ball whose loss is
/// least, takes one of the samples that are now uncovered at random, and adds the ball that gains most among
/// those that cover it. Gain and loss are sums of sample weights, and the weight of a sample grows with
/// every step that leaves it uncovered. Among equals the ball goes that was moved longest ago; the ball that
/// was added last is not dropped, the one that was dropped last is not added. Whenever everything is covered,
/// the cover is recorded and one ball more is dropped.
///
/// A second search goes on from covers of at most 200 balls, with their core alone: the balls of the cover,
/// and those whose reduced cost (1 less the prices of their samples in the certificate) is at most (balls -
/// bound) / bound of the component. Its weights are halved when they are 500 on average. It makes
/// core_steps_per_ball steps for each ball of the component, or so many as visit 10^9 entries of the core if
/// that is less, both times (balls - bound) / bound of all components whose cover is not proven the least.
/// Components without prices have no core.
///
/// Components whose greedy cover has more than 600 balls begin with regions of it, all at once, and end with
/// a search of the whole; they make half as many steps, which find as few balls (region_search.hpp).
///
/// - A step takes about a microsecond, in dense matrices a few. The first search makes steps_per_ball * rows
///   steps, or work_per_ball * rows / (mean length of rows + mean length of columns) if that is less; at
///   least min_steps and at most max_steps. Components share them in proportion to their rows. No clock:
///   equal input gives equal balls.
/// - A component whose balls are as few as the prices of its samples prove stops at once (run
///   lagrangian_bound before), and everything stops when the gap is at most target_gap.
/// - Components and regions are searched in parallel; the result does not depend on the number of threads.
/// - The lower bound stays what it was.
/// - `curve`: filled where it is wanted.
CoverState local_search(const CoverState& state, const LocalSearchOptions& options = {},
                        Monitor& monitor = no_monitor(), SearchCurve* curve = nullptr);

}  // namespace ballflow::geometry
