#include "power/minimal_union.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::MinimalUnionOptions;
using geometry::UnionOf;

struct MinimalUnion {
  In<geometry::Balls> balls;
  Out<geometry::Balls> kept;
  MinimalUnionOptions options;

  static void declare(NodeDecl<MinimalUnion>& d) {
    d.id("MinimalUnion", 1)
        .summary("Drops balls that others cover: the union stays, and none of the rest can go.");
    d.doc(
        "An inclusion-minimal part of the balls with the same union, decided exactly for the doubles given. "
        "First "
        "go the balls that do not contribute: no point of theirs has a strictly smaller power to them than "
        "to all "
        "others (thesis, 5.1). What contributes may still be covered by several others together: the "
        "contributing "
        "balls are asked one by one, smallest radius first, of equal ones by x, y, z of the center, and each "
        "goes "
        "when those still there cover it. So the result depends on the set of balls alone. It is smallest in "
        "the "
        "sense that nothing can be dropped; another part may have fewer balls. The summary has the counts "
        "beside each other: contributing, minimal, and touching_boundary, which have a piece of their sphere "
        "on the "
        "boundary of the union and do not represent it alone. Accepts any balls: none, one, equal, nested, "
        "tangent, "
        "flat sets, radius 0. Refuses coordinates and radii that are not 0 and outside [1e-150, 1e150].");
    d.avoid_when(
        "the union may change a little: Enlarge, CoverMatrix and a strategy need far fewer balls. What "
        "covers "
        "samples rather than the union is pruned there too.");
    d.cites("kornberger2010", "5.1").cites("aurenhammer1988", "Lemma 1").cites("seidel1991", "2");
    d.library("CGAL", geometry::cgal_version());
    // Two triangulations, one after the other, of 700 bytes a ball.
    d.memory(std::uint64_t{16} << 20, 45);
    d.input("balls", &MinimalUnion::balls).doc("balls, model units");
    d.output("balls", &MinimalUnion::kept)
        .doc("those that are needed, in the order they had, with their defining samples");
    d.choice("of", &MinimalUnion::options, &MinimalUnionOptions::of,
             {{UnionOf::balls, "balls", "the union in space"},
              {UnionOf::discs, "discs", "the union in the plane, of balls with z = 0"}})
        .doc("what the union is of; a disc may be covered where the ball is not");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const geometry::MinimalUnion found = geometry::minimal_union(*balls, options, monitor);
    kept.summary("given", static_cast<std::int64_t>(balls->size()));
    kept.summary("contributing", found.contributing);
    kept.summary("minimal", static_cast<std::int64_t>(found.kept.size()));
    kept.summary("touching_boundary", found.touching_boundary);
    kept = select(*balls, found.kept);
  }
};

}  // namespace

const bf_node* minimal_union_entry() { return node_entry<MinimalUnion>(); }

}  // namespace ballflow::nodes
