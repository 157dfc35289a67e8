#include "cover/local_search.hpp"

#include <ballflow/sdk.hpp>
#include <utility>
#include <vector>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct LocalSearch {
  In<CoverState> cover;
  Out<CoverState> covered;
  LocalSearchOptions options;

  static void declare(NodeDecl<LocalSearch>& d) {
    d.id("LocalSearch", 3).summary("Cover what is left by few balls: greedy, then local search.");
    d.doc(
        "Row-weighting local search on every connected component, then once more with the balls of small "
        "reduced cost where at most 200 balls cover a component. Where more than 600 balls are needed the "
        "first "
        "half of the steps goes to regions of the cover, all at once, the second half to the whole. Ends "
        "early "
        "where the certificate proves that fewer balls are impossible, so run LagrangianBound before. The "
        "number "
        "of steps is limited, not the time: equal input gives equal balls.");
    d.avoid_when("nothing was reduced: the search then spends its steps on dominated balls.");
    d.cites("gao2015", "3");
    d.input("cover", &LocalSearch::cover).doc("any state of a set covering computation, best after Reduce");
    d.output("cover", &LocalSearch::covered).doc("a cover; lower bound and certificate as before");
    d.choice("effort", &LocalSearch::options, &LocalSearchOptions::effort,
             {{SearchEffort::low, "low", "a quarter of the first search"},
              {SearchEffort::normal, "normal", "both searches"},
              {SearchEffort::high, "high",
               "both, and both again from what they found, with 10 times the steps for each ball, 1000 times "
               "min_steps and 100 times those in the core, as far as 6 * 10^9 entries go: up to a minute"}})
        .doc(
            "how long is searched; more effort never ends with more balls. The summary of high effort adds "
            "curve");
    d.param("steps_per_ball", &LocalSearch::options, &LocalSearchOptions::steps_per_ball)
        .unit("steps")
        .at_least(0)
        .doc(
            "steps for each ball that is left in the matrix, half of it where regions are searched; a step "
            "takes "
            "a microsecond or a few");
    d.param("work_per_ball", &LocalSearch::options, &LocalSearchOptions::work_per_ball)
        .unit("matrix entries")
        .at_least(0)
        .doc("bounds the same in entries visited, for dense matrices, where a step takes longer");
    d.param("min_steps", &LocalSearch::options, &LocalSearchOptions::min_steps)
        .unit("steps")
        .at_least(0)
        .at_most(2'000'000'000)
        .doc("for the whole matrix, however few balls are left");
    d.param("max_steps", &LocalSearch::options, &LocalSearchOptions::max_steps)
        .unit("steps")
        .at_least(0)
        .at_most(2'000'000'000)
        .doc("for the whole matrix; 0 is greedy without redundant balls");
    d.param("core_steps_per_ball", &LocalSearch::options, &LocalSearchOptions::core_steps_per_ball)
        .unit("steps")
        .at_least(0)
        .doc(
            "times the gap: steps of a second search with balls of small reduced cost, where covers are "
            "small");
    d.param("target_gap", &LocalSearch::options, &LocalSearchOptions::target_gap)
        .unit("fraction of the lower bound")
        .at_least(0)
        .doc("stops when the balls exceed the lower bound by no more; 0 stops only at the bound");
    d.param("seed", &LocalSearch::options, &LocalSearchOptions::seed)
        .unit("number")
        .at_least(0)
        .doc("other seeds find other covers of about the same size");
    d.memory(1 << 20, 5.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    SearchCurve curve;
    const bool high = options.effort == SearchEffort::high;
    CoverState found = local_search(*cover, options, monitor, high ? &curve : nullptr);
    if (high) {
      std::vector<std::vector<double>> rows;
      for (std::size_t i = 0; i < curve.steps.size(); ++i)
        rows.push_back({curve.steps[i], static_cast<double>(curve.balls[i])});
      covered.summary("curve", rows);
    }
    covered = std::move(found);
  }
};

}  // namespace

const bf_node* local_search_entry() { return node_entry<LocalSearch>(); }

}  // namespace ballflow::nodes
