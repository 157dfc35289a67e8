#include "ellipsoids/scale_back.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct ScaleBack {
  In<Balls> balls;
  In<Scaling> scaling;
  In<TriangleMesh> mesh;
  In<Bisection> search;
  Out<Ellipsoids> ellipsoids;
  ScaleBackOptions options;

  static void declare(NodeDecl<ScaleBack>& d) {
    d.id("ScaleBack", 1).summary("Balls of a stretched object as ellipsoids of the object, enlarged.");
    d.doc(
        "The ellipsoid of a ball is its image in the object's own space; there it grows by epsilon, or by "
        "max_error in model units. No point of it is then farther than that from the image, and with `mesh`, "
        "the "
        "stretched surface, which shortens balls that stand out, no farther from the solid: the error is "
        "proven in the object's own space, whatever the factors. Growth axes enlarges all three half-axes; "
        "scaled enlarges the ball before it is scaled back, which covers less, and keeps unions images of "
        "unions of balls. Every ball becomes an ellipsoid, in the same order, but for those of radius 0 "
        "that do not grow.");
    d.avoid_when("nothing is stretched: Enlarge grows balls, and knows their topology.");
    d.cites("kornberger2010", "6.4");
    d.memory(16 << 20, 8.0);
    d.input("balls", &ScaleBack::balls).doc("inner balls of the stretched object");
    d.input("scaling", &ScaleBack::scaling).doc("how it was stretched");
    d.input("mesh", &ScaleBack::mesh)
        .optional()
        .doc("the stretched surface: balls reach to it and not beyond");
    d.input("search", &ScaleBack::search)
        .optional()
        .doc("a search for epsilon (see Bisect): its value replaces epsilon and max_error");
    d.output("ellipsoids", &ScaleBack::ellipsoids).doc("in the object's own space");
    d.choice("growth", &ScaleBack::options, &ScaleBackOptions::growth,
             {{EllipsoidGrowth::axes, "axes", "half-axes r / f + e: far fewer pieces"},
              {EllipsoidGrowth::scaled, "scaled",
               "half-axes (r + e) / f, as in the thesis: images of grown balls"}})
        .doc("what grows by e");
    d.param("epsilon", &ScaleBack::options, &ScaleBackOptions::epsilon)
        .unit("% of the longest bounding-box edge of the object")
        .at_least(0)
        .doc("how much the ellipsoids grow, and how far they may be from the solid at most");
    d.param("max_error", &ScaleBack::options, &ScaleBackOptions::max_error)
        .unit("model units")
        .at_least(0)
        .doc("in place of epsilon; 0: epsilon counts");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    ScaledBack result = scale_back(*balls, *scaling, mesh ? *mesh : TriangleMesh(), options,
                                   search ? &*search : nullptr, monitor);
    if (result.shortened > 0) {
      context.info(std::to_string(result.shortened) + " of " + std::to_string(balls->size()) +
                   " balls stood out of the stretched surface and are shortened");
    }
    ellipsoids = std::move(result.ellipsoids);
  }
};

}  // namespace

const bf_node* scale_back_entry() { return node_entry<ScaleBack>(); }

}  // namespace ballflow::nodes
