#include "enclose/soft_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ballflow::geometry {
namespace {

/// Of x, y, z, r.
using Gradient = std::array<float, 4>;

struct Nearby {
  std::int32_t ball;
  float least, most;  // depth of a point of the block in the ball, at the least and at the most
};

/// Balls that a point of the block may be deepest in; none where all of them are shallower than `floor`.
void deepest_in(const FloatPoints& lower, const FloatPoints& upper, std::size_t b, const std::vector<FloatBall>& balls,
                float floor, std::vector<Nearby>& found) {
  found.clear();
  float best = floor;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const FloatBall& ball = balls[i];
    const auto near = [](float low, float high, float c) { return std::max(0.0F, std::max(low - c, c - high)); };
    const auto far = [](float low, float high, float c) { return std::max(c - low, high - c); };
    const float nx = near(lower.x[b], upper.x[b], ball.x), ny = near(lower.y[b], upper.y[b], ball.y),
                nz = near(lower.z[b], upper.z[b], ball.z);
    const float squared = nx * nx + ny * ny + nz * nz;
    const float gap = ball.r - best;
    if (gap < 0 || squared > gap * gap) continue;
    const float fx = far(lower.x[b], upper.x[b], ball.x), fy = far(lower.y[b], upper.y[b], ball.y),
                fz = far(lower.z[b], upper.z[b], ball.z);
    const float least = ball.r - std::sqrt(fx * fx + fy * fy + fz * fz);
    best = std::max(best, least);
    found.push_back({static_cast<std::int32_t>(i), least, ball.r - std::sqrt(squared)});
  }
  std::erase_if(found, [&](const Nearby& n) { return n.most < best; });
}

/// Adds weight * d(depth) of points whose deepest ball is `ball`, at the distance d from its centre.
void add(Gradient& gradient, const FloatBall& ball, float x, float y, float z, float distance, float weight) {
  const float scaled = weight / std::max(distance, 1e-9F);
  gradient[0] += scaled * (x - ball.x);
  gradient[1] += scaled * (y - ball.y);
  gradient[2] += scaled * (z - ball.z);
  gradient[3] += weight;
}

class Descent {
 public:
  Descent(const BallCover& cover, const std::vector<float>& areas, float unit, const SoftDescentOptions& options)
      : cover_(cover), options_(options), unit_(unit), width_(options.width * cover.spacing()), areas_(areas) {
    vertices_.build({cover.vertex_points()});
    areas_.resize(vertices_.corner(0).size(), 0);
    for (const std::int32_t w : cover.weights()) weights_.push_back(static_cast<float>(w));
    weights_.resize(cover.point_blocks().corner(0).size(), 0);
  }

  std::vector<Gradient> gradients(const std::vector<FloatBall>& balls, float price) {
    std::vector<Gradient> result(balls.size(), Gradient{});
    // Points outside: within the width of the sphere they count more the deeper they are.
    collect(cover_.point_blocks(), balls, -width_, [&](std::size_t i, float depth, std::int32_t b, float distance) {
      if (!(depth < width_)) return;
      const FloatPoints& p = cover_.point_blocks().corner(0);
      add(result[static_cast<std::size_t>(b)], balls[static_cast<std::size_t>(b)], p.x[i], p.y[i], p.z[i], distance,
          weights_[i] * unit_ / (2 * width_));
    }, width_);
    // Vertices: what is not covered costs.
    collect(vertices_, balls, -std::numeric_limits<float>::max(), [&](std::size_t i, float depth, std::int32_t b, float distance) {
      if (!(depth < 0)) return;
      const FloatPoints& p = vertices_.corner(0);
      add(result[static_cast<std::size_t>(b)], balls[static_cast<std::size_t>(b)], p.x[i], p.y[i], p.z[i], distance,
          -price * areas_[i]);
    }, 0);
    return result;
  }

 private:
  /// Calls visit(point, depth, ball, distance) for the points of blocks, with the ball they are deepest in; blocks
  /// that are deeper than `deep` in one ball are left out.
  template <class Visit>
  void collect(const PointBlocks& blocks, const std::vector<FloatBall>& balls, float floor, Visit visit, float deep) {
    constexpr std::size_t block = PointBlocks::block;
    std::array<float, block> depth{}, distance{};
    std::array<std::int32_t, block> ball{};
    const FloatPoints& points = blocks.corner(0);
    for (std::size_t b = 0; b * block < blocks.size(); ++b) {
      deepest_in(blocks.lower(), blocks.upper(), b, balls, floor, near_);
      if (near_.empty()) continue;
      if (std::any_of(near_.begin(), near_.end(), [&](const Nearby& n) { return n.least > deep; })) continue;
      depth.fill(-std::numeric_limits<float>::max());
      for (const Nearby& n : near_) {
        const FloatBall& other = balls[static_cast<std::size_t>(n.ball)];
        for (std::size_t i = 0; i < block; i += lanes) {
          const Lanes away = square_root(points.squared_from(b * block + i, all(other.x), all(other.y), all(other.z)));
          const Lanes in = all(other.r) - away;
          for (std::size_t l = 0; l < lanes; ++l) {
            if (in[l] > depth[i + l]) {
              depth[i + l] = in[l];
              distance[i + l] = away[l];
              ball[i + l] = n.ball;
            }
          }
        }
      }
      for (std::size_t i = 0; i < std::min(block, blocks.size() - b * block); ++i) {
        if (depth[i] > floor) visit(b * block + i, depth[i], ball[i], distance[i]);
      }
    }
  }

  const BallCover& cover_;
  SoftDescentOptions options_;
  float unit_, width_;
  PointBlocks vertices_;
  std::vector<float> areas_, weights_;
  std::vector<Nearby> near_;
};

}  // namespace

std::vector<FloatBall> soft_descent(const BallCover& cover, const std::vector<float>& areas, float unit,
                                    std::vector<FloatBall> balls, const SoftDescentOptions& options,
                                    Monitor& monitor) {
  if (balls.empty()) return balls;
  Descent descent(cover, areas, unit, options);
  float mean = 0;
  for (const FloatBall& ball : balls) mean += ball.r / static_cast<float>(balls.size());
  constexpr float memory = 0.9F, square_memory = 0.99F;
  std::vector<Gradient> first(balls.size(), Gradient{}), second(balls.size(), Gradient{});
  float first_left = 1, second_left = 1;  // memory^step
  for (int step = 0; step < options.steps; ++step) {
    monitor.step(static_cast<double>(step) / options.steps);
    const float t = static_cast<float>(step) / static_cast<float>(options.steps);
    const float price = options.first_price + t * (options.last_price - options.first_price);
    const float rate = mean * (options.first_rate + t * (options.last_rate - options.first_rate));
    first_left *= memory;
    second_left *= square_memory;
    const std::vector<Gradient> gradients = descent.gradients(balls, price);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      std::array<float*, 4> values{&balls[i].x, &balls[i].y, &balls[i].z, &balls[i].r};
      for (std::size_t k = 0; k < 4; ++k) {
        const float g = gradients[i][k];
        first[i][k] = memory * first[i][k] + (1 - memory) * g;
        second[i][k] = square_memory * second[i][k] + (1 - square_memory) * g * g;
        const float direction = first[i][k] / (1 - first_left), size = std::sqrt(second[i][k] / (1 - second_left));
        *values[k] -= rate * direction / (size + 1e-12F);
      }
      balls[i].r = std::max(balls[i].r, 0.0F);
    }
  }
  return balls;
}

}  // namespace ballflow::geometry
