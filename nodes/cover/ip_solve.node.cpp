#include "cover/ip_solve.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct IPSolve {
  In<CoverState> cover;
  Out<CoverState> solved;
  IpSolveOptions options;

  static void declare(NodeDecl<IPSolve>& d) {
    d.id("IPSolve", 1).summary("Solve the small independent parts of a covering matrix exactly.");
    d.doc(
        "Connected components of at most max_balls rows are solved by integer programming (lp_solve) and "
        "removed; "
        "every answer is checked against the matrix. A component that needs more than node_limit nodes "
        "stays.");
    d.avoid_when("the matrix was not reduced: its components are then large; run Reduce first.");
    d.cites("kornberger2010", "3.6.2");
    d.cites("lpsolve", "branch and bound");
    d.library("lp_solve", lp_solve_version());
    d.input("cover", &IPSolve::cover).doc("any state of a set covering computation, best after Reduce");
    d.output("cover", &IPSolve::solved).doc("the same instance without the parts that were solved");
    d.param("max_balls", &IPSolve::options, &IpSolveOptions::max_balls)
        .unit("balls")
        .at_least(0)
        .at_most(1000)
        .doc("components of more balls are left alone; 0 leaves all, beyond 150 the time explodes");
    d.param("node_limit", &IPSolve::options, &IpSolveOptions::node_limit)
        .unit("branch-and-bound nodes")
        .at_least(0)
        .doc("effort per component before it is given up; 0 solves only what needs no branching");
    d.memory(64 << 20, 2.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    solved = ip_solve(*cover, *make_lp_solve(), options, monitor);
  }
};

}  // namespace

const bf_node* ip_solve_entry() { return node_entry<IPSolve>(); }

}  // namespace ballflow::nodes
