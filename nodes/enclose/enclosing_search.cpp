#include "enclose/enclosing_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace ballflow::geometry {
namespace {

constexpr float coarse_step = 0.15F, fine_step = 0.003F;  // in radii

std::size_t below(Random& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(random.unit() * static_cast<double>(count)));
}

/// Of points, longest first; rough ones do.
std::array<Vec3, 3> principal_axes(const std::vector<Vec3>& points) {
  Vec3 mean;
  for (const Vec3 p : points) mean = mean + 1.0 / static_cast<double>(points.size()) * p;
  const auto covariance = [&](Vec3 v) {
    Vec3 result;
    for (const Vec3 p : points) result = result + dot(v, p - mean) * (p - mean);
    return result;
  };
  const auto unit = [](Vec3 v, Vec3 otherwise) {
    const double norm = length(v);
    return norm > 1e-30 ? 1 / norm * v : otherwise;
  };
  std::array<Vec3, 3> axes{{{1, 0.3, 0.2}, {-0.3, 1, 0.1}, {}}};
  for (int round = 0; round < 8; ++round) {
    axes[0] = unit(covariance(axes[0]), {1, 0, 0});
    const Vec3 next = covariance(axes[1]), other = cross(axes[0], {0.3, 0.5, 0.8});
    axes[1] = unit(next - dot(next, axes[0]) * axes[0], unit(other, {0, 1, 0}));
  }
  axes[2] = cross(axes[0], axes[1]);
  return axes;
}

}  // namespace

void EnclosingSearch::change(std::size_t i, const FloatBall& ball) {
  if (cover_.place(i).used) changed(cover_.place(i).ball);
  cover_.set(i, ball);
  changed(ball);
}

void EnclosingSearch::drop(std::size_t i) {
  changed(cover_.place(i).ball);
  cover_.remove(i);
}

void EnclosingSearch::changed(const FloatBall& where) {
  splits_.resize(cover_.places());
  removals_.resize(cover_.places());
  for (std::size_t j = 0; j < cover_.places(); ++j) {
    if (cover_.place(j).used &&
        center_distance(cover_.place(j).ball, where) > cover_.place(j).ball.r + where.r)
      continue;
    splits_[j].known = false;
    removals_[j].known = false;
  }
}

void EnclosingSearch::look() {
  if (monitor_.cancelled()) throw Cancelled();
}

void EnclosingSearch::take(const std::vector<FloatBall>& balls) {
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (cover_.place(i).used) drop(i);
  }
  for (std::size_t i = 0; i < balls.size(); ++i) change(i, balls[i]);
  repair();
  cover_.forget();
}

std::vector<FloatBall> EnclosingSearch::balls() const {
  std::vector<FloatBall> result;
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (cover_.place(i).used) result.push_back(cover_.place(i).ball);
  }
  return result;
}

std::vector<std::size_t> EnclosingSearch::repair() {
  std::vector<std::size_t> grown;
  if (cover_.uncovered() == 0) return grown;
  std::vector<float> radii(cover_.places(), -1);
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (cover_.place(i).used) radii[i] = cover_.place(i).ball.r;
  }
  for (std::size_t p = 0; p < cover_.patches(); ++p) {
    if (cover_.patch_counts()[p] != 0) continue;
    std::size_t best = 0;
    float least = std::numeric_limits<float>::infinity(), needed = 0;
    for (std::size_t i = 0; i < cover_.places(); ++i) {
      if (radii[i] < 0) continue;
      const float r = cover_.farthest(p, cover_.place(i).ball) * (1 + 4e-7F);
      const float growth = std::max(0.0F, r - radii[i]);
      if (growth < least) {
        least = growth;
        best = i;
        needed = r;
      }
    }
    radii[best] = std::max(radii[best], needed);
  }
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (!cover_.place(i).used || radii[i] <= cover_.place(i).ball.r) continue;
    FloatBall ball = cover_.place(i).ball;
    ball.r = radii[i];
    change(i, ball);
    grown.push_back(i);
  }
  return grown;
}

