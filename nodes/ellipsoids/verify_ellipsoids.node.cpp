#include "ellipsoids/verify_ellipsoids.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct VerifyEllipsoids {
  In<Ellipsoids> ellipsoids;
  In<PointSet> points;
  In<TriangleMesh> patches;
  In<CoverState> cover;
  In<Ellipsoids> candidates;
  Out<CoverCheck> check;

  static void declare(NodeDecl<VerifyEllipsoids>& d) {
    d.id("VerifyEllipsoids", 1)
        .summary(
            "Check from geometry that every sample lies in an ellipsoid, and that no cover has fewer than "
            "proved.");
    d.doc(
        "What VerifyCover is for balls. It uses nothing of the matrix but the definition of its entries. "
        "With the "
        "cover and the ellipsoids of its matrix it also checks the certificate of the lower bound, and that "
        "what "
        "the cover lists as uncovered has no candidate; that is no error. Refuses a sample in no ellipsoid, "
        "and a "
        "certificate that proves nothing.");
    d.avoid_when("the error between samples is asked: that is CompareEllipsoids.");
    d.cites("kornberger2010", "3.6.1 and 6.4");
    d.memory(1 << 20, 2.0);
    d.input("ellipsoids", &VerifyEllipsoids::ellipsoids).doc("the selected ones");
    d.input("points", &VerifyEllipsoids::points).doc("samples that should be covered");
    d.input("patches", &VerifyEllipsoids::patches)
        .optional()
        .doc("triangles that should be, in place of the points, where there are any");
    d.input("cover", &VerifyEllipsoids::cover).optional().doc("how they were chosen, with the certificate");
    d.input("candidates", &VerifyEllipsoids::candidates)
        .optional()
        .doc("among which they were chosen; goes with cover");
    d.output("check", &VerifyEllipsoids::check)
        .doc("the samples in no ellipsoid, and the bound that the certificate proves");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (static_cast<bool>(cover) != static_cast<bool>(candidates)) {
      throw InputError("only one of cover and candidates is connected",
                       "connect both to check a certificate, or none");
    }
    check = verify_ellipsoids(*ellipsoids, *points, patches ? *patches : TriangleMesh(),
                              cover ? &*cover : nullptr, candidates ? &*candidates : nullptr, monitor);
  }
};

}  // namespace

const bf_node* verify_ellipsoids_entry() { return node_entry<VerifyEllipsoids>(); }

}  // namespace ballflow::nodes
