#include "enclose/enclose_balls.hpp"

#include <ballflow/sdk.hpp>

#include "enclose/allocate_balls.hpp"
#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_fit_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::EncloseBallsOptions;
using geometry::EncloseEffort;

struct EncloseBalls {
  In<geometry::TriangleMesh> mesh;
  In<geometry::Balls> start;
  In<geometry::BallCounts> count;
  Out<geometry::Balls> balls;
  Out<geometry::EnclosureFit> fit;
  EncloseBallsOptions options;

  static void declare(NodeDecl<EncloseBalls>& d) {
    d.id("EncloseBalls", 2)
        .summary(
            "A given number of balls that contain a surface and all inside it, with little volume outside.");
    d.doc(
        "The union of the balls is proven to contain every triangle and everything that the triangles "
        "separate from infinity "
        "(as VerifyEnclosure proves it), and wastes as little volume outside as a local search finds. "
        "Accepts any mesh: open, doubled, "
        "crossing, degenerate triangles, many pieces, either orientation. fit tells about how much volume is "
        "outside, counted on a lattice; "
        "VerifyEnclosure and UnionMeasure tell it exactly. Where more balls gain nothing, fewer are "
        "returned. Refuses meshes without "
        "triangles.");
    d.avoid_when(
        "balls must not stand out of the solid: InsideBalls; or only by a given distance: ProtrudeBalls.");
    d.cites("kingma2015", "all balls move downhill at once by Adam");
    d.cites("ma2012", "inner balls that the search starts from");
    d.library("CGAL", geometry::cgal_version());
    d.memory(64 << 20, 100);
    d.input("mesh", &EncloseBalls::mesh).doc("m triangles, model units");
    d.input("start", &EncloseBalls::start)
        .optional()
        .doc("balls to begin the search with, at most as many as wanted");
    d.input("count", &EncloseBalls::count)
        .optional()
        .doc("how many balls, in place of the parameter: one count, of AllocateBalls");
    d.output("balls", &EncloseBalls::balls)
        .doc(
            "at most as many balls as wanted; radii are 2e-6, and 2.4e-7 of the longest bounding-box edge, "
            "larger than found, against rounding");
    d.output("fit", &EncloseBalls::fit).doc("how many they are, and about how much volume is outside");
    d.param("balls", &EncloseBalls::options, &EncloseBallsOptions::balls)
        .unit("balls")
        .at_least(1)
        .at_most(5000)
        .doc("no more balls than this");
    d.choice("effort", &EncloseBalls::options, &EncloseBallsOptions::effort,
             {{EncloseEffort::low, "low",
               "no rounds of shifts and swaps: half the time, some percent more outside"},
              {EncloseEffort::normal, "normal", "two rounds, one beyond 40 balls"},
              {EncloseEffort::high, "high", "eight rounds: two to three times the time"}})
        .doc("how long the search goes on; it counts work, not time");
    d.param("seed", &EncloseBalls::options, &EncloseBallsOptions::seed)
        .unit("number")
        .at_least(0)
        .doc("other seeds find other balls of about the same volume");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    EncloseBallsOptions wanted = options;
    if (count) wanted.balls = geometry::only_count(*count);
    geometry::EnclosingBalls found =
        geometry::enclose_balls(*mesh, wanted, monitor, start ? &*start : nullptr);
    monitor.note(geometry::describe(found.fit));
    balls = std::move(found.balls);
    fit = found.fit;
  }
};

}  // namespace

const bf_node* enclose_balls_entry() { return node_entry<EncloseBalls>(); }

}  // namespace ballflow::nodes