FloatBall EnclosingSearch::fit_to(std::size_t i, const std::vector<std::int32_t>& patches, BallFit& fit,
                                  float coarse, float fine) {
  // A first fit tells where the points are, the second one which are to be avoided.
  fit.begin(0, 0, 0, 0, 1);
  for (const std::int32_t p : patches) {
    for (std::size_t k = 0; k < 3; ++k) {
      const FloatPoints& c = cover_.patch_blocks().corner(k);
      const auto n = static_cast<std::size_t>(p);
      fit.hold(c.x[n], c.y[n], c.z[n]);
    }
  }
  fit.end();
  const FloatBall around = fit.middle();
  cover_.prepare(i, around, patches, fit);
  return fit.search(around.x, around.y, around.z, random_, coarse, fine);
}

bool EnclosingSearch::step(std::size_t i) {
  if (!cover_.place(i).used) return false;
  cover_.only_in(i, only_);
  if (only_.empty()) {
    drop(i);
    return true;
  }
  const FloatBall before = cover_.place(i).ball;
  cover_.prepare(i, before, only_, fit_);
  const FloatBall found = fit_.search(before.x, before.y, before.z, random_, coarse_step, fine_step);
  const std::int64_t waste = cover_.waste();
  const std::size_t mark = cover_.mark();
  cover_.set(i, found);
  if (cover_.waste() > waste) {
    cover_.undo_to(mark);
    return false;
  }
  changed(before);
  changed(found);
  return cover_.waste() < waste;
}

void EnclosingSearch::sweep(int most) {
  std::vector<std::size_t> order;
  for (int round = 0; round < most; ++round) {
    look();
    const std::int64_t before = cover_.waste();
    order.clear();
    for (std::size_t i = 0; i < cover_.places(); ++i) {
      if (cover_.place(i).used) order.push_back(i);
    }
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[below(random_, i)]);
    for (const std::size_t i : order) {
      look();
      step(i);
      cover_.forget();
    }
    if (static_cast<double>(before - cover_.waste()) < 0.002 * static_cast<double>(before)) break;
  }
}

std::vector<std::size_t> EnclosingSearch::nearest_balls(std::size_t i, std::size_t count) const {
  std::vector<std::pair<float, std::size_t>> order;
  const FloatBall& ball = cover_.place(i).ball;
  for (std::size_t j = 0; j < cover_.places(); ++j) {
    if (j == i || !cover_.place(j).used) continue;
    const FloatBall& other = cover_.place(j).ball;
    const float gap = center_distance(ball, other) - ball.r - other.r;
    if (gap < 0) order.emplace_back(gap, j);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) result.push_back(order[k].second);
  return result;
}

void EnclosingSearch::step_around(std::size_t i, std::size_t neighbors) {
  if (!cover_.place(i).used) return;
  for (const std::size_t j : nearest_balls(i, neighbors)) step(j);
  step(i);
}

void EnclosingSearch::step_all(const std::vector<std::size_t>& places) {
  for (const std::size_t i : places) step(i);
}

Vec3 EnclosingSearch::middle(std::int32_t patch) const {
  Vec3 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatPoints& c = cover_.patch_blocks().corner(k);
    const auto n = static_cast<std::size_t>(patch);
    sum = sum + Vec3{c.x[n], c.y[n], c.z[n]};
  }
  return 1.0 / 3 * sum;
}

double EnclosingSearch::key(const Split& plan, Vec3 middle) {
  return plan.disc ? distance(middle, plan.where) : dot(middle, plan.where);
}

