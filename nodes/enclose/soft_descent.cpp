#include "enclose/soft_descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ballflow::geometry {
namespace {

/// Of x, y, z, r.
using Gradient = std::array<float, 4>;

/// Balls by coordinates, padded with ones that hold nothing.
struct FloatBalls {
  FloatPoints centers;
  std::vector<float> radii;

  explicit FloatBalls(const std::vector<FloatBall>& balls) {
    for (const FloatBall& ball : balls) add(ball);
    while (radii.size() % lanes != 0) add({0, 0, 0, -1e9F});
  }
  void add(const FloatBall& ball) {
    centers.push_back(ball.x, ball.y, ball.z);
    radii.push_back(ball.r);
  }
};

/// Which balls points of a block may be deepest in.
class Nearby {
 public:
  /// Balls in which some point may be deeper than `floor` and deepest. Returns the depth that every point has
  /// in one of them, at least; `floor` where that is not more.
  float find(const FloatPoints& lower, const FloatPoints& upper, std::size_t b, const FloatBalls& balls,
             float floor) {
    const Lanes lx = all(lower.x[b]), ly = all(lower.y[b]), lz = all(lower.z[b]), ux = all(upper.x[b]),
                uy = all(upper.y[b]), uz = all(upper.z[b]), zero = all(0);
    most_.resize(balls.radii.size());
    Lanes sure = all(floor);
    for (std::size_t i = 0; i < balls.radii.size(); i += lanes) {
      const Lanes x = load(&balls.centers.x[i]), y = load(&balls.centers.y[i]), z = load(&balls.centers.z[i]),
                  r = load(&balls.radii[i]);
      const auto length = [](Lanes dx, Lanes dy, Lanes dz) {
        return square_root(dx * dx + dy * dy + dz * dz);
      };
      const auto gap = [&](Lanes low, Lanes high, Lanes c) {
        return greater_of(zero, greater_of(low - c, c - high));
      };
      const auto span = [&](Lanes low, Lanes high, Lanes c) { return greater_of(c - low, high - c); };
      const Lanes near = length(gap(lx, ux, x), gap(ly, uy, y), gap(lz, uz, z));
      const Lanes far = length(span(lx, ux, x), span(ly, uy, y), span(lz, uz, z));
      sure = greater_of(sure, r - far);
      const Lanes most = r - near;
      std::memcpy(&most_[i], &most, sizeof most);
    }
    const float best = greatest(sure);
    balls_.clear();
    for (std::size_t i = 0; i < most_.size(); ++i) {
      if (most_[i] >= best && balls.radii[i] >= 0) balls_.push_back(static_cast<std::int32_t>(i));
    }
    return best;
  }
  const std::vector<std::int32_t>& balls() const { return balls_; }

 private:
  std::vector<float> most_;
  std::vector<std::int32_t> balls_;
};

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
  Descent(const BallCover& cover, const std::vector<float>& areas, float unit,
          const SoftDescentOptions& options)
      : cover_(cover),
        options_(options),
        unit_(unit),
        width_(options.width * cover.spacing()),
        areas_(areas) {
    vertices_.build({cover.vertex_points()});
    areas_.resize(vertices_.corner(0).size(), 0);
    for (const std::int32_t w : cover.weights()) weights_.push_back(static_cast<float>(w));
    weights_.resize(cover.point_blocks().corner(0).size(), 0);
  }

  std::vector<Gradient> gradients(const std::vector<FloatBall>& balls, float price) {
    std::vector<Gradient> result(balls.size(), Gradient{});
    // Points outside: within the width of the sphere they count more the deeper they are.
    collect(
        cover_.point_blocks(), balls, -width_,
        [&](std::size_t i, float depth, std::int32_t b, float distance) {
          if (!(depth < width_)) return;
          const FloatPoints& p = cover_.point_blocks().corner(0);
          add(result[static_cast<std::size_t>(b)], balls[static_cast<std::size_t>(b)], p.x[i], p.y[i], p.z[i],
              distance, weights_[i] * unit_ / (2 * width_));
        },
        width_);
    // Vertices: what is not covered costs.
    collect(
        vertices_, balls, -std::numeric_limits<float>::max(),
        [&](std::size_t i, float depth, std::int32_t b, float distance) {
          if (!(depth < 0)) return;
          const FloatPoints& p = vertices_.corner(0);
          add(result[static_cast<std::size_t>(b)], balls[static_cast<std::size_t>(b)], p.x[i], p.y[i], p.z[i],
              distance, -price * areas_[i]);
        },
        0);
    return result;
  }

 private:
  /// Calls visit(point, depth, ball, distance) for the points of blocks, with the ball they are deepest in;
  /// blocks that are deeper than `deep` in one ball are left out.
  template <class Visit>
  void collect(const PointBlocks& blocks, const std::vector<FloatBall>& balls, float floor, Visit visit,
               float deep) {
    constexpr std::size_t block = PointBlocks::block;
    const FloatBalls all_balls(balls);
    const FloatPoints& points = blocks.corner(0);
    for (std::size_t b = 0; b * block < blocks.size(); ++b) {
      if (near_.find(blocks.lower(), blocks.upper(), b, all_balls, floor) > deep || near_.balls().empty())
        continue;
      for (std::size_t i = b * block; i < std::min((b + 1) * block, blocks.size()); i += lanes) {
        Lanes depth = all(-std::numeric_limits<float>::max()), distance = all(0);
        LaneNumbers ball{};
        for (const std::int32_t n : near_.balls()) {
          const FloatBall& other = balls[static_cast<std::size_t>(n)];
          const Lanes away = square_root(points.squared_from(i, all(other.x), all(other.y), all(other.z)));
          const Lanes in = all(other.r) - away;
          const LaneNumbers deeper = in > depth, name{n, n, n, n};
          depth = deeper ? in : depth;
          distance = deeper ? away : distance;
          ball = deeper ? name : ball;
        }
        for (std::size_t l = 0; l < lanes && i + l < blocks.size(); ++l) {
          if (depth[l] > floor) visit(i + l, depth[l], ball[l], distance[l]);
        }
      }
    }
  }

  const BallCover& cover_;
  SoftDescentOptions options_;
  float unit_, width_;
  PointBlocks vertices_;
  std::vector<float> areas_, weights_;
  Nearby near_;
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
        const float direction = first[i][k] / (1 - first_left),
                    size = std::sqrt(second[i][k] / (1 - second_left));
        *values[k] -= rate * direction / (size + 1e-12F);
      }
      balls[i].r = std::max(balls[i].r, 0.0F);
    }
  }
  return balls;
}

}  // namespace ballflow::geometry
