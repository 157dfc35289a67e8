#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "minkowski/sum_of_solids.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::MinkowskiAlgorithm2;
using geometry::MinkowskiKeep;
using geometry::MinkowskiSum2Options;
using geometry::SumMode;

struct MinkowskiSum2 {
  In<geometry::Balls> a, b;
  In<geometry::OutlineComparison> a_comparison, b_comparison;
  In<geometry::Enclosure> a_enclosure, b_enclosure;
  Out<geometry::Balls> balls;
  Out<geometry::MinkowskiReport> report;
  MinkowskiSum2Options options;
  SumMode mode = SumMode::balanced;

  static void declare(NodeDecl<MinkowskiSum2>& d) {
    d.id("MinkowskiSum2", 4).summary("The Minkowski sum of two unions of discs: again a union of discs.");
    d.doc(
        "As MinkowskiSum, of balls with z = 0, and the same balls, from a triangulation of the plane: the "
        "sums "
        "of a disc of either set that have a point in the closed disc to which the power is strictly smaller "
        "than to all other sums, decided exactly. Every algorithm gives the same discs. The summary of "
        "`report` adds avoided, the pairs that the tree of algorithm hierarchical never looked at. Accepts "
        "any "
        "discs: none, one, equal, nested, on a line, radius 0. Refuses centers with another z, coordinates "
        "and "
        "radii that are not 0 and outside [1e-150, 1e150], and more sums than the memory holds.");
    d.avoid_when(
        "the sum of the polygons themselves is wanted: it is exact and quick with CGAL's minkowski_sum_2; "
        "discs "
        "pay off where shapes are discs already, or round.");
    d.cites("kornberger2010", "5.3 and 5.4").cites("aurenhammer1988", "Lemma 1").cites("seidel1991", "2");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{128} << 20, 1500);
    d.input("a", &MinkowskiSum2::a).doc("discs, model units: balls with z = 0");
    d.input("b", &MinkowskiSum2::b).doc("the same; one disc at the origin grows the other set by its radius");
    d.input("a_comparison", &MinkowskiSum2::a_comparison)
        .optional()
        .doc(
            "the polygon that a stands for, compared with a polygon inside the union of a: gives the error "
            "bound; "
            "without it a stands for itself");
    d.input("b_comparison", &MinkowskiSum2::b_comparison).optional().doc("the same of b");
    d.input("a_enclosure", &MinkowskiSum2::a_enclosure)
        .optional()
        .doc(
            "what VerifyEnclosure proved of a and the meshes of its polygon (PolygonMeshes): bounds both "
            "ways, "
            "and with mode inner or outer the proof that the sum is bounded from that side");
    d.input("b_enclosure", &MinkowskiSum2::b_enclosure).optional().doc("the same of b");
    d.output("balls", &MinkowskiSum2::balls)
        .doc("the sums that are kept, ascending by x, y of the center, z = 0");
    d.output("report", &MinkowskiSum2::report)
        .doc("numbers of pairs, of discs that contribute, are needed and visible; bounding box, error bound");
    d.choice(
         "algorithm", &MinkowskiSum2::options, &MinkowskiSum2Options::algorithm,
         {{MinkowskiAlgorithm2::filtered, "filtered",
           "streams the pairs through a grid of large sums and triangulates those inside none of them"},
          {MinkowskiAlgorithm2::quadratic, "quadratic", "triangulates all pairs: algo_sq of the thesis"},
          {MinkowskiAlgorithm2::hierarchical, "hierarchical",
           "passes by pairs below nodes of quadtrees whose discs around all contribute nothing: algo_h of "
           "the thesis, without inserting and removing them"}})
        .doc("how the sums are found; the discs are the same");
    d.choice("keep", &MinkowskiSum2::options, &MinkowskiSum2Options::keep,
             {{MinkowskiKeep::contributing, "contributing", "all sums that contribute"},
              {MinkowskiKeep::minimal, "minimal",
               "a part of them with the same union in the plane, of which no disc can go (see MinimalUnion); "
               "takes longer"}})
        .doc("which sums are kept; the union is the same");
    d.choice(
         "mode", &MinkowskiSum2::mode,
         {{SumMode::balanced, "balanced", "sums are rounded to nearest"},
          {SumMode::inner, "inner", "sums are rounded inwards: discs inside give a sum inside"},
          {SumMode::outer, "outer", "sums are rounded outwards: discs that enclose give a sum that does"}})
        .doc("which side of the sum of the polygons the discs of a and b are made for");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::MinkowskiSum2 sum = geometry::sum_of_polygons(
        *a, *b, mode,
        {.a = a_comparison ? &*a_comparison : nullptr, .b = b_comparison ? &*b_comparison : nullptr},
        {.a = a_enclosure ? &*a_enclosure : nullptr, .b = b_enclosure ? &*b_enclosure : nullptr}, options,
        monitor);
    balls = std::move(sum.balls);
    report.summary("avoided", sum.avoided);
    report = sum.report;
  }
};

}  // namespace

const bf_node* minkowski_sum_2_entry() { return node_entry<MinkowskiSum2>(); }

}  // namespace ballflow::nodes
