#include "cover/verify_cover.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct VerifyCover {
  In<Balls> balls;
  In<PointSet> points;
  Out<CoverCheck> check;
  VerifyCoverOptions options;

  static void declare(NodeDecl<VerifyCover>& d) {
    d.id("VerifyCover", 1).summary("Check from geometry that every sample lies in a ball.");
    d.doc(
        "Uses nothing of the covering matrix but the definition of its entries, so it also checks balls of "
        "other "
        "origin. Covering the samples is not covering the surface between them.");
    d.avoid_when("the error between samples is asked: it looks at the samples alone");
    d.cites("kornberger2010", "3.6.1");
    d.input("balls", &VerifyCover::balls).doc("the selected balls");
    d.input("points", &VerifyCover::points).doc("samples that should be covered");
    d.output("check", &VerifyCover::check).doc("the samples in no ball");
    d.choice("on_uncovered", &VerifyCover::options, &VerifyCoverOptions::on_uncovered,
             {{OnUncovered::error, "error", "the node fails and names the first sample"},
              {OnUncovered::report, "report", "the samples are listed in the result"}})
        .doc("what a sample in no ball means");
    d.memory(1 << 20, 1.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    check = verify_cover(*balls, *points, options, monitor);
  }
};

}  // namespace

const bf_node* verify_cover_entry() { return node_entry<VerifyCover>(); }

}  // namespace ballflow::nodes
