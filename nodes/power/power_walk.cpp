#include "power/power_walk.hpp"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Ball {
  Vec3 center;
  double weight;
};

template <class T>
T squared_distance(Vec3 p, Vec3 q) {
  const T x = T(p.x) - T(q.x), y = T(p.y) - T(q.y), z = T(p.z) - T(q.z);
  return x * x + y * y + z * z;
}

/// Power of x to a ball.
template <class T>
T power(Vec3 x, const Ball& ball) {
  return squared_distance<T>(x, ball.center) - T(ball.weight);
}

/// Power of x to b minus power of x to a.
template <class T>
T difference(Vec3 x, const Ball& a, const Ball& b) {
  return power<T>(x, b) - power<T>(x, a);
}

/// The sign of expression<T>(), from intervals where they tell.
template <class Expression>
int sign_of(const Expression& expression) {
  {
    using Interval = CGAL::Interval_nt<false>;
    const CGAL::Protect_FPU_rounding<true> upward;
    const Interval value = expression(Interval());
    if (value.inf() > 0) return 1;
    if (value.sup() < 0) return -1;
    if (value.inf() == 0 && value.sup() == 0) return 0;
  }
  const CGAL::Gmpq value = expression(CGAL::Gmpq());
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// difference<double>() and a bound of its error: seven roundings, relative to the sum of what is added up.
/// Where numbers are so small that they underflow the bound is infinite.
struct Rounded {
  Rounded(Vec3 x, const Ball& a, const Ball& b) {
    const double to_a = squared_distance<double>(x, a.center), to_b = squared_distance<double>(x, b.center);
    value = (to_b - b.weight) - (to_a - a.weight);
    const double sum = to_a + to_b + a.weight + b.weight;
    error = sum > 0x1p-900 ? 0x1p-49 * sum : std::numeric_limits<double>::infinity();
  }
  double value, error;
};

/// Sign of power(x, b) - power(x, a): negative when x is nearer to b.
int compare(Vec3 x, const Ball& a, const Ball& b) {
  const Rounded d(x, a, b);
  if (std::abs(d.value) > d.error) return d.value > 0 ? 1 : -1;
  return sign_of([&]<class T>(T) -> T { return difference<T>(x, a, b); });
}

/// Ball k is left for l, or for m, on the way from p to q: the sign of time(l) - time(m). The difference of
/// the powers to l and k falls linearly from difference(p, k, l) >= 0 to difference(q, k, l) < 0.
int compare_times(Vec3 p, Vec3 q, const Ball& k, const Ball& l, const Ball& m) {
  const Rounded pm(p, k, m), ql(q, k, l), pl(p, k, l), qm(q, k, m);
  const double value = pm.value * ql.value - pl.value * qm.value;
  const auto error = [](const Rounded& a, const Rounded& b) {
    return (std::abs(a.value) + a.error) * b.error + std::abs(b.value) * a.error;
  };
  const double bound = 2 * (error(pm, ql) + error(pl, qm)) +
                       0x1p-50 * (std::abs(pm.value * ql.value) + std::abs(pl.value * qm.value));
  if (bound > 0x1p-900 && std::abs(value) > bound) return value > 0 ? 1 : -1;
  return sign_of([&]<class T>(T) -> T {
    return difference<T>(p, k, m) * difference<T>(q, k, l) - difference<T>(p, k, l) * difference<T>(q, k, m);
  });
}

}  // namespace

int compare_powers(Vec3 x, Vec3 a, double weight_a, Vec3 b, double weight_b) {
  return compare(x, {a, weight_a}, {b, weight_b});
}

