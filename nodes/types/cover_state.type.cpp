#include "types/cover_state.hpp"

#include <array>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::CoverState>::declare(TypeDecl<geometry::CoverState>& d) {
  using T = geometry::CoverState;
  d.id("CoverState", 3)
      .doc("A set covering instance on its way to a solution: residual matrix, choices, bounds.");
  d.scalar("balls", &T::balls).doc("number of balls of the original instance");
  d.scalar("samples", &T::samples).doc("number of samples of the original instance");
  d.scalar("left_out", &T::left_out)
      .doc("balls that are no row because the matrix would be too large: candidates alone are rows");
  d.array("row_offsets", &T::row_offsets).length("r+1").doc("where the columns of a row begin");
  d.array("columns", &T::columns).length("nnz").doc("column indices of the residual matrix, rows ascending");
  d.array("row_ids", &T::row_ids).length("r").doc("ball of each row");
  d.array("column_ids", &T::column_ids).length("c").doc("sample of each column");
  d.array("chosen", &T::chosen).length("k").doc("chosen balls in order of choice");
  d.array("chosen_how", &T::chosen_how)
      .length("k")
      .doc("0 essential, 1 exact, 2 greedy, 3 trusted, 4 all, 5 searched, 6 returned to keep the topology");
  d.array("uncovered", &T::uncovered).length("u").doc("samples that no ball covers");
  d.scalar("lower_bound", &T::lower_bound).doc("proven lower bound on any cover, -1 while nothing is known");
  d.scalar("lower_bound_how", &T::lower_bound_how)
      .doc("0 unknown, 1 solver, 2 Lemma 3.7, 3 share bound, 4 certified");
  d.array("certificate_samples", &T::certificate_samples).length("l").doc("samples with a price, by group");
  d.array("certificate_prices", &T::certificate_prices)
      .length("l")
      .doc("price of the sample, in 2^-20 balls");
  d.array("certificate_groups", &T::certificate_groups)
      .length("l")
      .doc("group of the sample, ascending from 0");
  d.scalar("settled_groups", &T::settled_groups)
      .doc("the first groups of the certificate, about what has left the matrix");
  d.summary("rows", "balls left in the matrix").summary("cols", "samples left in the matrix");
  d.summary("nnz", "entries of the matrix").summary("chosen", "balls chosen so far");
  d.summary("remaining", "samples that no chosen ball covers yet");
  d.summary("lower_bound", "no cover has fewer balls; null while nothing is known");
  d.summary("lower_bound_how", "its ground: certified, share, lemma_3_7, solver, or unknown");
  d.summary("certified_bound", "what the certificate of the state proves, 0 without one");
  d.summary("upper_bound", "chosen balls once nothing remains, else null");
  d.summary("gap", "(upper - lower) / lower, a fraction; null while a bound is unknown");
  d.summary("essential", "chosen as the only ball of a sample")
      .summary("exact", "chosen by exact optimisation");
  d.summary("greedy", "chosen greedily: each may cost one ball more than the optimum");
  d.summary("trusted", "from a solver that stopped before it proved optimality");
  d.summary("searched", "kept by local search, or needed by a matrix that leaves balls out");
  d.summary("left_out", "balls that are no row because the matrix would be too large");
  d.summary("returned", "returned by TopologyRepair, in its output only");
  d.summary("uncovered", "samples that no ball covers");
  d.summarize([](const T& v) {
    constexpr std::array<const char*, 5> grounds{"unknown", "solver", "lemma_3_7", "share", "certified"};
    const auto upper = v.upper_bound();
    const auto gap = v.gap();
    return Summary{{"rows", v.rows()},
                   {"cols", v.cols()},
                   {"nnz", v.nnz()},
                   {"chosen", v.chosen.size()},
                   {"remaining", v.remaining()},
                   {"lower_bound", v.lower_bound < 0 ? SummaryValue(nullptr) : SummaryValue(v.lower_bound)},
                   {"lower_bound_how", grounds[v.lower_bound_how]},
                   {"certified_bound", v.certified_bound()},
                   {"upper_bound", upper ? SummaryValue(*upper) : SummaryValue(nullptr)},
                   {"gap", gap ? SummaryValue(*gap) : SummaryValue(nullptr)},
                   {"essential", v.count(geometry::Choice::essential)},
                   {"exact", v.count(geometry::Choice::exact)},
                   {"greedy", v.count(geometry::Choice::greedy)},
                   {"trusted", v.count(geometry::Choice::trusted)},
                   {"searched", v.count(geometry::Choice::searched)},
                   {"left_out", v.left_out},
                   {"uncovered", v.uncovered.size()}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
