#include "cover/share_bound.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct ShareBound {
  In<CoverState> cover;
  Out<CoverState> bounded;

  static void declare(NodeDecl<ShareBound>& d) {
    d.id("ShareBound", 1).summary("Bound any cover from below by the shares of the samples that are left.");
    d.doc(
        "A sample contributes 1 / (samples of the largest ball that contains it), rounded up component by "
        "component. Chooses nothing. Place it after the reductions and before the first greedy pick.");
    d.avoid_when("the bound should be good: LagrangianBound is far better and takes seconds.");
    d.cites("kornberger2010", "3.6.4 and Theorem 3.8");
    d.input("cover", &ShareBound::cover).doc("any state of a set covering computation, best after Reduce");
    d.output("cover", &ShareBound::bounded)
        .doc("the same state with a lower bound and its certificate, where they are better");
    d.memory(1 << 20, 1.5);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    bounded = share_bound(*cover, monitor);
  }
};

}  // namespace

const bf_node* share_bound_entry() { return node_entry<ShareBound>(); }

}  // namespace ballflow::nodes
