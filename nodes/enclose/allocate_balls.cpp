#include "enclose/allocate_balls.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

/// Volume outside against the number of balls: the largest convex function of 1 / sqrt(k) below the fits, so
/// that a fit without luck does not end the gains of an object.
class Curve {
 public:
  void add(const EnclosureFit& fit) {
    Point point{1 / std::sqrt(static_cast<double>(fit.wanted)), fit.loss};
    if (!points_.empty())
      point.loss = std::min(point.loss, points_.back().loss);  // never more for more balls
    while (points_.size() > 1 && !below(points_[points_.size() - 2], points_.back(), point))
      points_.pop_back();
    points_.push_back(point);
  }

  double at(std::int64_t balls) const {
    const double place = 1 / std::sqrt(static_cast<double>(balls));
    const Point &few = points_.front(), &many = points_.back();
    if (place <= many.place) return many.loss * place / many.place;
    if (place >= few.place) return few.loss * place / few.place;
    std::size_t i = 1;
    while (place < points_[i].place) ++i;
    const Point &a = points_[i - 1], &b = points_[i];
    return b.loss + (a.loss - b.loss) * (place - b.place) / (a.place - b.place);
  }

 private:
  struct Point {
    double place, loss;
  };
  /// Whether b lies below the line from a to c.
  static bool below(const Point& a, const Point& b, const Point& c) {
    return (b.loss - c.loss) * (a.place - c.place) < (a.loss - c.loss) * (b.place - c.place);
  }
  std::vector<Point> points_;  // more and more balls
};

void check_length(std::size_t length, std::size_t objects, const std::string& what) {
  if (length == 0 || length == objects) return;
  throw InputError(std::to_string(length) + " " + what + " for " + std::to_string(objects) + " objects",
                   "give one for each, or none");
}

}  // namespace

BallCounts allocate_balls(std::span<const EnclosureFit> fits, const AllocateBallsOptions& options) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (i == 0 || fits[i].wanted <= fits[i - 1].wanted) curves.emplace_back();
    curves.back().add(fits[i]);
  }
  check_length(options.weights.size(), curves.size(), "weights");
  check_length(options.fixed.size(), curves.size(), "fixed counts");
  std::vector<std::int32_t> counts(curves.size());
  std::vector<bool> free(curves.size(), true);
  std::int64_t left = options.balls;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    free[i] = options.fixed.empty() || options.fixed[i] == 0;
    const std::int64_t count = free[i] ? options.minimum : options.fixed[i];
    if (count < 1)
      throw InputError("object " + std::to_string(i) + " would get " + std::to_string(count) + " balls",
                       "give every object one at least");
    counts[i] = static_cast<std::int32_t>(count);
    left -= count;
  }
  if (left < 0) {
    throw InputError("minimum and fixed counts need " + std::to_string(options.balls - left) +
                         " balls, but all objects together get " + std::to_string(options.balls),
                     "raise balls, or lower the minimum");
  }
  const auto gain = [&](std::size_t i) {
    const double weight = options.weights.empty() ? 1 : options.weights[i];
    return weight * (curves[i].at(counts[i]) - curves[i].at(counts[i] + 1));
  };
  std::vector<double> gains(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) gains[i] = free[i] ? gain(i) : -1;
  for (; left > 0; --left) {
    const auto best = std::max_element(gains.begin(), gains.end());
    if (best == gains.end() || *best < 0) break;  // all counts are fixed
    const auto i = static_cast<std::size_t>(best - gains.begin());
    ++counts[i];
    gains[i] = gain(i);
  }
  std::vector<double> outside;
  for (std::size_t i = 0; i < curves.size(); ++i) outside.push_back(std::max(0.0, curves[i].at(counts[i])));
  return {std::move(counts), std::move(outside)};
}

std::int64_t only_count(const BallCounts& counts) {
  if (counts.counts.size() != 1) {
    throw InputError("count has the counts of " + std::to_string(counts.counts.size()) + " objects",
                     "choose one by BallCount");
  }
  return counts.counts[0];
}

BallCounts count_of(const BallCounts& counts, std::int64_t object) {
  if (object < 0 || object >= static_cast<std::int64_t>(counts.counts.size())) {
    throw InputError(
        "there is no object " + std::to_string(object) + " among " + std::to_string(counts.counts.size()),
        "number objects from 0, in the order of their fits");
  }
  const auto i = static_cast<std::size_t>(object);
  return {std::vector<std::int32_t>{counts.counts[i]}, std::vector<double>{counts.outside[i]}};
}

}  // namespace ballflow::geometry
