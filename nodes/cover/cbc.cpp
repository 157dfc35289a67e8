// CbcModel is used directly. Its C interface and its main program take initial solutions, with which version
// 2.10.8 has called covers optimal that leave columns uncovered; they read their options from texts, and stop
// by the clock. An upper bound is passed as a cutoff instead, and the only limit is the number of nodes.
#include <CbcEventHandler.hpp>
#include <CbcHeuristic.hpp>
#include <CbcModel.hpp>
#include <CglClique.hpp>
#include <CglGomory.hpp>
#include <CglMixedIntegerRounding2.hpp>
#include <CglProbing.hpp>
#include <CglTwomir.hpp>
#include <CglZeroHalf.hpp>
#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "cover/ip_solver.hpp"

namespace ballflow::geometry {
namespace {

// Objectives are sums of many values near 0 or 1: a bound counts as reached from so much below it.
constexpr double tolerance = 1e-4;

/// Ends a linear program between two iterations.
class EndIterations final : public ClpEventHandler {
 public:
  explicit EndIterations(Monitor& monitor) : monitor_(&monitor) {}
  int event(Event) override { return monitor_->cancelled() ? 0 : -1; }
  ClpEventHandler* clone() const override { return new EndIterations(*this); }

 private:
  Monitor* monitor_;
};

/// Ends the search between two nodes.
class EndNodes final : public CbcEventHandler {
 public:
  explicit EndNodes(Monitor& monitor) : monitor_(&monitor) {}
  CbcAction event(CbcEvent) override { return monitor_->cancelled() ? stop : noAction; }
  CbcEventHandler* clone() const override { return new EndNodes(*this); }

 private:
  Monitor* monitor_;
};

void load(OsiClpSolverInterface& lp, const IpProblem& problem) {
  const Csr& columns = problem.columns;
  const std::int32_t variables = index_of(problem.rows, "balls for CBC"),
                     constraints = index_of(columns.size(), "samples for CBC");
  index_of(columns.entries.size(), "entries of the matrix for CBC");  // also where they start, below
  // A constraint for every column of the covering matrix.
  const std::vector<double> ones(columns.entries.size(), 1.0);
  const std::vector<CoinBigIndex> starts(columns.offsets.begin(), columns.offsets.end());
  std::vector<int> lengths(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) lengths[c] = static_cast<int>(columns.degree(c));
  const CoinPackedMatrix matrix(false, variables, constraints, static_cast<CoinBigIndex>(ones.size()),
                                ones.data(), columns.entries.data(), starts.data(), lengths.data());
  const std::vector<double> lower(problem.rows, 0.0), upper(problem.rows, 1.0), cost(problem.rows, 1.0);
  const std::vector<double> least(columns.size(), 1.0), most(columns.size(), lp.getInfinity());
  lp.loadProblem(matrix, lower.data(), upper.data(), cost.data(), least.data(), most.data());
  for (int i = 0; i < variables; ++i) lp.setInteger(i);
}

class Cbc final : public IpSolver {
 public:
  IpAnswer solve(const IpProblem& problem, Monitor& monitor) override {
    IpAnswer answer;
    OsiClpSolverInterface lp;
    lp.messageHandler()->setLogLevel(0);
    lp.setHintParam(OsiDoReducePrint, true, OsiHintTry);
    load(lp, problem);
    EndIterations end_iterations(monitor);
    lp.getModelPtr()->passInEventHandler(&end_iterations);
    lp.initialSolve();
    if (monitor.cancelled()) throw Cancelled();
    if (!lp.isProvenOptimal()) return answer;
    answer.duals.assign(lp.getRowPrice(), lp.getRowPrice() + problem.columns.size());
    answer.lower_bound = std::min(problem.upper_bound, bound_of(lp.getObjValue()));
    if (answer.lower_bound == problem.upper_bound) {
      answer.finished = true;
      return answer;
    }

    CbcModel model(lp);
    model.setLogLevel(0);
    model.messageHandler()->setLogLevel(0);
    EndNodes end_nodes(monitor);
    model.passInEventHandler(&end_nodes);
    model.setNumberThreads(0);
    model.setRandomSeed(1);
    model.setMaximumNodes(static_cast<int>(std::min<std::int64_t>(problem.node_limit, 2'000'000'000)));
    model.setCutoff(static_cast<double>(problem.upper_bound) - 0.5);
    model.setCutoffIncrement(0.999);
    model.setAllowableGap(0);
    add_methods(model);
    model.initialSolve();
    if (monitor.cancelled()) throw Cancelled();
    model.branchAndBound();
    if (monitor.cancelled()) throw Cancelled();

    answer.nodes = model.getNodeCount();
    answer.finished = model.status() == 0;
    if (const double* values = model.bestSolution(); values != nullptr) {
      for (std::size_t i = 0; i < problem.rows; ++i) {
        if (values[i] > 0.5) answer.rows.push_back(static_cast<std::int32_t>(i));
      }
    }
    if (answer.finished) {
      answer.lower_bound =
          answer.rows.empty() ? problem.upper_bound : static_cast<std::int64_t>(answer.rows.size());
    } else {
      answer.lower_bound =
          std::clamp(bound_of(model.getBestPossibleObjValue()), answer.lower_bound, problem.upper_bound);
    }
    return answer;
  }

 private:
  static std::int64_t bound_of(double objective) {
    return static_cast<std::int64_t>(std::ceil(objective - tolerance));
  }

  static void add_methods(CbcModel& model) {
    CglProbing probing;
    probing.setUsingObjective(1);
    probing.setMaxPass(1);
    probing.setMaxPassRoot(1);
    probing.setMaxProbe(10);
    probing.setMaxProbeRoot(50);
    probing.setMaxLook(10);
    probing.setMaxLookRoot(50);
    probing.setMaxElements(200);
    probing.setRowCuts(3);
    CglGomory gomory;
    gomory.setLimit(300);
    gomory.setLimitAtRoot(1000);
    CglClique clique;
    clique.setStarCliqueReport(false);
    clique.setRowCliqueReport(false);
    CglMixedIntegerRounding2 rounding;
    CglTwomir two_step_rounding;
    CglZeroHalf zero_half;
    // -98: kept up below the root only while they raise the bound.
    model.addCutGenerator(&probing, -98, "probing");
    model.addCutGenerator(&gomory, -98, "Gomory");
    model.addCutGenerator(&clique, -98, "clique");
    model.addCutGenerator(&rounding, -98, "mixed integer rounding");
    model.addCutGenerator(&two_step_rounding, -98, "two-step mixed integer rounding");
    model.addCutGenerator(&zero_half, -98, "zero-half");
    CbcRounding round(model);
    model.addHeuristic(&round, "rounding");
    model.setNumberStrong(10);
    model.setNumberBeforeTrust(10);
    // Covers by small balls, where a row has three columns or so, are decided by cuts at the root: many
    // passes, and long Gomory cuts, raise its bound from 244 to the optimum 246 of 741 balls and 710 samples
    // of the bunny; branching for minutes does not.
    model.setMaximumCutPassesAtRoot(-200);  // negative: all of them, also when the bound rises slowly
    model.setMinimumDrop(1e-6);
  }
};

}  // namespace

std::unique_ptr<IpSolver> make_cbc() { return std::make_unique<Cbc>(); }

}  // namespace ballflow::geometry
