#include "surface/surface_balls.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/surface_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::SurfaceBallsOptions;

struct SurfaceBalls {
  In<geometry::LocalFeatureSize> size;
  Out<geometry::Balls> balls, shrunk;
  Out<geometry::PointSet> points;
  Out<geometry::SurfaceBallsReport> report;
  SurfaceBallsOptions options;

  static void declare(NodeDecl<SurfaceBalls>& d) {
    d.id("SurfaceBalls", 4).summary("Balls around samples, as large as the local feature size allows.");
    d.doc(
        "Every sample has a ball around it of radius rho D^, where D^ is the distance to the nearest "
        "pole, but at "
        "least floor times the distance to the third neighbour: where the spacing is as large as the feature "
        "size, "
        "balls of radius rho D^ do not meet. Pruning covers the samples by shrunken copies (output shrunk) "
        "and keeps "
        "the balls themselves (output balls). Larger copies keep fewer balls. The node says on which ground "
        "the union "
        "of the kept balls has the topology of the surface: proven for very small copies of dense samples, "
        "supported "
        "by what the thesis reports, or experience (heuristic), as when balls were raised to the floor or D^ "
        "is from "
        "fewer poles than all.");
    d.avoid_when("the inside of a solid is wanted: these balls follow the surface.");
    d.cites("kornberger2010", "4.5, 4.7 and 4.9.3; Theorem 4.14").cites("aichholzer2009", "surface balls");
    d.input("size", &SurfaceBalls::size).doc("D^ of n samples and the distances to their third neighbours");
    d.output("balls", &SurfaceBalls::balls).doc("n balls, each defined by its sample");
    d.output("shrunk", &SurfaceBalls::shrunk).doc("n shrunken copies, which have to cover the samples");
    d.output("points", &SurfaceBalls::points)
        .doc("n samples, in the order of the balls: what the copies have to cover");
    d.output("report", &SurfaceBalls::report)
        .doc("rho, rho_bar, and the ground on which the union has the topology of the surface");
    d.param("radius", &SurfaceBalls::options, &SurfaceBallsOptions::radius)
        .unit("times the distance to the nearest pole")
        .at_least(0)
        .at_most(2)
        .doc("rho; 0 chooses .56 for shrink up to .3, .8 from .6 on, and between them in proportion");
    d.param("shrink", &SurfaceBalls::options, &SurfaceBallsOptions::shrink)
        .unit("times the distance to the nearest pole")
        .at_least(0)
        .at_most(2)
        .doc("rho_bar, at most radius: the larger, the fewer balls are kept; 0 keeps all");
    d.param("floor", &SurfaceBalls::options, &SurfaceBallsOptions::floor)
        .unit("times the distance to the third neighbour")
        .at_least(0)
        .at_most(10)
        .doc("no ball is smaller; 1.5 for noise as large as the spacing, larger ones bridge gaps");
    d.param("uneven_floor", &SurfaceBalls::options, &SurfaceBallsOptions::uneven_floor)
        .unit("times the distance to the third neighbour")
        .at_least(0)
        .at_most(10)
        .doc(
            "at least this floor where part of the cloud is too coarse: where at 2 % of the samples the "
            "third "
            "neighbour is farther than .8 D^ and twice as far as at half of the samples, and at no more than "
            "half "
            "of the samples farther than .8 D^");
    d.param("smallest", &SurfaceBalls::options, &SurfaceBallsOptions::smallest)
        .unit("model units")
        .at_least(0)
        .doc("no ball is smaller");
    d.param("by_place", &SurfaceBalls::options, &SurfaceBallsOptions::by_place)
        .doc(
            "balls in an order of their places, not of the samples: pruning, which breaks ties by number, "
            "then "
            "keeps the same ones of permuted and of mirrored samples");
    d.memory(1 << 20, 2.0);
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::SurfaceBalls result = geometry::surface_balls(*size, options, monitor);
    balls = std::move(result.balls);
    shrunk = std::move(result.shrunk);
    points = std::move(result.points);
    report = result.report;
  }
};

}  // namespace

const bf_node* surface_balls_entry() { return node_entry<SurfaceBalls>(); }

}  // namespace ballflow::nodes
