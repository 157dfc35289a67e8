#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "minkowski/sum_of_solids.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::MinkowskiAlgorithm;
using geometry::MinkowskiKeep;
using geometry::MinkowskiSumOptions;
using geometry::SumMode;

struct MinkowskiSum {
  In<geometry::Balls> a, b;
  In<geometry::Comparison> a_comparison, b_comparison;
  In<geometry::Enclosure> a_enclosure, b_enclosure;
  Out<geometry::Balls> balls;
  Out<geometry::MinkowskiReport> report;
  MinkowskiSumOptions options;
  SumMode mode = SumMode::balanced;

  static void declare(NodeDecl<MinkowskiSum>& d) {
    d.id("MinkowskiSum", 5).summary("The Minkowski sum of two unions of balls: again a union of balls.");
    d.doc(
        "The sums (c + c', r + r') of a ball of either set that contribute to the union of all: those with a "
        "point "
        "in the closed ball to which the power is strictly smaller than to all other sums, decided exactly. "
        "Their "
        "union is the Minkowski sum of the unions. Every algorithm gives the same balls, whichever set is a, "
        "in an "
        "order of their own. Accepts any balls: none, one (the sum is then an offset), equal, nested, flat "
        "sets, "
        "radius 0. Refuses coordinates and radii that are not 0 and outside [1e-150, 1e150], and more sums "
        "than the "
        "memory holds.");
    d.avoid_when(
        "an input is a thin sheet, which needs very many balls for a smooth surface, or both are convex "
        "polytopes: "
        "their sum is exact and quick elsewhere.");
    d.cites("kornberger2010", "5.1 to 5.3 and 5.5")
        .cites("aurenhammer1988", "Lemma 1")
        .cites("seidel1991", "2");
    d.library("CGAL", geometry::cgal_version());
    // 140 and 210 MB were measured for 4 and 18 million pairs, and each of up to 8 parts has a grid of 10 MB.
    d.memory(std::uint64_t{128} << 20, 1500);
    d.input("a", &MinkowskiSum::a).doc("balls, model units; few: prune them");
    d.input("b", &MinkowskiSum::b)
        .doc("balls, model units; one ball at the origin grows the other set by its radius");
    d.input("a_comparison", &MinkowskiSum::a_comparison)
        .optional()
        .doc(
            "a and the closed mesh of its solid, compared: gives the error bound; without it the solid is "
            "the "
            "union of a");
    d.input("b_comparison", &MinkowskiSum::b_comparison).optional().doc("the same of b");
    d.input("a_enclosure", &MinkowskiSum::a_enclosure)
        .optional()
        .doc(
            "what VerifyEnclosure proved of a and the mesh of its solid: gives bounds both ways, and with "
            "mode "
            "inner or outer the proof that the sum is bounded from that side");
    d.input("b_enclosure", &MinkowskiSum::b_enclosure).optional().doc("the same of b");
    d.output("balls", &MinkowskiSum::balls).doc("the sums that are kept, ascending by x, y, z of the center");
    d.output("report", &MinkowskiSum::report)
        .doc("numbers of pairs, of balls that contribute, are needed and visible; bounding box, error bound");
    d.choice(
         "algorithm", &MinkowskiSum::options, &MinkowskiSumOptions::algorithm,
         {{MinkowskiAlgorithm::filtered, "filtered",
           "streams the pairs through a grid of large sums and triangulates those inside none of them"},
          {MinkowskiAlgorithm::time, "time", "triangulates all pairs at once: algo_time of the thesis"},
          {MinkowskiAlgorithm::memory, "memory",
           "inserts a pair only when it contributes so far, and tests what is left again: algo_mem of the "
           "thesis; the least memory, and some ten times slower"},
          {MinkowskiAlgorithm::hierarchical, "hierarchical",
           "passes by pairs below nodes of octrees whose balls around all contribute nothing (thesis, "
           "5.3.2)"}})
        .doc("how the sums are found; the balls are the same");
    d.choice(
         "keep", &MinkowskiSum::options, &MinkowskiSumOptions::keep,
         {{MinkowskiKeep::contributing, "contributing", "all sums that contribute"},
          {MinkowskiKeep::minimal, "minimal",
           "a part of them with the same union, of which no ball can go (see MinimalUnion); takes longer"}})
        .doc("which sums are kept; the union is the same");
    d.choice(
         "mode", &MinkowskiSum::mode,
         {{SumMode::balanced, "balanced", "sums are rounded to nearest"},
          {SumMode::inner, "inner", "sums are rounded inwards: balls inside give a sum inside"},
          {SumMode::outer, "outer", "sums are rounded outwards: balls that enclose give a sum that does"}})
        .doc("which side of the sum of the solids the balls of a and b are made for");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::MinkowskiSum sum = geometry::sum_of_solids(
        *a, *b, mode,
        {.a = a_comparison ? &*a_comparison : nullptr, .b = b_comparison ? &*b_comparison : nullptr},
        {.a = a_enclosure ? &*a_enclosure : nullptr, .b = b_enclosure ? &*b_enclosure : nullptr}, options,
        monitor);
    balls = std::move(sum.balls);
    report = sum.report;
  }
};

}  // namespace

const bf_node* minkowski_sum_entry() { return node_entry<MinkowskiSum>(); }

}  // namespace ballflow::nodes
