// What IPSolve asks of an integer programming solver.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

/// A smallest set of rows is looked for such that every column contains one of them.
struct IpProblem {
  std::size_t rows = 0;
  const Csr& columns;           // non-empty sets of numbers in [0, rows)
  std::int64_t upper_bound;     // only covers of fewer rows are of interest; rows + 1 for all
  std::int64_t node_limit = 0;  // the search gives up after so many branch-and-bound nodes
};

/// What a solver says. Nothing of it is believed before it was checked, as far as it can be.
struct IpAnswer {
  bool finished = false;  // the search ended: `rows` is a smallest cover, or none is below upper_bound
  // The smallest cover below upper_bound that was found, ascending, or nothing.
  std::vector<std::int32_t> rows = {};
  std::int64_t lower_bound = 0;    // no cover has fewer rows; at most upper_bound
  std::int64_t nodes = 0;          // nodes of the branch-and-bound tree that were visited
  std::vector<double> duals = {};  // optimal dual prices of the columns in the linear relaxation, or none
};

/// Equal problems get equal answers: no clock, no random numbers. Safe to call from several threads.
class IpSolver {
 public:
  virtual ~IpSolver() = default;

  /// Throws Cancelled within a second of the monitor's wish.
  virtual IpAnswer solve(const IpProblem& problem, Monitor& monitor) = 0;
};

/// lp_solve 5.5: good for small problems. Its library keeps state in static variables, so calls take turns.
std::unique_ptr<IpSolver> make_lp_solve();

/// COIN-OR branch and cut, one thread: for problems of some thousand rows.
std::unique_ptr<IpSolver> make_cbc();

/// Versions of the libraries that run, which need not be those of the headers: "5.5.2.5", "libCbc.so.3.10.8"
/// (its release 2.10.8 tells no other version), "1.17.6" and "libCgl.so.1.10.3".
std::string lp_solve_version();
std::string cbc_version();
std::string clp_version();
std::string cgl_version();

}  // namespace ballflow::geometry