void EnclosingSearch::plan_split(std::size_t i) {
  Split best;
  best.known = true;
  splits_[i] = best;
  cover_.only_in(i, only_);
  if (only_.size() < 2) return;
  constexpr std::size_t most_patches = 160;  // the gain is an estimate
  std::vector<std::int32_t> patches;
  const std::size_t thin = 1 + (only_.size() - 1) / most_patches;
  for (std::size_t p = 0; p < only_.size(); p += thin) patches.push_back(only_[p]);
  std::vector<Vec3> middles;
  for (const std::int32_t p : patches) middles.push_back(middle(p));
  const FloatBall whole = cover_.place(i).ball;
  std::size_t farthest = 0;
  float away = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const float d = cover_.farthest(static_cast<std::size_t>(patches[p]), whole);
    if (d > away) farthest = p;
    away = std::max(away, d);
  }
  cover_.prepare(i, whole, patches, fit_);
  const float alone = fit_.weight_in(whole);
  float least = std::numeric_limits<float>::infinity();
  const std::array<Vec3, 3> axes = principal_axes(middles);
  constexpr std::array<double, 6> shares{0.5, 0.5, 0.5, 0.12, 0.25, 0.4};
  std::vector<double> keys;
  std::vector<std::int32_t> first, second;
  for (std::size_t way = 0; way < shares.size(); ++way) {
    Split plan = best;
    plan.disc = way >= axes.size();
    plan.where = plan.disc ? middles[farthest] : axes[way];
    keys.clear();
    for (const Vec3 m : middles) keys.push_back(key(plan, m));
    std::vector<double> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    const auto cut = static_cast<std::size_t>(shares[way] * static_cast<double>(sorted.size() - 1));
    plan.limit = 0.5 * (sorted[cut] + sorted[cut + 1]);
    first.clear();
    second.clear();
    for (std::size_t p = 0; p < keys.size(); ++p)
      (keys[p] <= plan.limit ? first : second).push_back(patches[p]);
    if (first.empty() || second.empty()) continue;
    const FloatBall a = fit_to(i, first, other_fit_, coarse_step, 0.04F),
                    b = fit_to(i, second, other_fit_, coarse_step, 0.04F);
    const float waste = fit_.weight_in_either(a, b);
    if (waste >= least) continue;
    least = waste;
    plan.possible = true;
    plan.gain = static_cast<std::int64_t>(alone - waste);
    splits_[i] = plan;
  }
}

bool EnclosingSearch::split(std::size_t i) {
  const std::size_t j = cover_.free_place();
  const Split plan = splits_[i];
  cover_.only_in(i, only_);
  std::vector<std::int32_t> first, second;
  for (const std::int32_t p : only_) (key(plan, middle(p)) <= plan.limit ? first : second).push_back(p);
  if (j == cover_.places() || first.empty() || second.empty()) return false;
  const std::int64_t waste = cover_.waste();
  const FloatBall a = fit_to(i, first, fit_, coarse_step, fine_step),
                  b = fit_to(i, second, fit_, coarse_step, fine_step);
  change(i, a);
  change(j, b);
  step_around(i, 2);
  step_around(j, 2);
  return cover_.waste() < waste;
}

std::size_t EnclosingSearch::best_split() {
  std::size_t best = cover_.places();
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (!cover_.place(i).used) continue;
    look();
    if (!splits_[i].known) plan_split(i);
    if (!splits_[i].possible) continue;
    if (best == cover_.places() || splits_[i].gain > splits_[best].gain) best = i;
  }
  return best;
}

void EnclosingSearch::fill() {
  while (cover_.used() < cover_.places()) {
    const std::size_t best = best_split();
    if (best == cover_.places() || splits_[best].gain <= 0) break;
    const std::vector<Split> splits = splits_;
    const std::vector<Removal> removals = removals_;
    if (!split(best)) {
      cover_.undo_to(0);
      splits_ = splits;
      removals_ = removals;
      splits_[best].gain = 0;
    }
    cover_.forget();
  }
}

void EnclosingSearch::fill_anyway() {
  // Splits may free balls again, so that places alone do not end it.
  for (std::size_t n = cover_.places() - cover_.used(); n > 0; --n) {
    const std::size_t best = best_split();
    if (best == cover_.places() || cover_.used() == cover_.places()) break;
    split(best);
    cover_.forget();
  }
}

