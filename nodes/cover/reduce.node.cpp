#include "cover/reduce.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct Reduce {
  In<CoverState> cover;
  Out<CoverState> reduced;
  ReduceOptions options;

  static void declare(NodeDecl<Reduce>& d) {
    d.id("Reduce", 1)
        .summary("Remove dominated balls, dominating samples and essential balls; the optimum stays.");
    d.doc(
        "Applies the three reduction rules of set covering in synchronous passes until none applies. "
        "Essential "
        "balls are chosen. Among equal rows or columns the one of lowest index stays, so every subset_test "
        "gives "
        "the same residual matrix.");
    d.avoid_when("a greedy cover is good enough: Greedy alone is faster on the whole matrix.");
    d.cites("kornberger2010", "3.6.1 and 3.8.2").cites("cuthill1969", "2");
    d.input("cover", &Reduce::cover).doc("any state of a set covering computation");
    d.output("cover", &Reduce::reduced).doc("the same instance: essential balls chosen, a smaller matrix");
    d.choice("subset_test", &Reduce::options, &ReduceOptions::subset_test,
             {{SubsetTest::inverted_index, "inverted_index",
               "compares with the sets that share the rarest element"},
              {SubsetTest::hash, "hash",
               "compares signatures of 64 sections with those of all other sets: quadratic, for comparison"},
              {SubsetTest::bandwidth, "bandwidth",
               "compares with the sets nearby after a bandwidth-reducing permutation, for comparison"}})
        .doc("how candidates for an inclusion are found: changes the time, not the result")
        .not_hashed();
    d.memory(1 << 20, 2.5);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    reduced = reduce(*cover, options, monitor);
  }
};

}  // namespace

const bf_node* reduce_entry() { return node_entry<Reduce>(); }

}  // namespace ballflow::nodes
