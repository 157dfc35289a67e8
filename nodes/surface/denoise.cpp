#include "surface/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/for_each_block.hpp"
#include "base/principal_axes.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t terms = 6;
using Row = std::array<double, terms>;

struct Neighbor {
  double distance;
  Vec3 place;
  std::size_t index;
  friend bool operator<(const Neighbor& a, const Neighbor& b) {
    return std::tie(a.distance, a.place) < std::tie(b.distance, b.place);
  }
};

/// The k nearest samples, the one at p among them, ascending.
void find_neighbors(const BoxTree& tree, const Array<Vec3>& points, Vec3 p, std::size_t k,
                    std::vector<Neighbor>& nearest) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  nearest.clear();
  // A heap whose top is the farthest. What is exactly as far as it may come first by its coordinates.
  tree.smallest(p, infinity, -infinity, [&](std::size_t j) {
    const Neighbor other{distance(p, points[j]), points[j], j};
    if (nearest.size() < k) {
      nearest.push_back(other);
      std::push_heap(nearest.begin(), nearest.end());
    } else if (other < nearest.front()) {
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.back() = other;
      std::push_heap(nearest.begin(), nearest.end());
    }
    return nearest.size() < k ? infinity : std::nextafter(nearest.front().distance, infinity);
  });
  std::sort_heap(nearest.begin(), nearest.end());
}

/// e^-x for x in [0, 2], made of + and * only: that of the C library differs between machines. Wrong by less
/// than 1e-14 of it.
double falling_exponential(double x) {
  const double y = x / 32;  // at most 1/16, so that ten terms are enough
  double sum = 1;
  for (int k = 10; k > 0; --k) sum = 1 - y / k * sum;
  for (int k = 0; k < 5; ++k) sum *= sum;
  return sum;
}

/// The factor l of a = l l^T (Cholesky) in the lower half. False where a is not safely positive definite.
bool factorize(std::array<Row, terms>& a) {
  Row before;
  for (std::size_t i = 0; i < terms; ++i) before[i] = a[i][i];
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = sum / a[j][j];
      } else if (sum > 1e-9 * before[i]) {
        a[i][i] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  return true;
}

/// x of l l^T x = b, in place.
void solve(const std::array<Row, terms>& l, Row& b) {
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= l[i][k] * b[k];
    b[i] /= l[i][i];
  }
  for (std::size_t i = terms; i-- > 0;) {
    for (std::size_t k = i + 1; k < terms; ++k) b[i] -= l[k][i] * b[k];
    b[i] /= l[i][i];
  }
}

struct Fit {
  bool found = false;
  Vec3 point;        // of the quadric, above or below the sample
  double noise = 0;  // what the distances to the quadric say about the deviation of the noise
};

/// The quadric through neighbours of p, which are sorted by distance.
Fit fit_quadric(Vec3 p, std::span<const Neighbor> neighbors, std::vector<double>& weights) {
  const double reach = neighbors.back().distance;
  if (!(reach > 0)) return {};
  weights.clear();
  double all = 0;
  Vec3 mean{0, 0, 0};
  for (const Neighbor& n : neighbors) {
    const double d = n.distance / reach;
    weights.push_back(falling_exponential(2 * d * d));  // a Gaussian of half the reach
    all += weights.back();
    mean = mean + weights.back() / reach * (n.place - p);
  }
  mean = 1 / all * mean;
  std::array<std::array<double, 3>, 3> spread{};
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const Vec3 d = 1 / reach * (neighbors[i].place - p) - mean;
    const std::array<double, 3> x{d.x, d.y, d.z};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) spread[r][c] += weights[i] * x[r] * x[c];
    }
  }
  const std::array<Vec3, 3> axes = principal_axes(spread);
  // Lengths are in units of the reach, so that all terms are of one size.
  const auto terms_of = [&](const Neighbor& n, double& h) {
    const Vec3 d = 1 / reach * (n.place - p);
    const double u = dot(d, axes[0]), v = dot(d, axes[1]);
    h = dot(d, axes[2]);
    return Row{1, u, v, u * u, u * v, v * v};
  };
  std::array<Row, terms> normal{}, squared{};  // X^T W X and X^T W^2 X
  Row solution{};
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    double h;
    const Row row = terms_of(neighbors[i], h);
    const double w = weights[i];
    for (std::size_t r = 0; r < terms; ++r) {
      for (std::size_t c = 0; c < terms; ++c) {
        normal[r][c] += w * row[r] * row[c];
        squared[r][c] += w * w * row[r] * row[c];
      }
      solution[r] += w * row[r] * h;
    }
  }
  if (!factorize(normal)) return {};
  solve(normal, solution);
  if (!(std::abs(solution[0]) <= 1)) return {};
  double squares = 0, fitted = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    double h;
    const Row row = terms_of(neighbors[i], h);
    for (std::size_t r = 0; r < terms; ++r) h -= solution[r] * row[r];
    squares += weights[i] * h * h;
  }
  // What the fit takes away from noise: the expected sum of squares is sigma^2 (sum w - fitted).
  for (std::size_t c = 0; c < terms; ++c) {
    Row column;
    for (std::size_t r = 0; r < terms; ++r) column[r] = squared[r][c];
    solve(normal, column);
    fitted += column[c];
  }
  const double freedom = std::max(all - fitted, 0.01 * all);
  return {true, p + reach * solution[0] * axes[2], reach * std::sqrt(squares / freedom)};
}

