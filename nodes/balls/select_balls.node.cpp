#include "balls/select_balls.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::SelectBallsOptions;

struct SelectBalls {
  In<geometry::CoverState> cover;
  In<geometry::Balls> balls;
  Out<geometry::Balls> selected;
  SelectBallsOptions options;

  static void declare(NodeDecl<SelectBalls>& d) {
    d.id("SelectBalls", 1).summary("Take the balls that a set cover chose.");
    d.doc(
        "The chosen balls in the order of their indices, with their defining samples. Refuses a cover about "
        "another "
        "number of balls, and one that leaves samples to be covered (unless allowed).");
    d.avoid_when("all balls are wanted: connect them directly.");
    d.cites("kornberger2010", "3.6");
    d.memory(1 << 20, 1.0);
    d.input("cover", &SelectBalls::cover).doc("a finished cover: remaining = 0");
    d.input("balls", &SelectBalls::balls).doc("the balls the covering matrix was made of, row i is ball i");
    d.output("balls", &SelectBalls::selected).doc("the chosen balls, ascending by index");
    d.param("allow_unfinished", &SelectBalls::options, &SelectBallsOptions::allow_unfinished)
        .doc("take what is chosen so far although samples remain to be covered");
  }
  void run(RunContext&) { selected = geometry::select_balls(*cover, *balls, options); }
};

}  // namespace

const bf_node* select_balls_entry() { return node_entry<SelectBalls>(); }

}  // namespace ballflow::nodes
