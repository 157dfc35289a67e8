#include "ellipsoids/principal_scaling.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct PrincipalScaling {
  In<PointSet> points;
  In<TriangleMesh> mesh;
  Out<Scaling> scaling;
  PrincipalScalingOptions options;
  double first = 1, second = 1, third = 1;

  static void declare(NodeDecl<PrincipalScaling>& d) {
    d.id("PrincipalScaling", 1).summary("Axes and factors that make thin directions of an object thick.");
    d.doc(
        "Balls approximate thin objects badly: a sheet needs one every few thicknesses. Where the object is "
        "stretched along perpendicular axes until it is about as thick in all directions, balls of it are "
        "ellipsoids of the object. The axes are the principal ones of the solid, those of its normals, or "
        "the coordinates'; the factor along each is the largest mean chord over the mean chord along it, a "
        "chord being a piece of a line in the solid: for a box that is the ratio of its edges, for a bent "
        "sheet "
        "its thickness counts and not how far it is bent. Surfaces that are not closed, and clouds, go by "
        "the "
        "extents of their boxes. The least factor is 1. Warns where there is nothing to win; refuses flat "
        "objects.");
    d.avoid_when(
        "the object is thin in directions that change a lot (a bowl, a ring of sheet): one frame does not "
        "fit it.");
    d.cites("kornberger2010", "6.4").cites("bischoff2002", "ellipsoids in place of balls");
    d.memory(16 << 20, 4.0);
    d.input("points", &PrincipalScaling::points)
        .doc("points of the object; they count where there is no mesh");
    d.input("mesh", &PrincipalScaling::mesh).optional().doc("its surface, best closed");
    d.output("scaling", &PrincipalScaling::scaling)
        .doc("origin, axes and factors; ApplyScaling and ScaleBack use it");
    d.choice("axes", &PrincipalScaling::options, &PrincipalScalingOptions::axes,
             {{ScalingAxes::principal, "principal",
               "of the second moments of the solid, the surface or the points"},
              {ScalingAxes::normals, "normals", "the third axis is where most of the surface faces"},
              {ScalingAxes::coordinates, "coordinates", "those of the coordinates"}})
        .doc("along which axes the object is stretched");
    d.choice("factors", &PrincipalScaling::options, &PrincipalScalingOptions::factors,
             {{ScalingFactors::chords, "chords",
               "by mean chords of the solid; by extents where it is not closed"},
              {ScalingFactors::extents, "extents", "by the edges of its box along the axes"},
              {ScalingFactors::given, "given", "first, second and third, divided by the least of them"}})
        .doc("by how much");
    d.param("stretch", &PrincipalScaling::options, &PrincipalScalingOptions::stretch)
        .unit("1")
        .at_least(0)
        .at_most(1000)
        .doc("factors f of the rule become 1 + stretch (f - 1): 0 gives balls");
    d.param("first", &PrincipalScaling::first)
        .unit("1")
        .above(0)
        .doc("factors = given: along the axis with the largest moment");
    d.param("second", &PrincipalScaling::second)
        .unit("1")
        .above(0)
        .doc("factors = given: along the second axis");
    d.param("third", &PrincipalScaling::third)
        .unit("1")
        .above(0)
        .doc("factors = given: along the third axis, the thin one");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    options.given = {first, second, third};
    scaling = principal_scaling(*points, mesh ? *mesh : TriangleMesh(), options, monitor);
  }
};

}  // namespace

const bf_node* principal_scaling_entry() { return node_entry<PrincipalScaling>(); }

}  // namespace ballflow::nodes
