// Exact solution of the small independent parts of a covering matrix (Kornberger 2010, 3.6.2).
#pragma once

#include <cstdint>

#include "cover/ip_solver.hpp"
#include "types/cover_state.hpp"
#include "types/monitor.hpp"

namespace ballflow::geometry {

struct IpSolveOptions {
  std::int64_t max_balls = 60;       // components of more rows are left alone; 0 leaves all
  std::int64_t node_limit = 10'000;  // branch-and-bound nodes per component
};

/// Solves every connected component of at most `max_balls` rows by integer programming (3.5) and takes it
/// out of the matrix; its balls are marked Choice::exact, components by their first sample, balls ascending.
///
/// - A component one row covers needs no solver: the row of lowest index is chosen.
/// - Every answer is checked against the matrix; a wrong one is an InputError that names the component.
/// - A component that was not solved within `node_limit` nodes stays in the matrix.
/// - Rows that cover nothing are dropped when anything was solved. Raises the lower bound.
CoverState ip_solve(const CoverState& state, IpSolver& solver, const IpSolveOptions& options = {},
                    Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
