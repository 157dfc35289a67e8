#include "cover/bisect_error.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::BisectErrorOptions;

struct BisectError {
  In<geometry::PointSet> points;
  In<geometry::Bisection> search;
  In<geometry::Enclosure> enclosure;
  Out<geometry::Bisection> next;
  BisectErrorOptions options;

  static void declare(NodeDecl<BisectError>& d) {
    d.id("BisectError", 1).summary("Search for the growth with which the error of balls is what is allowed.");
    d.doc(
        "Without search and enclosure, the state of a search that has tried nothing; with max_error 0 one "
        "that is done, with the growth epsilon. In a loop, the state after the growth `search.value` was "
        "tried and the balls that came out had the error that `enclosure` knows: the next growth to try, "
        "until done is 1. Then value is the largest growth known to keep max_error times share. The error is "
        "the larger one of gap_at_most and protrusion: no point of the surface is farther from the balls, no "
        "point of the balls farther from the solid. Fails where balls that do not grow at all have a larger "
        "error, and says which one is reached. Refuses surfaces that are not closed.");
    d.avoid_when("the number of balls matters more than the error: Bisect.");
    d.cites("kornberger2010", "3.5 and 5.2");
    d.memory(1 << 20, 0);
    d.input("points", &BisectError::points).doc("the sample, of whose box growth is a part");
    d.input("search", &BisectError::search).optional().doc("the state before; absent at the beginning");
    d.input("enclosure", &BisectError::enclosure)
        .optional()
        .doc("of the balls made with search.value and the closed surface they stand for");
    d.output("search", &BisectError::next).doc("the state after it");
    d.param("max_error", &BisectError::options, &BisectErrorOptions::max_error)
        .unit("model units")
        .at_least(0)
        .doc("the error that all sides together may have; 0: no search, epsilon is the growth");
    d.param("share", &BisectError::options, &BisectErrorOptions::share)
        .unit("fraction of max_error")
        .above(0)
        .at_most(1)
        .doc("what is allowed here; two sides of a sum have a half each");
    d.param("epsilon", &BisectError::options, &BisectErrorOptions::epsilon)
        .unit("% of the longest bounding-box edge of the sample")
        .at_least(0)
        .doc("the growth where max_error is 0");
    d.param("tolerance", &BisectError::options, &BisectErrorOptions::tolerance)
        .unit("fraction of the error")
        .at_least(0)
        .below(1)
        .doc("good enough are errors of 1 - tolerance of what is allowed, or more; 0 searches longest");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (search.operator bool() != enclosure.operator bool()) {
      throw NodeError("one of the inputs search and enclosure is missing",
                      "connect both, or neither at the beginning of a search");
    }
    const double edge = geometry::bounding_box(points->points.span()).longest_edge();
    next = search ? geometry::bisect_error(*search, *enclosure, options, edge, monitor)
                  : geometry::begin_error_search(options, edge);
  }
};

}  // namespace

const bf_node* bisect_error_entry() { return node_entry<BisectError>(); }

}  // namespace ballflow::nodes
