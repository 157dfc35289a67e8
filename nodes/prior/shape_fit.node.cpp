#include "prior/shape_fit.hpp"

#include <ballflow/sdk.hpp>
#include <optional>

#include "prior/eigen_version.hpp"
#include "types/artifact_types.hpp"
#include "types/prior_types.hpp"
#include "types/shape_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::ShapeFitOptions;

struct ShapeFit {
  In<geometry::ShapePrior> prior;
  In<geometry::PointSet> points;
  In<geometry::Balls> balls;
  In<geometry::ShapePose> pose;
  Out<geometry::ShapeFit> fit;
  Out<geometry::Balls> fitted;
  Out<geometry::PointSet> surface;
  ShapeFitOptions options;

  static void declare(NodeDecl<ShapeFit>& d) {
    d.id("ShapeFit", 1)
        .summary("The most plausible whole shape of a model for an observation of a part of it.");
    d.doc(
        "Scores and pose of the model given points on the surface, or balls, of a part: posterior mean and "
        "covariance. Every point comes from a Gaussian around a part of the shape or, as an outlier, from "
        "anywhere; parts that nobody has seen are drawn nowhere. Points of one surface do not err "
        "independently, so all of them count as `effective` independent ones. Says how far the observation "
        "is "
        "from the model: its distance from the shape against that of unknown instances from models without "
        "them, how much of it no part explains, how unusual the scores are; each is a warning where it is "
        "large. Refuses fewer than 4 points, and an observation that lies nowhere near the model.");
    d.avoid_when(
        "the observation shows all of the shape: Match keeps what the model does not know; and where the "
        "mean "
        "alone is wanted (modes = 1 comes near it, ShapeInstance without scores is it).");
    d.cites("myronenko2010", "points as a mixture of Gaussians around a shape");
    d.cites("cootes1995", "shapes by their scores").cites("kornberger2010", "6.3.1");
    d.library("Eigen", geometry::eigen_version());
    d.memory(std::uint64_t{32} << 20, 8);
    d.input("prior", &ShapeFit::prior).doc("mean and modes");
    d.input("points", &ShapeFit::points)
        .optional()
        .doc("on a part of the surface; normals are used where given");
    d.input("balls", &ShapeFit::balls).optional().doc("of a part of the shape, where there are no points");
    d.input("pose", &ShapeFit::pose)
        .optional()
        .doc(
            "from the observation to the coordinates of the model, about 10 degrees right; else it lies "
            "there "
            "already");
    d.output("fit", &ShapeFit::fit).doc("scores with covariance, pose, distances");
    d.output("balls", &ShapeFit::fitted).doc("the fitted shape, in the coordinates of the observation");
    d.output("points", &ShapeFit::surface).doc("its surface points, without normals");
    d.param("effective", &ShapeFit::options, &ShapeFitOptions::effective)
        .unit("observations")
        .above(0)
        .at_most(1e6)
        .doc("as many independent ones are all points together: fewer stay nearer to the mean; 10 to 50");
    d.param("width", &ShapeFit::options, &ShapeFitOptions::width)
        .unit("% of the root mean square radius of the model")
        .above(0)
        .at_most(1000)
        .doc("how far correspondences are looked for at the beginning");
    d.param("scale", &ShapeFit::options, &ShapeFitOptions::scale)
        .doc("the shape may be scaled, too: for models of scaled instances");
    d.param("modes", &ShapeFit::options, &ShapeFitOptions::modes)
        .unit("modes")
        .at_least(0)
        .at_most(10000)
        .doc("at most; 0: all of the model");
    d.param("points", &ShapeFit::options, &ShapeFitOptions::points)
        .unit("points")
        .at_least(4)
        .at_most(1e6)
        .doc("of the observation that are used, at most");
    d.param("iterations", &ShapeFit::options, &ShapeFitOptions::iterations)
        .unit("steps")
        .at_least(1)
        .at_most(10000)
        .doc("at most");
  }
  void run(RunContext& context) {
    if (static_cast<bool>(points) == static_cast<bool>(balls)) {
      throw geometry::InputError(
          points ? "points and balls are connected" : "neither points nor balls are connected",
          "connect the one or the other: what has been observed");
    }
    ContextMonitor monitor(context);
    const std::optional<geometry::ShapePose> start =
        pose ? std::optional<geometry::ShapePose>(*pose) : std::nullopt;
    geometry::ShapeFit result = points ? geometry::shape_fit(*prior, *points, start, options, monitor)
                                       : geometry::shape_fit(*prior, *balls, start, options, monitor);
    fitted = geometry::balls_of(result);
    surface = geometry::points_of(*prior, result);
    fit = std::move(result);
  }
};

}  // namespace

const bf_node* shape_fit_entry() { return node_entry<ShapeFit>(); }

}  // namespace ballflow::nodes
