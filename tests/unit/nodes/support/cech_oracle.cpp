#include "cech_oracle.hpp"

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "binary_oracle.hpp"

namespace ballflow::test {
namespace {

using Number = CGAL::Gmpq;
using Point = std::array<Number, 3>;
using Simplex = std::vector<std::int32_t>;
using Column = std::set<std::int64_t>;

class Nerve {
 public:
  explicit Nerve(const geometry::Balls& balls) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const geometry::Vec3 c = balls.centers[i];
      centers_.push_back({c.x, c.y, c.z});
      weights_.emplace_back(balls.radii[i] * balls.radii[i]);
    }
    simplices_.resize(4);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(balls.size()); ++i) simplices_[0].push_back({i});
    for (std::size_t k = 1; k < 4; ++k) {
      for (const Simplex& s : simplices_[k - 1]) {
        for (std::int32_t i = s.back() + 1; i < static_cast<std::int32_t>(balls.size()); ++i) {
          Simplex t = s;
          t.push_back(i);
          if (faces_there(t) && meet(t)) simplices_[k].push_back(t);
        }
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      for (const Simplex& s : simplices_[k]) number_[s] = static_cast<std::int64_t>(number_.size());
    }
  }

  const std::vector<Simplex>& simplices(std::size_t dimension) const { return simplices_[dimension]; }
  Column boundary(const Simplex& s) const {
    Column faces;
    for (std::size_t k = 0; k < s.size() && s.size() > 1; ++k) faces.insert(number_.at(without(s, k)));
    return faces;
  }
  std::int64_t number(const Simplex& s) const { return number_.at(s); }

 private:
  static Simplex without(Simplex s, std::size_t k) {
    s.erase(s.begin() + static_cast<std::ptrdiff_t>(k));
    return s;
  }
  bool faces_there(const Simplex& s) const {
    for (std::size_t k = 0; k < s.size(); ++k) {
      const auto& list = simplices_[s.size() - 2];
      if (!std::binary_search(list.begin(), list.end(), without(s, k))) return false;
    }
    return true;
  }

  Number power(const Point& x, std::int32_t ball) const {
    const Point& c = centers_[static_cast<std::size_t>(ball)];
    Number sum = -weights_[static_cast<std::size_t>(ball)];
    for (std::size_t d = 0; d < 3; ++d) sum += (x[d] - c[d]) * (x[d] - c[d]);
    return sum;
  }

  /// The largest power to the balls is least where some of them have equal power, in their affine hull.
  bool meet(const Simplex& s) const {
    for (unsigned subset = 1; subset < 1u << s.size(); ++subset) {
      Simplex some;
      for (std::size_t k = 0; k < s.size(); ++k) {
        if (subset >> k & 1) some.push_back(s[k]);
      }
      const std::optional<Point> x = equal_power(some);
      if (x && std::all_of(s.begin(), s.end(), [&](std::int32_t b) { return power(*x, b) <= 0; }))
        return true;
    }
    return false;
  }

  std::optional<Point> equal_power(const Simplex& s) const {
    const std::size_t n = s.size() - 1;
    const Point& origin = centers_[static_cast<std::size_t>(s[0])];
    std::vector<Point> axes;
    for (std::size_t k = 1; k < s.size(); ++k) {
      Point a = centers_[static_cast<std::size_t>(s[k])];
      for (std::size_t d = 0; d < 3; ++d) a[d] -= origin[d];
      axes.push_back(a);
    }
    const auto dot = [](const Point& a, const Point& b) -> Number {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    std::vector<std::vector<Number>> m(n, std::vector<Number>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) m[i][j] = 2 * dot(axes[i], axes[j]);
      m[i][n] = dot(axes[i], axes[i]) - weights_[static_cast<std::size_t>(s[i + 1])] +
                weights_[static_cast<std::size_t>(s[0])];
    }
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t pivot = i;
      while (pivot < n && m[pivot][i] == 0) ++pivot;
      if (pivot == n) return std::nullopt;  // affinely dependent: fewer of them do
      std::swap(m[i], m[pivot]);
      for (std::size_t r = 0; r < n; ++r) {
        if (r == i) continue;
        const Number factor = m[r][i] / m[i][i];
        for (std::size_t c = i; c <= n; ++c) m[r][c] -= factor * m[i][c];
      }
    }
    Point x = origin;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t d = 0; d < 3; ++d) x[d] += m[i][n] / m[i][i] * axes[i][d];
    }
    return x;
  }

  std::vector<Point> centers_;
  std::vector<Number> weights_;
  std::vector<std::vector<Simplex>> simplices_;
  std::map<Simplex, std::int64_t> number_;
};

void add(Column& sum, const Column& other) {
  for (const std::int64_t x : other) {
    if (!sum.insert(x).second) sum.erase(x);
  }
}

/// A basis of the cycles among `simplices`.
std::vector<Column> cycles(const Nerve& nerve, const std::vector<Simplex>& simplices) {
  std::vector<Column> result;
  std::map<std::int64_t, std::pair<Column, Column>> by_pivot;  // boundary, and the chain it belongs to
  for (const Simplex& s : simplices) {
    Column boundary = nerve.boundary(s), chain{nerve.number(s)};
    while (!boundary.empty()) {
      const auto pivot = by_pivot.find(*boundary.rbegin());
      if (pivot == by_pivot.end()) break;
      add(chain, pivot->second.second);
      add(boundary, pivot->second.first);
    }
    if (boundary.empty()) {
      result.push_back(chain);
    } else {
      const std::int64_t pivot = *boundary.rbegin();
      by_pivot[pivot] = {boundary, chain};
    }
  }
  return result;
}

std::vector<Column> boundaries(const Nerve& nerve, const std::vector<Simplex>& simplices) {
  std::vector<Column> result;
  for (const Simplex& s : simplices) result.push_back(nerve.boundary(s));
  return result;
}

}  // namespace

geometry::InclusionHomology cech_inclusion(const geometry::Balls& balls, std::span<const std::int32_t> part) {
  const Nerve nerve(balls);
  const auto in_part = [&](const std::vector<Simplex>& all) {
    std::vector<Simplex> some;
    for (const Simplex& s : all) {
      if (std::all_of(s.begin(), s.end(),
                      [&](auto v) { return std::find(part.begin(), part.end(), v) != part.end(); }))
        some.push_back(s);
    }
    return some;
  };
  geometry::InclusionHomology result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<Column> whole = boundaries(nerve, nerve.simplices(k + 1));
    const std::vector<Column> cycles_of_part = cycles(nerve, in_part(nerve.simplices(k)));
    const std::int64_t bounding = rank(whole);
    result.whole[k] = static_cast<std::int64_t>(cycles(nerve, nerve.simplices(k)).size()) - bounding;
    result.part[k] = static_cast<std::int64_t>(cycles_of_part.size()) -
                     rank(boundaries(nerve, in_part(nerve.simplices(k + 1))));
    std::vector<Column> both = whole;
    both.insert(both.end(), cycles_of_part.begin(), cycles_of_part.end());
    result.rank[k] = rank(both) - bounding;
  }
  return result;
}

}  // namespace ballflow::test
