#include "prior/match.hpp"

#include <ballflow/sdk.hpp>

#include "prior/eigen_version.hpp"
#include "types/artifact_types.hpp"
#include "types/prior_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::MatchOptions;
using geometry::MatchTo;

struct TemplateBalls {
  In<geometry::Balls> balls, inner;
  Out<geometry::Balls> members;

  static void declare(NodeDecl<TemplateBalls>& d) {
    d.id("TemplateBalls", 1)
        .summary("The balls of a template as they were before they grew, without tiny ones.");
    d.doc(
        "Few balls of a surface have grown, each by another length; for a match every ball has the center "
        "and "
        "radius of the inner ball that it was. Balls with less than a twentieth of the median radius are "
        "left "
        "out: pruning puts balls of radius 0 where no other covers a sample. Refuses empty sets.");
    d.avoid_when("balls are to cover the surface: these lie inside.");
    d.cites("kornberger2010", "6.3.1").cites("fine2001", "Cholesky with pivots");
    d.memory(1 << 20, 4);
    d.input("balls", &TemplateBalls::balls).doc("k balls of the template, grown or not");
    d.input("inner", &TemplateBalls::inner).doc("its inner balls before they grew");
    d.output("balls", &TemplateBalls::members).doc("at most k of the inner balls, in the order of balls");
  }
  void run(RunContext&) { members = geometry::template_balls(*balls, *inner); }
};

struct Match {
  In<geometry::Balls> balls, inner;
  In<geometry::PointSet> target, points;
  In<geometry::ShapePose> pose;
  Out<geometry::MatchedBalls> matched;
  MatchOptions options;

  static void declare(NodeDecl<Match>& d) {
    d.id("Match", 1).summary("The balls and surface points of a template, found again on another shape.");
    d.doc(
        "Coherent point drift: samples of both surfaces draw the template along a field "
        "that "
        "is smooth by a Gaussian kernel; it begins where shapes are aligned, not from scratch. Each carried "
        "ball is "
        "then replaced by the nearest of the instance's own inner balls in center and radius, where one is "
        "near: "
        "carried into thin parts it would lie outside. The carried balls go with it: they are without the "
        "noise of poles. Of every ball it tells how far that was, whether "
        "there was "
        "one, and whether it was taken twice; the pose is found again with the labels. Refuses empty sets, "
        "samples "
        "without normals, balls of radius 0.");
    d.avoid_when(
        "parts of the shapes do not correspond, or they are not aligned to a few degrees: it ends in a wrong "
        "correspondence, smooth and plausible.");
    d.cites("myronenko2010", "coherent point drift, low rank").cites("kornberger2010", "6.3.1");
    d.library("Eigen", geometry::eigen_version());
    d.memory(std::uint64_t{128} << 20, 64);
    d.input("balls", &Match::balls).doc("k balls of the template inside its surface: TemplateBalls");
    d.input("target", &Match::target).doc("m samples of the template's surface, with normals");
    d.input("points", &Match::points).doc("n samples of the instance's surface, with normals");
    d.input("inner", &Match::inner).doc("the instance's own inner balls, before they grow");
    d.input("pose", &Match::pose).doc("from the instance to the template");
    d.output("matched", &Match::matched).doc("k balls and m points, in the instance's coordinates");
    d.param("width", &Match::options, &MatchOptions::width)
        .unit("radii of the template")
        .at_least(0.1)
        .at_most(20)
        .doc("of the kernel: how far a displacement reaches; the radius is root mean square, of the samples");
    d.param("stiffness", &Match::options, &MatchOptions::stiffness)
        .unit("factor")
        .at_least(1e-3)
        .at_most(1e6)
        .doc("how much smoothness counts: small values follow the surface closely, to wrong places");
    d.choice("to", &Match::options, &MatchOptions::to,
             {{MatchTo::planes, "planes",
               "distances along a surface hardly count, so samples of flat faces stay"},
              {MatchTo::points, "points", "distances count the same in all directions"}})
        .doc("what samples are drawn to");
    d.param("outliers", &Match::options, &MatchOptions::outliers)
        .unit("share of the samples")
        .at_least(0)
        .at_most(0.9)
        .doc("that have no counterpart");
    d.param("start", &Match::options, &MatchOptions::start)
        .unit("radii of the template")
        .at_least(0.001)
        .at_most(10)
        .doc("deviation of the distances to begin with, after alignment");
    d.param("reach", &Match::options, &MatchOptions::reach)
        .unit("share of the diagonal")
        .at_least(0)
        .at_most(1)
        .doc("a carried ball farther than this from all balls of the instance has no partner");
    d.param("centers", &Match::options, &MatchOptions::centers)
        .unit("balls")
        .at_least(0)
        .at_most(10000)
        .doc(
            "of the instance, evenly chosen, that draw the balls besides; 0: samples of the surface alone, "
            "which is more exact with planes");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    matched = geometry::match(*balls, *target, *points, *inner, *pose, options, monitor);
  }
};

}  // namespace

const bf_node* match_entry() { return node_entry<Match>(); }
const bf_node* template_balls_entry() { return node_entry<TemplateBalls>(); }

}  // namespace ballflow::nodes
