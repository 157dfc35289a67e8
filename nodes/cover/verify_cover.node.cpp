#include "cover/verify_cover.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct VerifyCover {
  In<Balls> balls;
  In<PointSet> points;
  In<CoverState> cover;
  In<Balls> candidates;
  In<TriangleMesh> patches;
  Out<CoverCheck> check;
  VerifyCoverOptions options;

  static void declare(NodeDecl<VerifyCover>& d) {
    d.id("VerifyCover", 3)
        .summary(
            "Check from geometry that every sample lies in a ball, and that no cover has fewer than proved.");
    d.doc(
        "Uses nothing of the covering matrix but the definition of its entries, so it also checks balls of "
        "other "
        "origin. With the cover and the balls of its covering matrix it also checks the certificate of the "
        "lower "
        "bound: no ball may contain samples that cost more than 1 or belong to two groups, and every sample "
        "that has a price must lie in a ball. A certificate that breaks this is refused. Covering the "
        "samples is not covering the surface between them. Samples that the cover lists because no candidate "
        "contains them are checked to be so, listed, and no error.");
    d.avoid_when("the error between samples is asked: it looks at the samples alone");
    d.cites("kornberger2010", "3.6.1");
    d.input("balls", &VerifyCover::balls).doc("the selected balls");
    d.input("points", &VerifyCover::points).doc("samples that should be covered");
    d.input("cover", &VerifyCover::cover)
        .optional()
        .doc("how they were chosen, with the certificate to be checked");
    d.input("candidates", &VerifyCover::candidates)
        .optional()
        .doc("the balls of the covering matrix, among which they were chosen; goes with cover");
    d.input("patches", &VerifyCover::patches)
        .optional()
        .doc("triangles of the points; where there are any, they should be covered in place of the points");
    d.output("check", &VerifyCover::check)
        .doc("the samples in no ball, and the bound that the certificate proves");
    d.choice("on_uncovered", &VerifyCover::options, &VerifyCoverOptions::on_uncovered,
             {{OnUncovered::error, "error", "the node fails and names the first sample"},
              {OnUncovered::report, "report", "the samples are listed in the result"}})
        .doc("what a sample in no ball means");
    d.memory(1 << 20, 1.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (static_cast<bool>(cover) != static_cast<bool>(candidates)) {
      throw InputError("only one of cover and candidates is connected",
                       "connect both to check a certificate, or none");
    }
    const TriangleMesh triangles = patches ? *patches : TriangleMesh{};
    CoverCheck result;
    if (!cover) {
      result = verify_cover(*balls, *points, options, monitor, {}, triangles);
    } else {
      verify_uncovered(*cover, *candidates, *points, monitor, triangles);
      result = verify_cover(*balls, *points, options, monitor, cover->uncovered.span(), triangles);
      result.certified_bound = verify_certificate(*cover, *candidates, *points, monitor, triangles);
    }
    check = std::move(result);
  }
};

}  // namespace

const bf_node* verify_cover_entry() { return node_entry<VerifyCover>(); }

}  // namespace ballflow::nodes
