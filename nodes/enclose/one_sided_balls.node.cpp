#include "enclose/one_sided_balls.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::BallSide;
using geometry::OneSidedBallsOptions;

struct OneSidedBalls {
  In<geometry::TriangleMesh> mesh, solid;
  In<geometry::Balls> balls;
  Out<geometry::Balls> result;
  OneSidedBallsOptions options;

  static void declare(NodeDecl<OneSidedBalls>& d) {
    d.id("OneSidedBalls", 2)
        .summary("Give balls other radii, so that they lie inside a solid, or contain it.");
    d.doc(
        "Keeps the centres. Side inner: every radius becomes the distance of the centre from the surface; "
        "centres that are not inside are left out. Side outer: radii begin with these, the triangles are cut "
        "into parts, and every part makes the ball grow that holds it with least growth, those that need "
        "most first; a void that the balls close off inside gets a ball that touches the surface. "
        "VerifyEnclosure proves what came out: a protrusion of 0, or that the balls enclose. Inner refuses "
        "meshes that are not closed; outer takes any, as VerifyEnclosure does. Refuses meshes without "
        "triangles.");
    d.avoid_when(
        "a number of balls is given, and centres are free: EncloseBalls, InsideBalls; they take longer, and "
        "waste less with few balls.");
    d.cites("kornberger2010", "3.4, 3.5 and 5.2");
    d.library("CGAL", geometry::cgal_version());
    d.memory(64 << 20, 200);
    d.input("mesh", &OneSidedBalls::mesh).doc("m triangles, model units; orientation does not matter");
    d.input("balls", &OneSidedBalls::balls).doc("n balls of the same model, in the same place and unit");
    d.input("solid", &OneSidedBalls::solid)
        .optional()
        .doc(
            "a closed mesh whose inside and surface count in place of the mesh's, which is then what has to "
            "be "
            "covered: for discs the prism of PolygonMeshes");
    d.output("balls", &OneSidedBalls::result)
        .doc("balls with the same centres, in the same order, without those left out; fillings last");
    d.choice("side", &OneSidedBalls::options, &OneSidedBallsOptions::side,
             {{BallSide::inner, "inner", "every ball lies inside the solid"},
              {BallSide::outer, "outer", "the union contains the solid"}})
        .doc("which side of the surface the balls bound it from");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    result = geometry::one_sided_balls(*mesh, *balls, options, monitor, solid ? &*solid : nullptr);
  }
};

}  // namespace

const bf_node* one_sided_balls_entry() { return node_entry<OneSidedBalls>(); }

}  // namespace ballflow::nodes