void EnclosingSearch::shift() {
  look();
  const std::size_t i = below(random_, cover_.places());
  if (!cover_.place(i).used) return;
  cover_.only_in(i, only_);
  if (only_.size() < 2) return;
  const FloatBall ball = cover_.place(i).ball;
  std::int32_t rim = only_[0];
  float away = 0;
  for (const std::int32_t p : only_) {
    const float d = cover_.farthest(static_cast<std::size_t>(p), ball);
    if (d > away) rim = p;
    away = std::max(away, d);
  }
  const double disc = (0.1 + 0.5 * random_.unit()) * ball.r;
  const Vec3 center = middle(rim);
  std::vector<std::int32_t> handed;
  for (const std::int32_t p : only_) {
    if (distance(middle(p), center) <= disc) handed.push_back(p);
  }
  if (handed.size() == only_.size()) return;
  std::size_t taker = cover_.places();
  float least = std::numeric_limits<float>::infinity(), radius = 0;
  for (const std::size_t j : nearest_balls(i, cover_.places())) {
    float needed = cover_.place(j).ball.r;
    for (const std::int32_t p : handed)
      needed = std::max(needed, cover_.farthest(static_cast<std::size_t>(p), cover_.place(j).ball));
    if (needed - cover_.place(j).ball.r >= least) continue;
    least = needed - cover_.place(j).ball.r;
    taker = j;
    radius = needed;
  }
  if (taker == cover_.places() || radius > 2 * cover_.place(taker).ball.r) return;
  const std::vector<Split> splits = splits_;
  const std::vector<Removal> removals = removals_;
  const std::int64_t waste = cover_.waste();
  std::vector<std::int32_t> held;
  cover_.only_in(taker, held);
  held.insert(held.end(), handed.begin(), handed.end());
  FloatBall around = cover_.place(taker).ball;
  around.r = radius;
  cover_.prepare(taker, around, held, fit_);
  change(taker, fit_.search(around.x, around.y, around.z, random_, coarse_step, fine_step));
  step(i);
  step_around(taker, 2);
  if (cover_.place(i).used) step_around(i, 2);
  if (cover_.waste() >= waste) {
    cover_.undo_to(0);
    splits_ = splits;
    removals_ = removals;
  }
  cover_.forget();
}

std::vector<std::size_t> EnclosingSearch::remove_and_repair(std::size_t i) {
  drop(i);
  std::vector<std::size_t> grown = repair();
  step_all(grown);
  return grown;
}

void EnclosingSearch::plan_removal(std::size_t i) {
  const std::vector<Split> splits = splits_;
  std::vector<Removal> removals = removals_;
  const std::int64_t waste = cover_.waste();
  const std::size_t mark = cover_.mark();
  remove_and_repair(i);
  removals[i] = {true, cover_.waste() - waste};
  cover_.undo_to(mark);
  splits_ = splits;
  removals_ = std::move(removals);
}

bool EnclosingSearch::swap() {
  if (cover_.used() < 2) return false;
  const std::size_t none = cover_.places();
  std::size_t removed = none, halved = none;
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (!cover_.place(i).used) continue;
    look();
    if (!removals_[i].known) plan_removal(i);
    if (!splits_[i].known) plan_split(i);
    if (removed == none || removals_[i].loss < removals_[removed].loss) removed = i;
  }
  for (std::size_t i = 0; i < cover_.places(); ++i) {
    if (!cover_.place(i).used || i == removed) continue;
    if (halved == none || splits_[i].gain > splits_[halved].gain) halved = i;
  }
  constexpr double hope = 3;  // neither is exact, and steps around both gain, too
  if (static_cast<double>(removals_[removed].loss) > hope * static_cast<double>(splits_[halved].gain))
    return false;
  const std::vector<Split> splits = splits_;
  const std::vector<Removal> removals = removals_;
  const std::int64_t waste = cover_.waste();
  remove_and_repair(removed);
  bool better = false;
  if (cover_.place(halved).used) {
    if (!splits_[halved].known) plan_split(halved);
    split(halved);
    better = cover_.waste() < waste;
  }
  if (!better) {
    cover_.undo_to(0);
    splits_ = splits;
    removals_ = removals;
    removals_[removed].loss = std::numeric_limits<std::int64_t>::max();
  }
  cover_.forget();
  return true;
}

}  // namespace ballflow::geometry
