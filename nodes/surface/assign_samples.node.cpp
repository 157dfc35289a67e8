#include "surface/assign_samples.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/surface_types.hpp"

namespace ballflow::nodes {
namespace {

struct AssignSamples {
  In<geometry::Balls> balls;
  In<geometry::PointSet> points, original;
  In<geometry::SurfaceReport> surface;
  Out<geometry::SampleAssignment> assignment;

  static void declare(NodeDecl<AssignSamples>& d) {
    d.id("AssignSamples", 1).summary("Tell which vertex of a surface every sample belongs to.");
    d.doc(
        "Every sample belongs to the ball to which it has the least power, the squared distance to the "
        "centre less the squared radius; of several balls, compared exactly, to the one with the lowest "
        "index. With the report of a surface it belongs to a vertex as well, the one of the ball with the "
        "least power among those whose centre is on the surface: a few kept balls are not. A vertex that is "
        "there several times, where sheets touch, has its samples at its first copy. Refuses empty sets of "
        "balls and reports of other balls.");
    d.avoid_when("the nearest vertex is wanted: power prefers large balls.");
    d.cites("kornberger2010", "4.5.3, the list of pointers from samples to vertices");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 2.0);
    d.input("balls", &AssignSamples::balls).doc("the kept surface balls");
    d.input("points", &AssignSamples::points).doc("n samples");
    d.input("surface", &AssignSamples::surface)
        .optional()
        .doc("the report of the surface through the balls; without it samples belong to balls only");
    d.input("original", &AssignSamples::original)
        .optional()
        .doc("the samples as they came, where they were denoised: listed in place of points");
    d.output("assignment", &AssignSamples::assignment).doc("ball and vertex of each sample, in their order");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    assignment = geometry::assign_samples(*balls, *points, surface ? &*surface : nullptr,
                                          original ? &*original : nullptr, monitor);
  }
};

}  // namespace

const bf_node* assign_samples_entry() { return node_entry<AssignSamples>(); }

}  // namespace ballflow::nodes
