#include "ellipsoids/ellipsoid_matrix.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct EllipsoidMatrix {
  In<Ellipsoids> ellipsoids;
  In<PointSet> points;
  In<TriangleMesh> patches;
  Out<CoverState> cover;
  EllipsoidMatrixOptions options;

  static void declare(NodeDecl<EllipsoidMatrix>& d) {
    d.id("EllipsoidMatrix", 1).summary("Find out which ellipsoid covers which sample.");
    d.doc(
        "What CoverMatrix is for balls: entry (i, j) is 1 iff sample j lies in ellipsoid i, up to 2^-30 of "
        "the "
        "squared half-axes. The result goes to every strategy of pruning; its balls are ellipsoids. Samples "
        "in no "
        "ellipsoid are listed and warned about. Accepts ellipsoids with any rotations; refuses half-axes "
        "below "
        "2^-32 of the coordinates.");
    d.avoid_when("the pieces are balls: CoverMatrix knows matrices that are too large to be made.");
    d.cites("kornberger2010", "3.6.1 and 6.4");
    d.memory(16 << 20, 16.0);
    d.input("ellipsoids", &EllipsoidMatrix::ellipsoids).doc("candidates, the rows");
    d.input("points", &EllipsoidMatrix::points).doc("samples to be covered, the columns");
    d.input("patches", &EllipsoidMatrix::patches)
        .optional()
        .doc(
            "triangles; where there are any they are covered in place of the points, each by one ellipsoid "
            "that contains its corners");
    d.output("cover", &EllipsoidMatrix::cover).doc("the matrix, nothing chosen yet");
    d.param("max_entries", &EllipsoidMatrix::options, &EllipsoidMatrixOptions::max_entries)
        .unit("entries of 4 bytes")
        .at_least(0)
        .not_hashed()
        .doc("a larger matrix is refused");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    cover = ellipsoid_matrix(*ellipsoids, *points, patches ? *patches : TriangleMesh(), options, monitor);
  }
};

}  // namespace

const bf_node* ellipsoid_matrix_entry() { return node_entry<EllipsoidMatrix>(); }

}  // namespace ballflow::nodes
