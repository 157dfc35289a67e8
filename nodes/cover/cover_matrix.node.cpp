#include "cover/cover_matrix.hpp"

#include <ballflow/sdk.hpp>

#include "cover/patch_matrix.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct CoverMatrixNode {
  In<Balls> balls;
  In<PointSet> points;
  In<TriangleMesh> patches;
  Out<CoverState> cover;
  Out<Balls> all_balls;
  CoverMatrixOptions options;

  static void declare(NodeDecl<CoverMatrixNode>& d) {
    d.id("CoverMatrix", 5).summary("Find out which ball covers which sample.");
    d.doc(
        "Entry (i, j) of the matrix is 1 iff sample j lies in ball i: |c - s|^2 <= r^2 (1 + 2^-30), or the "
        "sample "
        "defines the ball. A matrix of more than `full_entries` entries is not made: a lower bound with a "
        "certificate comes first, from few samples and all balls, and its prices tell which balls a good "
        "cover "
        "may be made of; these alone are rows, without those inside others, and columns that contain others "
        "are left out. Accepts any balls, also overlapping, equal or empty ones. "
        "Refuses coordinates "
        "beyond "
        "1e140 and defining samples that are not among the points.");
    d.avoid_when(
        "the balls cover each sample thousands of times: thin the sample or enlarge less, the matrix grows "
        "with the number of (ball, sample) pairs.");
    d.cites("kornberger2010", "3.6.1");
    d.input("balls", &CoverMatrixNode::balls).doc("candidate balls, the rows");
    d.input("points", &CoverMatrixNode::points).doc("samples to be covered, the columns");
    d.input("patches", &CoverMatrixNode::patches)
        .optional()
        .doc(
            "triangles of the points; where there are any, they are to be covered in place of the points, "
            "each "
            "by one ball that contains its corners");
    d.output("cover", &CoverMatrixNode::cover).doc("the matrix, nothing chosen yet");
    d.output("balls", &CoverMatrixNode::all_balls)
        .doc(
            "the balls of the rows: the input, then one ball of radius 0 per sample in no ball (uncovered = "
            "ball)");
    d.choice("uncovered", &CoverMatrixNode::options, &CoverMatrixOptions::uncovered,
             {{UncoveredPolicy::ball, "ball",
               "the sample gets a ball of radius 0, after all other balls: a component of its own"},
              {UncoveredPolicy::error, "error", "the node fails and names the sample"},
              {UncoveredPolicy::report, "report", "the sample is left out and listed in the result"}})
        .doc("what becomes of a sample that lies in no ball");
    d.param("full_entries", &CoverMatrixNode::options, &CoverMatrixOptions::full_entries)
        .unit("entries of 4 bytes")
        .at_least(0)
        .doc(
            "a larger matrix has candidates alone as rows, a few dozen million entries; what Reduce and "
            "solvers "
            "find out then proves nothing, the bound that comes with the matrix does");
    d.param("max_entries", &CoverMatrixNode::options, &CoverMatrixOptions::max_entries)
        .unit("entries of 4 bytes")
        .at_least(0)
        .not_hashed()
        .doc("a larger matrix is refused before it is made; 0 refuses every matrix with an entry");
    d.memory(16 << 20, 16.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    CoverMatrix result = patches && !patches->triangles.empty()
                             ? patch_matrix(*balls, *patches, options, monitor)
                             : cover_matrix(*balls, *points, options, monitor);
    cover = std::move(result.cover);
    all_balls = std::move(result.balls);
  }
};

}  // namespace

const bf_node* cover_matrix_entry() { return node_entry<CoverMatrixNode>(); }

}  // namespace ballflow::nodes
