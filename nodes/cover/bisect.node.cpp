#include "cover/bisect.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::BisectOptions;

struct Bisect {
  In<geometry::Bisection> search;
  In<geometry::CoverState> cover;
  Out<geometry::Bisection> next;
  BisectOptions options;

  static void declare(NodeDecl<Bisect>& d) {
    d.id("Bisect", 1).summary("Search for the growth with which a given number of balls is enough.");
    d.doc(
        "Without inputs, the state of a search that has tried nothing. In a loop, the state after the growth "
        "`search.value` was tried and `cover` came out: the next growth to try, until done is 1. Then value "
        "is the smallest growth known to need at most `balls`. Growth changes by factors of 4 until it is "
        "known from both sides, then by bisection in ratios. Warns when the number of balls jumps over what "
        "was asked for, and when no growth at all needs fewer. Refuses a cover that is not finished, and "
        "fails when the largest growth allowed still needs more balls.");
    d.avoid_when("the error matters more than the number of balls: BisectError, or choose epsilon.");
    d.cites("kornberger2010", "3.5 and 3.6");
    d.memory(1 << 20, 0);
    d.input("search", &Bisect::search).optional().doc("the state before; absent at the beginning");
    d.input("cover", &Bisect::cover).optional().doc("a finished cover made with search.value");
    d.output("search", &Bisect::next).doc("the state after it");
    d.param("balls", &Bisect::options, &BisectOptions::balls)
        .unit("balls")
        .at_least(1)
        .doc("never more balls than this");
    d.param("tolerance", &Bisect::options, &BisectOptions::tolerance)
        .unit("fraction of balls")
        .at_least(0)
        .below(1)
        .doc("good enough are balls (1 - tolerance) or more; 0 searches until exactly that number is found");
    d.param("start", &Bisect::options, &BisectOptions::start)
        .unit("unit of the growth that is searched")
        .above(0)
        .doc("the growth to try first");
    d.param("largest", &Bisect::options, &BisectOptions::largest)
        .unit("unit of the growth that is searched")
        .above(0)
        .doc("the largest growth allowed");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (search.operator bool() != cover.operator bool()) {
      throw NodeError("one of the inputs search and cover is missing",
                      "connect both, or neither at the beginning of a search");
    }
    next = search ? geometry::bisect(*search, *cover, options, monitor) : geometry::begin_bisection(options);
  }
};

}  // namespace

const bf_node* bisect_entry() { return node_entry<Bisect>(); }

}  // namespace ballflow::nodes