/// Samples that came to lie in one place go back to where they were.
void keep_apart(const Array<Vec3>& from, std::vector<Vec3>& moved, std::vector<double>& deviations) {
  std::vector<std::size_t> order(from.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (bool again = true; again;) {
    again = false;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return moved[a] < moved[b]; });
    for (std::size_t first = 0, last; first < order.size(); first = last) {
      for (last = first + 1; last < order.size() && moved[order[last]] == moved[order[first]];) ++last;
      if (last - first == 1) continue;
      for (std::size_t i = first; i < last; ++i) {
        again = again || moved[order[i]] != from[order[i]];  // it may meet others there
        moved[order[i]] = from[order[i]];
        deviations[order[i]] = 0;
      }
    }
  }
}

void check(const DenoiseOptions& options) {
  const auto require = [](bool right, const char* name, std::int32_t value, const char* range) {
    if (!right) throw InputError(std::string(name) + " is " + std::to_string(value), range);
  };
  require(options.neighbors >= 8 && options.neighbors <= 1000, "neighbors", options.neighbors,
          "use from 8 (a quadric has 6 coefficients) to 1000");
  require(options.rounds >= 1 && options.rounds <= 100, "rounds", options.rounds, "use from 1 to 100");
}

/// One round over the samples of a set.
class Round {
 public:
  static constexpr std::size_t fewest = 16;

  Round(const Array<Vec3>& from, std::size_t neighbors, Monitor& monitor)
      : from_(from),
        wanted_(neighbors),
        k_(std::min(neighbors, from.size())),
        tree_(from.span(), BoxTree::default_leaf_size, monitor) {}

  /// What the few nearest neighbours of every sample say about the noise.
  std::vector<double> noise(Monitor& monitor) const {
    std::vector<double> result(from_.size(), 0);
    each(monitor, few(), [&](std::size_t i, const std::vector<Neighbor>& near, std::vector<double>& weights) {
      result[i] = fit_quadric(from_[i], near, weights).noise;
    });
    return result;
  }

  /// Makes an average of it around every sample.
  void look(Monitor& monitor) {
    const std::vector<double> own = noise(monitor);
    level_.assign(from_.size(), 0);
    each(monitor, few(), [&](std::size_t i, const std::vector<Neighbor>& near, std::vector<double>&) {
      double squares = 0;
      for (const Neighbor& n : near) squares += own[n.index] * own[n.index];
      level_[i] = std::sqrt(squares / static_cast<double>(near.size()));
    });
  }

  void move(std::vector<Vec3>& moved, std::vector<double>& deviations, Monitor& monitor) const {
    each(monitor, k_, [&](std::size_t i, const std::vector<Neighbor>& near, std::vector<double>& weights) {
      moved[i] = from_[i];
      deviations[i] = 0;
      for (std::size_t k = few();; k = std::min(2 * k, k_)) {
        const Fit fit = fit_quadric(from_[i], std::span(near).first(k), weights);
        if (!fit.found || (k > few() && fit.noise > beyond_noise * level_[i])) break;
        moved[i] = fit.point;
        deviations[i] = fit.noise;
        if (k == k_) break;
      }
    });
  }

 private:
  static constexpr double beyond_noise = 1.5;

  std::size_t few() const { return std::min(std::max(fewest, wanted_ / 4), k_); }

  template <class Body>
  void each(Monitor& monitor, std::size_t k, const Body& body) const {
    for_each_block(from_.size(), 256, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
      std::vector<Neighbor> near;
      std::vector<double> weights;
      for (std::size_t i = first; i < last; ++i) {
        find_neighbors(tree_, from_, from_[i], k, near);
        body(i, near, weights);
      }
    });
  }

  const Array<Vec3>& from_;
  std::size_t wanted_, k_;
  BoxTree tree_;
  std::vector<double> level_;
};

}  // namespace

std::vector<double> local_noise(const PointSet& sample, Monitor& monitor) {
  if (sample.points.empty()) return {};
  return Round(sample.points, Round::fewest, monitor).noise(monitor);
}

Denoised denoise(const PointSet& sample, const DenoiseOptions& options, Monitor& monitor) {
  check(options);
  Denoised result{{sample.points, {}}, std::vector<double>(sample.points.size(), 0)};
  for (std::int32_t number = 0; number < options.rounds; ++number) {
    const double begin = double(number) / options.rounds, part = 1.0 / options.rounds;
    PartMonitor looking(monitor, begin, begin + 0.3 * part),
        moving(monitor, begin + 0.3 * part, begin + part);
    const Array<Vec3> from = result.points.points;
    std::vector<Vec3> moved(from.size());
    if (from.empty()) break;
    Round round(from, static_cast<std::size_t>(options.neighbors), monitor);
    round.look(looking);
    round.move(moved, result.deviations, moving);
    keep_apart(from, moved, result.deviations);
    result.points.points = std::move(moved);
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
