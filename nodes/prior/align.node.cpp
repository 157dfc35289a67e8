#include "prior/align.hpp"

#include <ballflow/sdk.hpp>

#include "prior/eigen_version.hpp"
#include "types/artifact_types.hpp"
#include "types/prior_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AlignOptions;
using geometry::Extent;
using geometry::Reflections;

struct Align {
  In<geometry::PointSet> points, target;
  Out<geometry::ShapePose> pose;
  AlignOptions options;

  static void declare(NodeDecl<Align>& d) {
    d.id("Align", 1).summary("Where a shape lies on another one of its kind, from samples without labels.");
    d.doc(
        "Principal axes of both, with all sign choices (and permutations where their lengths are nearly "
        "equal), "
        "then iterated closest points both ways; of all optima the one with the smallest residual, and how "
        "much "
        "worse the second best is. Warns where another pose fits nearly as well, and where the shape is not "
        "like "
        "the target. Refuses fewer than 4 samples, samples in one plane, and shapes that fit clearly better "
        "mirrored.");
    d.avoid_when(
        "points correspond already (Match refines its own pose), or shapes are turned by a symmetry of "
        "theirs: "
        "no alignment can tell.");
    d.cites("besl1992", "iterated closest points")
        .cites("chetverikov2002", "trimmed")
        .cites("horn1987", "the transform of labelled pairs");
    d.library("Eigen", geometry::eigen_version());
    d.memory(16 << 20, 8);
    d.input("points", &Align::points).doc("n samples of the surface that is to be moved, all over it");
    d.input("target", &Align::target).doc("samples of the surface that it is laid on");
    d.output("pose", &Align::pose)
        .doc("from the coordinates of points to those of target, residuals, second best");
    d.param("similarity", &Align::options, &AlignOptions::similarity)
        .doc("the scale is free, too; else rotation and translation only");
    d.choice("reflections", &Align::options, &AlignOptions::reflections,
             {{Reflections::refuse, "refuse", "a shape that fits clearly better mirrored is an error"},
              {Reflections::allow, "allow", "it is mirrored, left ones among right ones say"}})
        .doc("what becomes of mirror images");
    d.choice(
         "extent", &Align::options, &AlignOptions::extent,
         {{Extent::whole, "whole", "both are whole shapes"},
          {Extent::part, "part", "points are of a part of the target: nothing is asked of what it lacks"}})
        .doc("what is moved");
    d.param("keep", &Align::options, &AlignOptions::keep)
        .unit("share of pairs")
        .at_least(0.3)
        .at_most(1)
        .doc(
            "the nearest pairs that transforms are fitted to; below 1 what only one shape has does not pull, "
            "nor "
            "does a small feature that tells one end from the other");
    d.param("sure", &Align::options, &AlignOptions::sure)
        .unit("ratio of residuals")
        .at_least(1)
        .at_most(100)
        .doc("second best by best, below which the pose is called ambiguous, and a mirror image is none");
    d.param("alike", &Align::options, &AlignOptions::alike)
        .unit("share of the diagonal")
        .at_least(0)
        .at_most(10)
        .doc(
            "relative residual above which the shape is called another kind than the target; of a part, half "
            "of it");
    d.param("points", &Align::options, &AlignOptions::points)
        .unit("points")
        .at_least(50)
        .at_most(100000)
        .doc("of each shape; more are thinned evenly");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    pose = geometry::align(*points, *target, options, monitor);
  }
};

}  // namespace

const bf_node* align_entry() { return node_entry<Align>(); }

}  // namespace ballflow::nodes
