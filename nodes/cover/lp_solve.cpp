#include <lp_lib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "base/index.hpp"
#include "cover/ip_solver.hpp"

namespace ballflow::geometry {
namespace {

/// What the abort function sees of the call it may end.
struct Watch {
  std::int64_t node_limit;
  Monitor& monitor;
  bool over_limit = false;
  bool cancelled = false;
};

int __WINAPI should_stop(lprec* problem, void* handle) {
  auto& watch = *static_cast<Watch*>(handle);
  watch.over_limit = watch.over_limit || get_total_nodes(problem) > watch.node_limit;
  watch.cancelled = watch.cancelled || watch.monitor.cancelled();
  return watch.over_limit || watch.cancelled ? TRUE : FALSE;
}

class LpSolve final : public IpSolver {
 public:
  IpAnswer solve(const IpProblem& ip, Monitor& monitor) override {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);

    const auto count = index_of(ip.rows, "balls for lp_solve");
    const std::unique_ptr<lprec, void (*)(lprec*)> problem(make_lp(0, count), delete_lp);
    if (!problem) throw std::bad_alloc();
    lprec* lp = problem.get();
    set_verbose(lp, NEUTRAL);
    set_minim(lp);
    std::vector<REAL> ones(ip.rows + 1, 1.0);
    if (set_obj_fn(lp, ones.data()) == FALSE) throw std::bad_alloc();
    set_add_rowmode(lp, TRUE);
    std::vector<int> variables;
    for (std::size_t c = 0; c < ip.columns.size(); ++c) {
      variables.clear();
      for (const std::int32_t i : ip.columns[c]) variables.push_back(i + 1);
      if (add_constraintex(lp, static_cast<int>(variables.size()), ones.data(), variables.data(), GE, 1) ==
          FALSE) {
        throw std::bad_alloc();
      }
    }
    set_add_rowmode(lp, FALSE);
    for (int i = 1; i <= count; ++i) set_upbo(lp, i, 1);
    set_timeout(lp, 0);  // no limit: a clock would make the answer depend on the machine's load
    set_anti_degen(lp, ANTIDEGEN_NONE);  // its perturbations come from a generator seeded by the clock
    Watch watch{ip.node_limit, monitor};
    put_abortfunc(lp, should_stop, &watch);

    IpAnswer answer;
    set_presolve(lp, PRESOLVE_SENSDUALS, 0);
    const int relaxed = ::solve(lp);
    if (watch.cancelled) throw Cancelled();
    REAL* values = nullptr;
    if (relaxed == OPTIMAL && get_ptr_dual_solution(lp, &values) != FALSE) {
      answer.duals.assign(values + 1, values + 1 + ip.columns.size());
    }

    set_presolve(lp, PRESOLVE_NONE, 0);
    default_basis(lp);
    for (int i = 1; i <= count; ++i) set_binary(lp, i, TRUE);
    set_bb_floorfirst(lp, BRANCH_CEILING);
    // One more constraint instead of a bound on the objective: the library forgets such bounds.
    const bool bounded = ip.upper_bound <= static_cast<std::int64_t>(ip.rows);
    if (bounded) {
      std::vector<int> all;
      for (int i = 1; i <= count; ++i) all.push_back(i);
      if (add_constraintex(lp, count, ones.data(), all.data(), LE, static_cast<REAL>(ip.upper_bound - 1)) ==
          FALSE) {
        throw std::bad_alloc();
      }
    }
    const int status = ::solve(lp);
    if (watch.cancelled) throw Cancelled();
    answer.nodes = get_total_nodes(lp);
    if (watch.over_limit) return answer;
    if (status == INFEASIBLE && bounded) {
      answer.finished = true;
      answer.lower_bound = ip.upper_bound;
    }
    if (status != OPTIMAL || get_ptr_variables(lp, &values) == FALSE) return answer;
    for (int i = 0; i < count; ++i) {
      if (values[i] > 0.5) answer.rows.push_back(i);
    }
    answer.finished = true;
    answer.lower_bound = static_cast<std::int64_t>(answer.rows.size());
    return answer;
  }
};

}  // namespace

std::unique_ptr<IpSolver> make_lp_solve() { return std::make_unique<LpSolve>(); }

std::string lp_solve_version() {
  int major = 0, minor = 0, release = 0, build = 0;
  ::lp_solve_version(&major, &minor, &release, &build);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release) + "." +
         std::to_string(build);
}

}  // namespace ballflow::geometry
