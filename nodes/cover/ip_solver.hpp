// What IPSolve asks of an integer programming solver.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cover/residual.hpp"
#include "types/monitor.hpp"

namespace ballflow::geometry {

struct IpAnswer {
  bool proven = false;             // `rows` was proven to be a smallest cover
  std::vector<std::int32_t> rows;  // ascending; empty unless proven
  std::int64_t nodes = 0;          // nodes of the branch-and-bound tree that were visited
};

/// Equal problems get equal answers: no clock, no random numbers. Safe to call from several threads.
class IpSolver {
 public:
  virtual ~IpSolver() = default;

  /// A smallest set of rows such that every column contains one of them. `columns` are non-empty sets of
  /// numbers in [0, rows). Gives up, unproven, after `node_limit` nodes. Throws Cancelled.
  virtual IpAnswer solve(std::size_t rows, const Csr& columns, std::int64_t node_limit, Monitor& monitor) = 0;
};

/// lp_solve 5.5. Its library keeps state in static variables, so calls take turns.
std::unique_ptr<IpSolver> make_lp_solve();

/// Version of the lp_solve library: "5.5.2.5".
std::string lp_solve_version();

}  // namespace ballflow::geometry
