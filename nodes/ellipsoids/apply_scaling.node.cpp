#include "ellipsoids/apply_scaling.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct ApplyScaling {
  In<Scaling> scaling;
  In<PointSet> points;
  In<TriangleMesh> mesh;
  Out<PointSet> scaled_points;
  Out<TriangleMesh> scaled_mesh;
  ScalingDirection direction = ScalingDirection::forth;

  static void declare(NodeDecl<ApplyScaling>& d) {
    d.id("ApplyScaling", 1).summary("Stretch points and a mesh, or bring them back to their own space.");
    d.doc(
        "Forth, coordinates are those along the axes of the scaling, from its origin on, times the factors; "
        "back "
        "is the inverse. Order, triangles and which points are equal stay. Refuses points that rounding "
        "makes "
        "equal.");
    d.avoid_when("balls are to be scaled back: that is ScaleBack.");
    d.cites("kornberger2010", "6.4");
    d.memory(1 << 20, 3.0);
    d.input("scaling", &ApplyScaling::scaling).doc("of PrincipalScaling");
    d.input("points", &ApplyScaling::points).optional().doc("points; normals are mapped as normals");
    d.input("mesh", &ApplyScaling::mesh).optional().doc("a mesh");
    d.output("points", &ApplyScaling::scaled_points).doc("the points, none where none were given");
    d.output("mesh", &ApplyScaling::scaled_mesh).doc("the mesh, without triangles where none was given");
    d.choice("direction", &ApplyScaling::direction,
             {{ScalingDirection::forth, "forth", "to where the object is stretched"},
              {ScalingDirection::back, "back", "to its own space"}})
        .doc("which way");
  }
  void run(RunContext&) {
    if (points) scaled_points = apply_scaling(*points, *scaling, direction);
    if (mesh) scaled_mesh = apply_scaling(*mesh, *scaling, direction);
  }
};

}  // namespace

const bf_node* apply_scaling_entry() { return node_entry<ApplyScaling>(); }

}  // namespace ballflow::nodes
