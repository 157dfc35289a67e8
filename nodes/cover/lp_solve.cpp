#include <lp_lib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

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
  IpAnswer solve(std::size_t rows, const Csr& columns, std::int64_t node_limit, Monitor& monitor) override {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);

    const auto count = static_cast<int>(rows);
    const std::unique_ptr<lprec, void (*)(lprec*)> problem(make_lp(0, count), delete_lp);
    if (!problem) throw std::bad_alloc();
    lprec* lp = problem.get();
    set_verbose(lp, NEUTRAL);
    set_minim(lp);
    std::vector<REAL> ones(rows + 1, 1.0);
    if (set_obj_fn(lp, ones.data()) == FALSE) throw std::bad_alloc();
    set_add_rowmode(lp, TRUE);
    std::vector<int> variables;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      variables.clear();
      for (const std::int32_t i : columns[c]) variables.push_back(i + 1);
      if (add_constraintex(lp, static_cast<int>(variables.size()), ones.data(), variables.data(), GE, 1) ==
          FALSE) {
        throw std::bad_alloc();
      }
    }
    set_add_rowmode(lp, FALSE);
    for (int i = 1; i <= count; ++i) set_binary(lp, i, TRUE);
    set_bb_floorfirst(lp, BRANCH_CEILING);
    set_timeout(lp, 0);  // no limit: a clock would make the answer depend on the machine's load
    set_anti_degen(lp, ANTIDEGEN_NONE);  // its perturbations come from a generator seeded by the clock
    Watch watch{node_limit, monitor};
    put_abortfunc(lp, should_stop, &watch);

    const int status = ::solve(lp);
    if (watch.cancelled) throw Cancelled();
    IpAnswer answer;
    answer.nodes = get_total_nodes(lp);
    if (status != OPTIMAL || watch.over_limit) return answer;
    REAL* values = nullptr;
    if (get_ptr_variables(lp, &values) == FALSE) return answer;
    for (int i = 0; i < count; ++i) {
      if (values[i] > 0.5) answer.rows.push_back(i);
    }
    answer.proven = true;
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
