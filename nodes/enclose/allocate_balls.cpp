#include "enclose/allocate_balls.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

/// Volume outside against the number of balls that are used.
class Curve {
 public:
  void add(const EnclosureFit& fit) {
    Point point{1 / std::sqrt(static_cast<double>(std::max<std::int64_t>(fit.balls, 1))), fit.loss};
    used_up_ = fit.balls >= fit.wanted;
    if (!points_.empty()) {
      point.loss = std::min(point.loss, points_.back().loss);  // never more for more balls
      point.place = std::min(point.place, points_.back().place);
      if (point.place == points_.back().place) points_.pop_back();
    }
    points_.push_back(point);
  }

  double at(std::int64_t balls) const {
    const double place = 1 / std::sqrt(static_cast<double>(balls));
    const Point &few = points_.front(), &many = points_.back();
    if (place <= many.place) return used_up_ ? many.loss * place / many.place : many.loss;
    if (place >= few.place) return few.loss * place / few.place;
    std::size_t i = 1;
    while (place < points_[i].place) ++i;
    const Point &a = points_[i - 1], &b = points_[i];
    return b.loss + (a.loss - b.loss) * (place - b.place) / (a.place - b.place);
  }

 private:
  struct Point {
    double place, loss;  // 1 / sqrt(k)
  };
  std::vector<Point> points_;  // more and more balls
  bool used_up_ = true;        // whether the last fit used all balls it might
};

/// How many of `blocks` blocks each object gets, so that the sum of losses is least (and of such ways one
/// with few blocks): by dynamic programming, since losses need not be convex, and greedy ways stop where a
/// next ball gains nothing but ten more would. losses[i][j] is that of object i with j blocks.
std::vector<std::size_t> best_shares(const std::vector<std::vector<double>>& losses, std::size_t blocks) {
  std::vector<double> least(blocks + 1, 0), next(blocks + 1);  // of the objects so far, with at most s blocks
  std::vector<std::vector<std::uint16_t>> taken;
  for (const std::vector<double>& loss : losses) {
    std::vector<std::uint16_t>& choice = taken.emplace_back(blocks + 1);
    for (std::size_t s = 0; s <= blocks; ++s) {
      std::size_t best = 0;
      double sum = least[s] + loss[0];
      for (std::size_t j = 1; j <= s; ++j) {
        if (!(least[s - j] + loss[j] < sum)) continue;
        sum = least[s - j] + loss[j];
        best = j;
      }
      next[s] = sum;
      choice[s] = static_cast<std::uint16_t>(best);
    }
    least.swap(next);
  }
  std::vector<std::size_t> shares(losses.size());
  std::size_t left = blocks;
  for (std::size_t i = losses.size(); i-- > 0; left -= shares[i]) shares[i] = taken[i][left];
  return shares;
}

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
  // More than so many balls go out in blocks, or the time would grow with their square.
  constexpr std::int64_t most_blocks = 4096;
  const std::int64_t block = std::max<std::int64_t>(1, (left + most_blocks - 1) / most_blocks);
  std::vector<std::size_t> objects;
  std::vector<std::vector<double>> losses;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!free[i]) continue;
    objects.push_back(i);
    const double weight = options.weights.empty() ? 1 : options.weights[i];
    std::vector<double>& loss = losses.emplace_back();
    for (std::int64_t j = 0; j <= left / block; ++j)
      loss.push_back(weight * curves[i].at(counts[i] + j * block));
  }
  const std::vector<std::size_t> shares = best_shares(losses, static_cast<std::size_t>(left / block));
  for (std::size_t n = 0; n < objects.size(); ++n)
    counts[objects[n]] += static_cast<std::int32_t>(static_cast<std::int64_t>(shares[n]) * block);
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
