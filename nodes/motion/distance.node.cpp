#include "motion/distance.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"
#include "types/motion_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::DistanceOptions;

struct Distance {
  In<geometry::Balls> a, b;
  In<geometry::Enclosure> a_enclosure, b_enclosure;
  Out<geometry::BallDistance> distance;
  DistanceOptions options;

  static void declare(NodeDecl<Distance>& d) {
    d.id("Distance", 1).summary("How far two unions of balls are apart, or how deep they overlap.");
    d.doc(
        "The separation of two balls is |c - c'| - r - r': how far they are apart, or the negative of their "
        "depth. The smallest one of all pairs is, where it is not negative, the distance of the unions; "
        "where "
        "it is negative, the depth of the deepest pair, and not the translational penetration depth of the "
        "unions: no shorter translation parts them, but the shortest that does may be longer. With it come "
        "the "
        "two balls, a point on each, the pairs below a threshold, and on request the clearance of every "
        "ball. "
        "Which pairs these are is decided exactly for the doubles given; of equal ones the lowest indices "
        "come "
        "first. With the enclosures of both sides it also says between what bounds the distance of the "
        "solids "
        "is proven to be. Accepts any balls: equal, nested, concentric, of radius 0. Refuses empty sets, and "
        "coordinates and radii beyond 1e140.");
    d.avoid_when(
        "the translation that parts two overlapping unions is wanted: it ends on the boundary of their "
        "configuration space (graphs/configuration_space.json).");
    d.cites("quinlan1994", "distances by trees of balls, branch and bound");
    d.memory(64 << 20, 16);
    d.input("a", &Distance::a).doc("n balls, model units");
    d.input("b", &Distance::b).doc("m balls, in the same place and unit");
    d.input("a_enclosure", &Distance::a_enclosure)
        .optional()
        .doc(
            "whether the balls of a contain a solid, and how far they stand out of it; without it they are "
            "the solid");
    d.input("b_enclosure", &Distance::b_enclosure).optional().doc("the same of b");
    d.output("distance", &Distance::distance).doc("smallest separation, witnesses, near pairs, clearances");
    d.param("threshold", &Distance::options, &DistanceOptions::threshold)
        .unit("model units")
        .at_least(-1e15)
        .at_most(1e15)
        .doc("pairs with at most this separation are listed; 0: those that touch or overlap");
    d.param("most_pairs", &Distance::options, &DistanceOptions::most_pairs)
        .unit("pairs")
        .at_least(0)
        .at_most(1000000)
        .doc("no more pairs are listed: those with the smallest separations; 0: none");
    d.param("every_ball", &Distance::options, &DistanceOptions::every_ball)
        .doc("also find, for every ball of a and of b, how far the other set is");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    distance = geometry::ball_distance(
        *a, *b, options, monitor,
        {.a = a_enclosure ? &*a_enclosure : nullptr, .b = b_enclosure ? &*b_enclosure : nullptr});
  }
};

}  // namespace

const bf_node* distance_entry() { return node_entry<Distance>(); }

}  // namespace ballflow::nodes
