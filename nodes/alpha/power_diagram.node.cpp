#include "power/power_diagram.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AlphaTolerance;
using geometry::PowerDiagramOptions;

struct PowerDiagram {
  In<geometry::Balls> balls;
  Out<geometry::PowerDiagram> diagram;
  PowerDiagramOptions options;

  static void declare(NodeDecl<PowerDiagram>& d) {
    d.id("PowerDiagram", 1)
        .summary("The power diagram of balls, by its dual: made once, for all that look at their union.");
    d.doc(
        "The regular triangulation of the balls with the neighbours of every cell, and which cells and "
        "facets are "
        "in the dual complex of the union, decided exactly. AlphaShape, MedialAxis, UnionMeasure, "
        "UnionTopology and TopologyRepair take it instead of triangulating again. Accepts and refuses what "
        "AlphaShape does; of "
        "balls "
        "with one center the largest counts, the first of equal ones.");
    d.avoid_when("only one node looks at the union: it can take the balls themselves.");
    d.cites("kornberger2010", "2.5 and 2.6")
        .cites("edelsbrunner1995", "the union of balls and its dual shape");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);
    d.input("balls", &PowerDiagram::balls).doc("n closed balls, model units");
    d.output("diagram", &PowerDiagram::diagram).doc("cells, neighbours and flags over the n balls");
    d.choice(
         "tolerance", &PowerDiagram::options, &PowerDiagramOptions::tolerance,
         {{AlphaTolerance::none, "none",
           "the balls are taken as they are: enlarged or other balls in general position"},
          {AlphaTolerance::polar, "polar",
           "2^-36 of the squared longest bounding-box edge is added to every squared radius, so that polar "
           "balls through one sample overlap whatever rounding says; recorded as delta"}})
        .doc("what is added to squared radii before anything is decided");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    diagram = geometry::power_diagram(*balls, options, monitor);
  }
};

}  // namespace

const bf_node* power_diagram_entry() { return node_entry<PowerDiagram>(); }

}  // namespace ballflow::nodes
