#include "cover/lagrangian_bound.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct LagrangianBound {
  In<CoverState> cover;
  Out<CoverState> bounded;
  LagrangianBoundOptions options;

  static void declare(NodeDecl<LagrangianBound>& d) {
    d.id("LagrangianBound", 2).summary("Prove how many balls any cover needs, with a certificate.");
    d.doc(
        "Climbs the Lagrangian relaxation of every connected component by subgradients with momentum; the "
        "multipliers become integer prices of samples that anybody can check on the original balls. Ends "
        "near "
        "the bound of linear programming. Chooses nothing.");
    d.avoid_when("the matrix was not reduced: every iteration looks at all its entries.");
    d.cites("kornberger2010", "3.6.4");
    d.cites("caprara1999", "the relaxation of set covering and its multipliers");
    d.input("cover", &LagrangianBound::cover)
        .doc("any state of a set covering computation, best after Reduce");
    d.output("cover", &LagrangianBound::bounded)
        .doc("the same state with a lower bound and its certificate, where they are better");
    d.param("iterations", &LagrangianBound::options, &LagrangianBoundOptions::iterations)
        .unit("iterations")
        .at_least(0)
        .doc("at most, for each component; 0 only spreads the prices of the share bound");
    d.param("momentum", &LagrangianBound::options, &LagrangianBoundOptions::momentum)
        .unit("fraction")
        .at_least(0)
        .at_most(0.999)
        .doc("how much of a direction stays in the next one; 0 is the plain subgradient, which stalls");
    d.param("patience", &LagrangianBound::options, &LagrangianBoundOptions::patience)
        .unit("iterations")
        .at_least(1)
        .doc("iterations without a better bound before the step gets shorter");
    d.param("shrink", &LagrangianBound::options, &LagrangianBoundOptions::shrink)
        .unit("factor")
        .at_least(0.01)
        .at_most(0.99)
        .doc("how much shorter; near 1 more iterations are used");
    d.memory(1 << 20, 3.5);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    bounded = lagrangian_bound(*cover, options, monitor);
  }
};

}  // namespace

const bf_node* lagrangian_bound_entry() { return node_entry<LagrangianBound>(); }

}  // namespace ballflow::nodes
