// Exact solution of the independent parts of a covering matrix (Kornberger 2010, 3.6.2).
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "cover/ip_solver.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Which library solves integer programs.
enum class IpLibrary : std::uint8_t { lp_solve, cbc };

struct IpSolveOptions {
  std::int64_t max_balls = 60;       // components of more rows are not given to the solver; 0 gives it none
  std::int64_t node_limit = 10'000;  // branch-and-bound nodes per component
};

/// Solves every connected component of at most `max_balls` rows by integer programming (3.5) and takes it
/// out of the matrix; its balls are marked Choice::exact, components by their first sample, balls ascending.
///
/// - A component one row covers needs no solver: the row of lowest index is chosen.
/// - A component that was not solved within `node_limit` nodes stays in the matrix, unless `known` is there.
/// - `known` is a cover of the same instance by balls that are rows of `state` or chosen in it. Then the
/// solver
///   looks for less than the known balls of each component; where it proves that there is nothing, they are
///   Choice::exact; where it cannot tell, the best cover of the two is taken: the known balls as they were
///   chosen, or a better one as Choice::trusted. Nothing remains. The better one of the two lower bounds
///   stays, and of the two certificates.
/// - Every answer is checked against the matrix, and against the bound that the dual prices of its linear
///   relaxation prove in integers; a wrong one is an InputError that names the component.
/// - The certificate gets these prices of the components that were solved: it may prove less than the
///   solver claims. The lower bound is raised by what the solver claims, on the ground BoundHow::solver,
///   unless it follows from better ones.
/// - Rows that cover nothing are dropped when anything was solved.
CoverState ip_solve(const CoverState& state, IpSolver& solver, const IpSolveOptions& options = {},
                    Monitor& monitor = no_monitor(), const CoverState* known = nullptr);

}  // namespace ballflow::geometry
