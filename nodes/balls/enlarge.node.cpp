#include "balls/enlarge.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::EnlargeMode;
using geometry::EnlargeOptions;

struct Enlarge {
  In<geometry::Balls> balls;
  In<geometry::PointSet> points;
  Out<geometry::Balls> enlarged;
  EnlargeOptions options;

  static void declare(NodeDecl<Enlarge>& d) {
    d.id("Enlarge", 1).summary("Grow radii so that pruning may drop small features.");
    d.doc(
        "Every ball keeps its center, its place in the order and its defining samples; no radius shrinks. "
        "Accepts "
        "any balls. Refuses an additive epsilon without a sample, and radii that leave the range of doubles. "
        "Nothing keeps the union from changing its topology when epsilon is larger than a gap of the shape.");
    d.avoid_when(
        "the union must keep its topology whatever the shape: compare Betti numbers before and after.");
    d.cites("kornberger2010", "3.5");
    d.memory(0, 0);
    d.input("balls", &Enlarge::balls).doc("n balls, model units");
    d.input("points", &Enlarge::points)
        .optional()
        .doc("the sample the balls were made from: its bounding box is the unit of epsilon in mode additive");
    d.output("balls", &Enlarge::enlarged).doc("n balls, same order, radii >= input");
    d.choice("mode", &Enlarge::options, &EnlargeOptions::mode,
             {{EnlargeMode::additive, "additive",
               "radius + epsilon % of the longest bounding-box edge of the sample"},
              {EnlargeMode::absolute, "absolute", "radius + epsilon model units"},
              {EnlargeMode::multiplicative, "multiplicative", "radius * factor"}})
        .doc(
            "additive growth gives noise the same significance everywhere, multiplicative growth spares thin "
            "parts");
    d.param("epsilon", &Enlarge::options, &EnlargeOptions::epsilon)
        .unit("% of the longest bounding-box edge of the sample (additive) or model units (absolute)")
        .at_least(0)
        .doc(
            "how much radii grow in modes additive and absolute; 0 returns the input, beyond about 3 % "
            "little of "
            "the shape remains");
    d.param("factor", &Enlarge::options, &EnlargeOptions::factor)
        .unit("1")
        .at_least(1)
        .doc("by what radii are multiplied in mode multiplicative; 1 returns the input");
  }
  void run(RunContext&) {
    enlarged =
        geometry::enlarge(*balls, points ? geometry::bounding_box(points->points) : geometry::Box{}, options);
  }
};

}  // namespace

const bf_node* enlarge_entry() { return node_entry<Enlarge>(); }

}  // namespace ballflow::nodes