PowerWalk::PowerWalk(const PowerDiagram& diagram)
    : centers_(diagram.centers), weights_(diagram.weights), begin_(centers_.size() + 1) {
  // All pairs of corners of cells, by their first ball; then each list without repetition.
  std::vector<std::size_t> end(centers_.size() + 2);
  const auto for_each_pair = [&diagram](const auto& visit) {
    for (const auto& cell : diagram.cells) {
      for (const std::int32_t u : cell) {
        for (const std::int32_t v : cell) {
          if (u >= 0 && v >= 0 && u != v) visit(u, v);
        }
      }
    }
  };
  for_each_pair([&](std::int32_t u, std::int32_t) { ++end[at(u) + 2]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  neighbors_.resize(end.back());
  for_each_pair([&](std::int32_t u, std::int32_t v) { neighbors_[end[at(u) + 1]++] = v; });
  std::size_t kept = 0, first = 0;
  for (std::size_t u = 0; u < centers_.size(); ++u) {
    const auto from = neighbors_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = neighbors_.begin() + static_cast<std::ptrdiff_t>(end[u + 1]);
    first = end[u + 1];
    std::sort(from, to);
    const auto last = std::unique(from, to);
    begin_[u] = kept;
    kept = static_cast<std::size_t>(
        std::move(from, last, neighbors_.begin() + static_cast<std::ptrdiff_t>(kept)) - neighbors_.begin());
  }
  begin_.back() = kept;
  neighbors_.resize(kept);
  for (const auto& cell : diagram.cells) {
    for (const std::int32_t u : cell) {
      if (u >= 0 && (any_ < 0 || u < any_)) any_ = u;
    }
  }
}

std::span<const std::int32_t> PowerWalk::around(std::int32_t ball) const {
  return {neighbors_.data() + begin_[at(ball)], begin_[at(ball) + 1] - begin_[at(ball)]};
}

std::int32_t PowerWalk::cell_of(Vec3 x, std::int32_t from) const {
  const auto ball = [this](std::int32_t i) { return Ball{centers_[at(i)], weights_[at(i)]}; };
  for (bool moved = true; moved;) {
    moved = false;
    std::int32_t best = from;
    for (const std::int32_t next : around(from)) {
      if (compare(x, ball(best), ball(next)) < 0) best = next;
    }
    moved = best != from;
    from = best;
  }
  return from;
}

std::int32_t PowerWalk::along(Vec3 p, Vec3 q, std::int32_t from,
                              const std::function<void(std::int32_t, std::int32_t)>& visit) const {
  const auto ball = [this](std::int32_t i) { return Ball{centers_[at(i)], weights_[at(i)]}; };
  for (;;) {
    const Ball here = ball(from);
    std::int32_t best = -1;
    for (const std::int32_t next : around(from)) {
      if (compare(q, here, ball(next)) >= 0) continue;
      if (best >= 0) {
        // The first cell to be entered; of several at once the one that is nearest at q, which falls fastest.
        int order = compare_times(p, q, here, ball(next), ball(best));
        if (order == 0) order = compare(q, ball(best), ball(next));
        if (order >= 0) continue;
      }
      best = next;
    }
    if (best < 0) return from;
    visit(from, best);
    from = best;
  }
}

void PowerWalk::around_point(Vec3 x, std::int32_t u, std::int32_t v,
                             const std::function<void(std::int32_t, std::int32_t)>& visit) const {
  if (u == v) return;
  const auto ball = [this](std::int32_t i) { return Ball{centers_[at(i)], weights_[at(i)]}; };
  // Breadth first from v, so that the way back is the way there.
  std::vector<std::pair<std::int32_t, std::int32_t>> queue{{v, v}};  // ball, the one it was reached from
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::int32_t next : around(queue[i].first)) {
      if (compare(x, ball(v), ball(next)) != 0) continue;
      if (std::any_of(queue.begin(), queue.end(), [&](const auto& e) { return e.first == next; })) continue;
      queue.emplace_back(next, queue[i].first);
    }
  }
  while (u != v) {
    const auto found = std::find_if(queue.begin(), queue.end(), [&](const auto& e) { return e.first == u; });
    if (found == queue.end())
      throw std::logic_error("two balls share a point of their cells but no chain of cells");
    visit(u, found->second);
    u = found->second;
  }
}

bool PowerWalk::outside(Vec3 x, std::int32_t i) const {
  const Ball ball{centers_[at(i)], weights_[at(i)]};
  return sign_of([&]<class T>(T) -> T { return power<T>(x, ball); }) > 0;
}

}  // namespace ballflow::geometry
