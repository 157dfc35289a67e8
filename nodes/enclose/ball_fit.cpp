#include "enclose/ball_fit.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace ballflow::geometry {
namespace {

using Direction = std::array<float, 3>;

/// Three directions at right angles, not evenly distributed and need not be.
std::array<Direction, 3> random_frame(Random& random) {
  const auto component = [&] { return static_cast<float>(random.unit()) - 0.5F; };
  Direction a{component(), component(), component()}, b{component(), component(), component()};
  const auto dot = [](const Direction& p, const Direction& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const auto unit = [&](Direction& p) {
    const float squared = dot(p, p);
    if (!(squared > 1e-6F)) return false;
    for (float& c : p) c /= std::sqrt(squared);
    return true;
  };
  const std::array<Direction, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (!unit(a)) return axes;
  const float along = dot(a, b);
  for (std::size_t k = 0; k < 3; ++k) b[k] -= along * a[k];
  if (!unit(b)) return axes;
  return {{a, b, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}}};
}

}  // namespace

void BallFit::Scene::clear(float cx, float cy, float cz, float within) {
  x = cx;
  y = cy;
  z = cz;
  reach = within;
  size = 0;
}

void BallFit::Scene::grow() {
  const std::size_t room = std::max<std::size_t>(1024, 2 * weights.size());
  for (std::vector<float>* const values : {&points.x, &points.y, &points.z, &weights}) values->resize(room);
}

void BallFit::Scene::pad() {
  while (size % lanes != 0) add(x, y, z, 0);
}

void BallFit::begin(float x, float y, float z, float reach, float width) {
  width_ = width;
  points_held_ = 0;
  held_.clear();
  whole_.clear(x, y, z, reach);
  near_.clear(x, y, z, 0);
}

void BallFit::end() {
  points_held_ = held_.size();
  if (points_held_ > 0) {
    while (held_.size() % lanes != 0) held_.push_back(held_.x[0], held_.y[0], held_.z[0]);
  }
  whole_.pad();
}

/// Looks only at points that balls within `reach` of the centre of one come near.
void BallFit::narrow(const FloatBall& ball, float reach) {
  const float moved = std::sqrt(squared_from(ball, near_.x, near_.y, near_.z));
  std::swap(near_, last_);
  const Scene& from = moved + reach <= last_.reach ? last_ : whole_;
  near_.clear(ball.x, ball.y, ball.z, reach);
  const Lanes cx = all(ball.x), cy = all(ball.y), cz = all(ball.z),
              limit = all((reach + width_) * (reach + width_));
  for (std::size_t i = 0; i < from.size; i += lanes) {
    for (unsigned in = bits(from.points.squared_from(i, cx, cy, cz) <= limit); in != 0; in &= in - 1) {
      const std::size_t n = i + static_cast<std::size_t>(std::countr_zero(in));
      near_.add(from.points.x[n], from.points.y[n], from.points.z[n], from.weights[n]);
    }
  }
  near_.pad();
}

FloatBall BallFit::around(float x, float y, float z) const {
  Lanes most = all(0);
  const Lanes cx = all(x), cy = all(y), cz = all(z);
  for (std::size_t i = 0; i < held_.size(); i += lanes)
    most = greater_of(most, held_.squared_from(i, cx, cy, cz));
  // So that squares of rounded radii are not less than the squares that they come from.
  return {x, y, z, std::sqrt(greatest(most)) * (1 + 4e-7F)};
}

float BallFit::value(const FloatBall& ball, const Scene& scene) const {
  const float from = std::sqrt(squared_from(ball, scene.x, scene.y, scene.z));
  if (!(from + ball.r <= scene.reach)) return std::numeric_limits<float>::infinity();
  const Lanes cx = all(ball.x), cy = all(ball.y), cz = all(ball.z), zero = all(0), one = all(1);
  // Half a width below the sphere all of a point counts, half a width above nothing: (r - d) ~ (r^2 - d^2) /
  // 2r.
  const float slope = 0.5F / (ball.r * width_ + std::numeric_limits<float>::min());
  const Lanes slopes = all(slope), level = all(ball.r * ball.r * slope + 0.5F);
  Lanes total = all(0);
  for (std::size_t i = 0; i < scene.size; i += lanes) {
    const Lanes share = level - slopes * scene.points.squared_from(i, cx, cy, cz);
    total += load(&scene.weights[i]) * less_of(one, greater_of(zero, share));
  }
  return sum(total);
}

float BallFit::weight_in(const FloatBall& ball) const {
  const Lanes cx = all(ball.x), cy = all(ball.y), cz = all(ball.z), limit = all(ball.r * ball.r),
              zero = all(0);
  Lanes total = all(0);
  for (std::size_t i = 0; i < whole_.size; i += lanes)
    total += whole_.points.squared_from(i, cx, cy, cz) <= limit ? load(&whole_.weights[i]) : zero;
  return sum(total);
}

float BallFit::weight_in_either(const FloatBall& a, const FloatBall& b) const {
  const Lanes zero = all(0), ra = all(a.r * a.r), rb = all(b.r * b.r);
  Lanes total = all(0);
  for (std::size_t i = 0; i < whole_.size; i += lanes) {
    const Lanes weight = load(&whole_.weights[i]);
    const auto in_a = whole_.points.squared_from(i, all(a.x), all(a.y), all(a.z)) <= ra;
    const auto in_b = whole_.points.squared_from(i, all(b.x), all(b.y), all(b.z)) <= rb;
    total += (in_a | in_b) ? weight : zero;
  }
  return sum(total);
}

FloatBall BallFit::middle() const {
  const auto half = [&](const std::vector<float>& c) {
    const auto [low, high] = std::minmax_element(c.begin(), c.end());
    return 0.5F * (*low + *high);
  };
  return around(half(held_.x), half(held_.y), half(held_.z));
}

FloatBall BallFit::search(float x, float y, float z, Random& random, float coarse, float fine) {
  FloatBall best = around(x, y, z);
  const float scale = best.r;
  for (float step = coarse; step > fine; step *= 0.5F) {
    const float limit = whole_.reach - std::sqrt(squared_from(best, whole_.x, whole_.y, whole_.z));
    narrow(best, std::min(limit, best.r + 4 * step * scale));
    float least = value(best, near_);
    const auto attempt = [&](float px, float py, float pz) {
      const FloatBall ball = around(px, py, pz);
      const float found = value(ball, near_);
      // Where nothing is wasted, the smaller ball.
      if (!(found < least || (found == least && ball.r < best.r * 0.999F))) return false;
      best = ball;
      least = found;
      return true;
    };
    for (bool better = true; better;) {
      better = false;
      for (const Direction& d : random_frame(random)) {
        for (const float sign : {1.0F, -1.0F}) {
          float along = sign * step * scale;
          bool moved = false;
          while (attempt(best.x + along * d[0], best.y + along * d[1], best.z + along * d[2])) {
            moved = true;
            along *= 1.5F;
          }
          better = better || moved;
          if (moved) break;
        }
      }
    }
  }
  return best;
}

}  // namespace ballflow::geometry
