#include "prior/shape_instance.hpp"

#include <ballflow/sdk.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "types/artifact_types.hpp"
#include "types/shape_types.hpp"

namespace ballflow::nodes {
namespace {

struct ShapeInstance {
  In<geometry::ShapePrior> prior;
  Out<geometry::Balls> balls;
  Out<geometry::PointSet> points;
  std::string modes;

  static void declare(NodeDecl<ShapeInstance>& d) {
    d.id("ShapeInstance", 1).summary("An instance of a model of a shape, as balls and as surface points.");
    d.doc(
        "The mean plus so many standard deviations of each mode; radii by their logarithms, so that they "
        "stay "
        "positive. 0 is the mean, between -2 and 2 lie most instances; beyond 3 in a mode is an "
        "extrapolation, "
        "and a warning says so. Refuses more scores than modes.");
    d.avoid_when("the shape is to go through given points or balls: ShapeFit finds the scores.");
    d.cites("cootes1995", "a shape from its parameters");
    d.memory(1 << 20, 2);
    d.input("prior", &ShapeInstance::prior).doc("mean and modes");
    d.output("balls", &ShapeInstance::balls).doc("k balls, in the coordinates of the model");
    d.output("points", &ShapeInstance::points).doc("m points on the surface, without normals");
    d.param("modes", &ShapeInstance::modes)
        .doc(
            "standard deviations of the first modes, 2,-1 or a JSON list; the others are 0; empty: the mean");
  }
  void run(RunContext& context) {
    const std::vector<double> scores = geometry::parse_scores(modes);
    balls = geometry::shape_instance(*prior, scores);
    points = geometry::instance_points(*prior, scores);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      if (std::abs(scores[i]) > 3) {
        context.warn("mode " + std::to_string(i) + " is " + std::to_string(scores[i]) +
                     " standard deviations from the mean: no instance of the model is like that");
      }
    }
  }
};

}  // namespace

const bf_node* shape_instance_entry() { return node_entry<ShapeInstance>(); }

}  // namespace ballflow::nodes
