#include "prior/shape_mesh.hpp"

#include <ballflow/sdk.hpp>
#include <optional>
#include <string>
#include <vector>

#include "prior/eigen_version.hpp"
#include "prior/shape_fit.hpp"
#include "prior/shape_instance.hpp"
#include "types/artifact_types.hpp"
#include "types/shape_types.hpp"

namespace ballflow::nodes {
namespace {

struct ShapeMesh {
  In<geometry::ShapePrior> prior;
  In<geometry::ShapeFit> fit;
  Out<geometry::TriangleMesh> mesh;
  std::string modes;

  static void declare(NodeDecl<ShapeMesh>& d) {
    d.id("ShapeMesh", 1)
        .summary("The mesh of an instance or a fit of a model, with the template's triangles.");
    d.doc(
        "The surface of the shape that the model's template is made of, its vertices drawn along a smooth "
        "map "
        "(polyharmonic spline) from the mean's surface points to those of the instance. The triangles are "
        "the template's own, and so are genus and number of pieces: a thin blade stays in one piece where "
        "its balls do not touch. What such a mesh can do is fold, and that is looked for: the summary says "
        "how many triangles are turned inside out, how many pairs cross and how many of these the mean has "
        "already, the volume, and how far the vertices are from the union of the balls; a warning says it in "
        "words. Of a model without a mesh it makes an empty one, with a warning.");
    d.avoid_when(
        "a surface of the balls themselves is wanted, within a bound: BallMesh, which says so and whose "
        "pieces are those of the union.");
    d.cites("cootes1995", "shapes by their scores").cites("duchon1977", "the interpolant");
    d.library("Eigen", geometry::eigen_version());
    d.memory(std::uint64_t{32} << 20, 8);
    d.input("prior", &ShapeMesh::prior).doc("mean and modes, with a mesh of the mean");
    d.input("fit", &ShapeMesh::fit).optional().doc("whose scores and pose are taken; then no modes");
    d.output("mesh", &ShapeMesh::mesh)
        .doc("in the coordinates of the model, or of what was fitted; the triangles of the template");
    d.param("modes", &ShapeMesh::modes)
        .doc(
            "standard deviations of the first modes, 2,-1 or a JSON list; the others are 0; empty: the mean");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    std::vector<double> scores = geometry::parse_scores(modes);
    if (fit && !scores.empty())
      throw geometry::InputError("a fit is connected and modes are given",
                                 "leave modes empty: the fit has scores");
    std::optional<std::array<double, 12>> pose;
    geometry::Balls balls;
    if (fit) {
      if (fit->scores.size() > prior->mode_count() || fit->radii.size() != prior->balls())
        throw geometry::InputError("the fit is not one of this model", "connect the model that was fitted");
      scores.assign(fit->scores.begin(), fit->scores.end());
      pose = fit->pose;
      balls = geometry::balls_of(*fit);
    } else {
      balls = geometry::shape_instance(*prior, scores);
    }
    geometry::ShapeMesh made = geometry::shape_mesh(*prior, scores, pose, balls, monitor);
    const geometry::ShapeMeshCheck& check = made.check;
    mesh = std::move(made.mesh);
    mesh.summary("folded_triangles", check.folded);
    mesh.summary("self_intersections", check.intersections);
    mesh.summary("self_intersections_of_mean", check.of_mean);
    mesh.summary("volume", check.closed ? SummaryValue(check.volume) : SummaryValue(nullptr));
    mesh.summary("mean_distance_from_balls", check.mean_distance);
    mesh.summary("largest_distance_from_balls", check.largest_distance);
  }
};

}  // namespace

const bf_node* shape_mesh_entry() { return node_entry<ShapeMesh>(); }

}  // namespace ballflow::nodes
