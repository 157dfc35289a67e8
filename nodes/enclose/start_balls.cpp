#include "enclose/start_balls.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace ballflow::geometry {
namespace {

struct Corner {
  float x, y, z;
};

Corner middle_of(const BallCover& cover, std::size_t patch) {
  Corner sum{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatPoints& c = cover.patch_blocks().corner(k);
    sum = {sum.x + c.x[patch] / 3, sum.y + c.y[patch] / 3, sum.z + c.z[patch] / 3};
  }
  return sum;
}

/// A unit vector, or 0 for patches without an area.
Corner normal_of(const BallCover& cover, std::size_t patch) {
  std::array<Vec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    const FloatPoints& c = cover.patch_blocks().corner(k);
    p[k] = {c.x[patch], c.y[patch], c.z[patch]};
  }
  const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
  const double norm = length(n);
  if (!(norm > 1e-14)) return {0, 0, 0};
  return {static_cast<float>(n.x / norm), static_cast<float>(n.y / norm), static_cast<float>(n.z / norm)};
}

/// The radius of the largest ball that touches p, whose centre lies in the direction m, and holds none of the
/// points.
float free_radius(const Corner& p, const Corner& m, const FloatPoints& points) {
  constexpr float flat = 1e-4F;  // points about in the tangential plane say nothing but noise
  float least = std::numeric_limits<float>::infinity();
  const Lanes px = all(p.x), py = all(p.y), pz = all(p.z), mx = all(m.x), my = all(m.y), mz = all(m.z);
  Lanes radius = all(least);
  for (std::size_t i = 0; i < points.size(); i += lanes) {
    const Lanes dx = load(&points.x[i]) - px, dy = load(&points.y[i]) - py, dz = load(&points.z[i]) - pz;
    const Lanes along = dx * mx + dy * my + dz * mz, squared = dx * dx + dy * dy + dz * dz;
    const Lanes found = squared / (along + along);
    radius = along > all(flat) ? less_of(radius, found) : radius;
  }
  for (std::size_t l = 0; l < lanes; ++l) least = std::min(least, radius[l]);
  return least;
}

/// Sets of corners as bits, a row for each ball.
class GreedyCover {
 public:
  GreedyCover(const std::vector<FloatBall>& balls, const FloatPoints& corners, std::size_t count)
      : balls_(balls.size()),
        count_(count),
        words_((count + 63) / 64),
        depth_(balls_ * count),
        bits_(balls_ * words_) {
    for (std::size_t b = 0; b < balls_; ++b) {
      for (std::size_t v = 0; v < count; ++v)
        depth_[b * count + v] =
            std::sqrt(squared_from(balls[b], corners.x[v], corners.y[v], corners.z[v])) - balls[b].r;
    }
  }

  /// Balls that cover all corners when they are grown by `growth`; more than `most` end it.
  std::vector<std::size_t> with(float growth, std::size_t most) {
    std::fill(bits_.begin(), bits_.end(), 0);
    for (std::size_t b = 0; b < balls_; ++b) {
      for (std::size_t v = 0; v < count_; ++v) {
        if (depth_[b * count_ + v] <= growth) bits_[b * words_ + v / 64] |= std::uint64_t{1} << (v % 64);
      }
    }
    std::vector<std::uint64_t> left(words_, ~std::uint64_t{0});
    if (count_ % 64 != 0) left.back() = (std::uint64_t{1} << (count_ % 64)) - 1;
    // What a ball gains never grows: who was best is looked at again, until one stays best.
    std::vector<std::pair<std::size_t, std::size_t>> queue;  // gain, and the ball counted from the last one
    for (std::size_t b = 0; b < balls_; ++b) queue.emplace_back(gain(b, left), balls_ - b);
    std::make_heap(queue.begin(), queue.end());
    std::size_t rest = count_;
    std::vector<std::size_t> chosen;
    while (rest > 0 && chosen.size() <= most) {
      std::pop_heap(queue.begin(), queue.end());
      auto& [found, place] = queue.back();
      const std::size_t b = balls_ - place, now = gain(b, left);
      if (now == found) {
        if (now == 0) return std::vector<std::size_t>(most + 1);  // no ball reaches the rest
        chosen.push_back(b);
        rest -= now;
        for (std::size_t w = 0; w < words_; ++w) left[w] &= ~bits_[b * words_ + w];
      }
      found = now == found ? 0 : now;
      std::push_heap(queue.begin(), queue.end());
    }
    return chosen;
  }

