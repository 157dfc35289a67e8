#include "cover/ip_solve.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct IPSolve {
  struct Library {
    IpLibrary solver = IpLibrary::lp_solve;
  };

  In<CoverState> cover, known;
  Out<CoverState> solved;
  IpSolveOptions options;
  Library library;

  static void declare(NodeDecl<IPSolve>& d) {
    d.id("IPSolve", 3).summary("Solve independent parts of a covering matrix exactly.");
    d.doc(
        "Connected components of at most max_balls rows are solved by integer programming and removed. Every "
        "answer is checked against the matrix and against the bound that its dual prices prove. A component "
        "that needs more than node_limit nodes stays in the matrix; with a known cover nothing stays: its "
        "balls "
        "are taken where nothing better is found, and where nothing better exists they are exact.");
    d.avoid_when("the matrix was not reduced: its components are then large; run Reduce first.");
    d.cites("kornberger2010", "3.6.2");
    d.cites("lpsolve", "branch and bound").cites("forrest2005", "2");
    d.library("lp_solve", lp_solve_version()).library("CBC", cbc_version());
    d.library("Clp", clp_version()).library("Cgl", cgl_version());
    d.input("cover", &IPSolve::cover).doc("any state of a set covering computation, best after Reduce");
    d.input("known", &IPSolve::known)
        .optional()
        .doc("a whole cover computed from the same matrix: the solver looks for less");
    d.output("cover", &IPSolve::solved).doc("the same instance without the parts that were solved");
    d.choice(
         "solver", &IPSolve::library, &Library::solver,
         {{IpLibrary::lp_solve, "lp_solve", "branch and bound, as in the thesis: up to some hundred balls"},
          {IpLibrary::cbc, "cbc", "branch and cut: up to some thousand balls"}})
        .doc("the library that solves integer programs");
    d.param("max_balls", &IPSolve::options, &IpSolveOptions::max_balls)
        .unit("balls")
        .at_least(0)
        .at_most(2147483647)
        .doc(
            "components of more balls are not given to the solver; 0 gives it none. Time explodes beyond 150 "
            "with lp_solve, beyond 3000 with cbc");
    d.param("node_limit", &IPSolve::options, &IpSolveOptions::node_limit)
        .unit("branch-and-bound nodes")
        .at_least(0)
        .doc("effort per component before it is given up; 0 solves only what needs no branching");
    d.memory(64 << 20, 2.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const std::unique_ptr<IpSolver> solver = library.solver == IpLibrary::cbc ? make_cbc() : make_lp_solve();
    solved = ip_solve(*cover, *solver, options, monitor, known ? &*known : nullptr);
  }
};

}  // namespace

const bf_node* ip_solve_entry() { return node_entry<IPSolve>(); }

}  // namespace ballflow::nodes
