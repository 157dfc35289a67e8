#include "prior/shape_prior.hpp"

#include <ballflow/sdk.hpp>
#include <utility>
#include <vector>

#include "prior/eigen_version.hpp"
#include "prior/shape_mesh.hpp"
#include "types/artifact_types.hpp"
#include "types/prior_types.hpp"
#include "types/shape_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::ShapePriorOptions;

struct ShapePrior {
  InList<geometry::MatchedBalls> instances;
  InList<geometry::TriangleMesh> meshes;
  In<geometry::TriangleMesh> surface;
  In<geometry::PointSet> surface_points;
  Out<geometry::ShapePrior> prior;
  ShapePriorOptions options;

  static void declare(NodeDecl<ShapePrior>& d) {
    d.id("ShapePrior", 2)
        .summary(
            "Learns how a shape varies from several instances of it: mean, modes, and how good they are.");
    d.doc(
        "Superimposes all instances on their mean (generalized Procrustes analysis, no instance is "
        "privileged) and takes the principal components of balls and surface points. The metric is a mean "
        "squared displacement: of a point that off the surface and a part of that along it, of a ball dx^2 + "
        "dy^2 + dz^2 + (w d log r)^2, where w is the mean radius, so that a radius counts as the length by "
        "which it changes. The model lies in the coordinates of the "
        "instance that is most like the mean. Generalization leaves one instance out after the other, "
        "specificity draws random shapes; both with their standard deviations. The order of the instances "
        "changes the order of the scores only. Refuses one instance, instances without any difference, and "
        "such as were matched to different templates; warns of equal ones, of mirror images, and of one that "
        "is far from all others.");
    d.avoid_when(
        "there are two or three instances, which have one or two modes: enough to try, not to know how a "
        "shape varies; and for shapes that bend at joints, which no linear modes describe.");
    d.cites("kornberger2010", "6.3.1").cites("cootes1995", "point distribution models");
    d.cites("gower1975", "superposition on the mean").cites("davies2002", "generalization and specificity");
    d.library("Eigen", geometry::eigen_version());
    d.memory(std::uint64_t{16} << 20, 8);
    d.input("instances", &ShapePrior::instances)
        .doc("matched to one template, as many balls and points each");
    d.input("meshes", &ShapePrior::meshes)
        .optional()
        .doc(
            "surfaces of the instances in their order, for distances of the evaluation; else these are "
            "measured to tangent planes");
    d.input("surface", &ShapePrior::surface)
        .optional()
        .doc(
            "the template's own: it goes with the model, so that instances have meshes with its triangles; "
            "see ShapeMesh");
    d.input("surface_points", &ShapePrior::surface_points)
        .optional()
        .doc("the template's, which all instances were matched with: they tell where its surface goes");
    d.output("prior", &ShapePrior::prior).doc("mean, modes, scores of the instances, evaluation");
    d.choice("balls", &ShapePrior::options, &ShapePriorOptions::balls,
             {{geometry::ModelBalls::carried, "carried",
               "as the match carried them: smooth in what differs between instances, but some may stand out "
               "of thin "
               "parts"},
              {geometry::ModelBalls::replaced, "replaced",
               "the instances' own balls: inside, with the noise of which ball was near"}})
        .doc("which balls of the matches the model is made of");
    d.param("scale", &ShapePrior::options, &ShapePriorOptions::scale)
        .doc("scale the instances to one size: the model then says how shapes vary, and nothing of size");
    d.param("radius_weight", &ShapePrior::options, &ShapePriorOptions::radius_weight)
        .unit("mean radii")
        .at_least(0)
        .at_most(100)
        .doc("how much logarithms of radii count; 0: modes that live in radii alone are lost");
    d.param("point_share", &ShapePrior::options, &ShapePriorOptions::point_share)
        .unit("1")
        .at_least(0)
        .at_most(1)
        .doc(
            "weight of the surface points, the rest is that of the balls. 1: the surface decides and balls "
            "follow, right where they are replaced ones with their noise; 0: balls decide");
    d.param("along", &ShapePrior::options, &ShapePriorOptions::along)
        .unit("1")
        .at_least(0)
        .at_most(1)
        .doc(
            "weight of what moves points along the surface, against what moves them off it: where flat faces "
            "are matched, points slide without a change of shape");
    d.param("modes", &ShapePrior::options, &ShapePriorOptions::modes)
        .unit("modes")
        .at_least(0)
        .at_most(10000)
        .doc("at most; 0: all, one less than instances");
    d.param("draws", &ShapePrior::options, &ShapePriorOptions::draws)
        .unit("shapes")
        .at_least(0)
        .at_most(100000)
        .doc("random shapes for the specificity; 0: no evaluation at all");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const std::vector<geometry::MatchedBalls> all(instances.begin(), instances.end());
    const std::vector<geometry::TriangleMesh> surfaces(meshes.begin(), meshes.end());
    if (static_cast<bool>(surface) != static_cast<bool>(surface_points))
      throw geometry::InputError(surface ? "the template's surface is connected without its points"
                                         : "the template's points are connected without its surface",
                                 "connect both, or none of them");
    geometry::PartMonitor learning(monitor, 0, surface ? 0.9 : 1), carrying(monitor, 0.9, 1);
    geometry::ShapePrior learned = geometry::shape_prior(all, surfaces, options, learning);
    if (surface) {
      geometry::TriangleMesh mean = geometry::mesh_of_mean(learned, *surface, *surface_points, carrying);
      learned.vertices = std::move(mean.vertices);
      learned.triangles = std::move(mean.triangles);
    }
    prior = std::move(learned);
  }
};

}  // namespace

const bf_node* shape_prior_entry() { return node_entry<ShapePrior>(); }

}  // namespace ballflow::nodes
