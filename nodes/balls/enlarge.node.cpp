#include "balls/enlarge.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AlphaTolerance;
using geometry::EnlargeMode;
using geometry::EnlargeOptions;
using geometry::PoleBoundConstant;
using geometry::PoleBoundOptions;
using geometry::PowerGrowthOptions;

struct Enlarge {
  In<geometry::Balls> balls;
  In<geometry::PointSet> points;
  In<geometry::PoleSet> poles;
  In<geometry::Bisection> search;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::Balls> enlarged;
  Out<geometry::Growth> growth;
  EnlargeOptions options;
  PoleBoundOptions pole_bound;
  PowerGrowthOptions power_diagram;

  static void declare(NodeDecl<Enlarge>& d) {
    d.id("Enlarge", 2).summary("Grow radii so that pruning may drop small features.");
    d.doc(
        "Every ball keeps its center, its place in the order and its defining samples; no radius shrinks. "
        "Modes additive, absolute and multiplicative grow as asked for, and nothing keeps the union from "
        "changing its topology when epsilon is larger than a gap of the shape. In modes pole_bound and "
        "power_diagram epsilon is a wish, and a bound wins; `growth` says for every ball which bound stopped "
        "it. pole_bound keeps inner balls off the outer medial axis, which is necessary for the topology but "
        "not sufficient. power_diagram stops balls at the critical Gabriel points of the union, compares the "
        "grown union with the one before by the map that the inclusion induces in homology over Z/2, and "
        "where that is no isomorphism stops neighbours of stopped balls too. Accepts any balls. Refuses "
        "percent without a sample, pole_bound without "
        "poles, and radii that leave the range of doubles.");
    d.avoid_when("balls must not grow at all: connect them directly.");
    d.cites("kornberger2010", "3.5, Lemma 3.4, 3.5.2").library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);
    d.input("balls", &Enlarge::balls).doc("n balls, model units");
    d.input("points", &Enlarge::points)
        .optional()
        .doc("the sample the balls were made from; needed by all modes but absolute and multiplicative");
    d.input("poles", &Enlarge::poles).optional().doc("the poles of the sample; needed by mode pole_bound");
    d.input("search", &Enlarge::search)
        .optional()
        .doc("a search for epsilon (see Bisect): its value replaces the parameter");
    d.input("diagram", &Enlarge::diagram)
        .optional()
        .doc(
            "the power diagram of the balls (node PowerDiagram with the tolerance set here), which mode "
            "power_diagram then need not compute; other modes do not look at it");
    d.output("balls", &Enlarge::enlarged).doc("n balls, same order, radii >= input");
    d.output("growth", &Enlarge::growth).doc("radii before and after, and what stopped each ball");
    d.choice(
         "mode", &Enlarge::options, &EnlargeOptions::mode,
         {{EnlargeMode::additive, "additive",
           "radius + epsilon % of the longest bounding-box edge of the sample"},
          {EnlargeMode::absolute, "absolute", "radius + epsilon model units"},
          {EnlargeMode::multiplicative, "multiplicative", "radius * factor"},
          {EnlargeMode::pole_bound, "pole_bound", "as additive, but off the outer medial axis (Lemma 3.4)"},
          {EnlargeMode::power_diagram, "power_diagram",
           "as additive, but so that the union keeps its topology (3.5.2, verified by the inclusion)"}})
        .doc(
            "additive growth gives noise the same significance everywhere, multiplicative growth spares thin "
            "parts");
    d.param("epsilon", &Enlarge::options, &EnlargeOptions::epsilon)
        .unit("% of the longest bounding-box edge of the sample, or model units (absolute)")
        .at_least(0)
        .doc(
            "how much radii grow in all modes but multiplicative; 0 returns the input (power_diagram: with "
            "its tolerance added), beyond about 3 % "
            "little of the shape remains");
    d.param("factor", &Enlarge::options, &EnlargeOptions::factor)
        .unit("1")
        .at_least(1)
        .doc("by what radii are multiplied in mode multiplicative; 1 returns the input");
    d.param("r", &Enlarge::pole_bound, &PoleBoundOptions::r)
        .unit("fraction of the local feature size")
        .above(0)
        .at_most(0.08)
        .doc("mode pole_bound: how dense the sample is; smaller values let balls grow more");
    d.choice("constant", &Enlarge::pole_bound, &PoleBoundOptions::constant,
             {{PoleBoundConstant::safe, "safe", "0.817 - 2.5604 r / (1 - r), which the proof supports"},
              {PoleBoundConstant::thesis, "thesis", "0.817 - 1.2802 r / (1 - r), as printed"}})
        .doc("mode pole_bound: the factor of D^ in Lemma 3.4");
    d.choice("tolerance", &Enlarge::power_diagram, &PowerGrowthOptions::tolerance,
             {{AlphaTolerance::polar, "polar", "for polar balls: 2^-36 L^2, L the longest edge of the box"},
              {AlphaTolerance::none, "none", "balls are what their radii say"}})
        .doc("mode power_diagram: what is added to squared radii so that balls that touch overlap");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (search) options = geometry::searched(options, *search);
    options.pole_bound = pole_bound;
    options.power_diagram = power_diagram;
    geometry::Enlarged result = geometry::enlarge(*balls, points ? *points : geometry::PointSet{},
                                                  poles ? *poles : geometry::PoleSet{}, options, monitor,
                                                  diagram ? &*diagram : nullptr);
    enlarged = std::move(result.balls);
    growth = std::move(result.growth);
  }
};

}  // namespace

const bf_node* enlarge_entry() { return node_entry<Enlarge>(); }

}  // namespace ballflow::nodes