 private:
  std::size_t gain(std::size_t b, const std::vector<std::uint64_t>& left) const {
    std::size_t covered = 0;
    for (std::size_t w = 0; w < words_; ++w)
      covered += static_cast<std::size_t>(std::popcount(bits_[b * words_ + w] & left[w]));
    return covered;
  }

  std::size_t balls_, count_, words_;
  std::vector<float> depth_;
  std::vector<std::uint64_t> bits_;
};

FloatPoints some_corners(const BallCover& cover, std::size_t wanted) {
  const std::size_t patches = cover.surface_patches(), count = std::min(patches, wanted);
  FloatPoints corners;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = i * patches / count;
    const FloatPoints& c = cover.patch_blocks().corner(i % 3);
    corners.push_back(c.x[p], c.y[p], c.z[p]);
  }
  return corners;
}

void pad(FloatPoints& points) {
  while (points.size() % lanes != 0) points.push_back(points.x[0], points.y[0], points.z[0]);
}

}  // namespace

std::vector<FloatBall> inner_balls(const BallCover& cover, float unit, std::size_t patches,
                                   Monitor& monitor) {
  FloatPoints corners = some_corners(cover, 2500 + 2 * patches);
  pad(corners);
  const std::size_t all_patches = cover.surface_patches(), tries = std::min(all_patches, patches);
  constexpr float pi = 3.14159265F;
  std::vector<FloatBall> balls;
  for (std::size_t i = 0; i < tries; ++i) {
    monitor.step(static_cast<double>(i) / static_cast<double>(tries));
    const std::size_t patch = i * all_patches / tries;
    const Corner p = middle_of(cover, patch), n = normal_of(cover, patch);
    if (n.x == 0 && n.y == 0 && n.z == 0) continue;
    for (const float sign : {1.0F, -1.0F}) {
      const Corner m{sign * n.x, sign * n.y, sign * n.z};
      const float r = free_radius(p, m, corners);
      if (!(r < 1)) continue;
      const FloatBall ball{p.x + r * m.x, p.y + r * m.y, p.z + r * m.z, r};
      float outside = 0;
      cover.point_blocks().in_ball(ball,
                                   [&](std::size_t k) { outside += static_cast<float>(cover.weights()[k]); });
      if (outside * unit < 0.5F * (4.0F / 3 * pi) * r * r * r) balls.push_back(ball);
    }
  }
  return balls;
}

std::vector<FloatBall> start_balls(const BallCover& cover, float unit, std::size_t count, Monitor& monitor) {
  const std::size_t limited = std::min<std::size_t>(count, 400);
  FloatPoints corners = some_corners(cover, 2500 + 25 * limited);
  const std::size_t different = corners.size();
  pad(corners);
  PartMonitor first(monitor, 0, 0.5);
  std::vector<FloatBall> balls = inner_balls(cover, unit, 1200 + 4 * limited, first);
  const std::size_t points = std::min<std::size_t>(different, 400);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t v = i * different / points;
    balls.push_back({corners.x[v], corners.y[v], corners.z[v], 0});
  }

  GreedyCover greedy(balls, corners, different);
  float enough = 0.01F, less = 0;
  std::vector<std::size_t> chosen = greedy.with(enough, count);
  while (chosen.size() > count) {
    less = enough;
    enough *= 2;
    chosen = greedy.with(enough, count);
  }
  for (int step = 0; step < 9; ++step) {
    monitor.step(0.5 + 0.05 * step);
    const float between = 0.5F * (less + enough);
    std::vector<std::size_t> tried = greedy.with(between, count);
    if (tried.size() > count) {
      less = between;
    } else {
      enough = between;
      chosen = std::move(tried);
    }
  }
  std::vector<FloatBall> result;
  for (const std::size_t b : chosen) {
    FloatBall ball = balls[b];
    ball.r += enough;
    result.push_back(ball);
  }
  return result;
}

}  // namespace ballflow::geometry
