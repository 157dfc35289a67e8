#include "measure/boundary_samples.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t faces = 8;  // of the octahedron that a sphere is split from

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

/// Splits the faces of one sphere. A part is compared with the balls alone that reach into the part it was
/// split from.
class SphereSampler {
 public:
  SphereSampler(const BallUnion& all, double spacing, double tolerance, Budget& budget, Monitor& monitor,
                std::size_t ball)
      : all_(all),
        spacing_(spacing),
        tolerance_(tolerance),
        budget_(budget),
        look_(monitor),
        ball_(ball),
        center_(all.balls().centers[ball]),
        radius_(all.balls().radii[ball]) {
    if (radius_ == 0) return;
    const Balls& balls = all.balls();
    all.for_neighbours(ball, [&](std::size_t j) {
      // A ball inside this one takes nothing of its sphere. There may be thousands, also equal ones.
      const double between = distance(center_, balls.centers[j]);
      if (j == ball || between + balls.radii[j] <= radius_ + tolerance_ / 2) return;
      near_.push_back({balls.centers[j], balls.radii[j]});
    });
  }

  std::size_t ball() const { return ball_; }

  /// Appends the samples of a face. A ball of radius 0 has one sample, on face 0.
  void sample(std::size_t face, BoundarySamples& samples) {
    samples_ = &samples;
    if (radius_ == 0) {
      if (face != 0) return;
      const double depth = all_.depth(center_, -tolerance_, ball_);
      if (depth >= -tolerance_) {
        ++unpaid_;
        add(center_, 0, depth);
      }
    } else {
      const auto sign = [face](std::size_t bit) { return (face & bit) != 0 ? 1.0 : -1.0; };
      split({sign(4), 0, 0}, {0, sign(2), 0}, {0, 0, sign(1)}, 0.5, 0, near_.size());
    }
    budget_.spend(unpaid_);
    unpaid_ = 0;
  }

 private:
  struct Near {
    Vec3 center;
    double radius;
  };

  /// A triangle of a face |x| + |y| + |z| = 1, which is seen from the centre under about the angle
  /// weight / |centroid|^3. The balls that may contain some of it are in near_[first .. last), the end of
  /// near_.
  void split(Vec3 a, Vec3 b, Vec3 c, double weight, std::size_t first, std::size_t last) {
    look_(64);
    const Vec3 centroid = (1.0 / 3) * (a + b + c), direction = unit(centroid);
    const double reach = radius_ * std::max({distance(unit(a), direction), distance(unit(b), direction),
                                             distance(unit(c), direction)});
    const Vec3 position = center_ + radius_ * direction;
    const double deep = -reach - tolerance_;
    // Where thousands of balls nearly agree, no list gets shorter: the tree of all balls is then faster.
    const bool large = weight > 0.5 / 64;
    double depth = infinity;
    if (large || last - first <= 256) {
      look_(last - first);
      for (std::size_t k = first; k < last; ++k) {
        const Near other = near_[k];
        const double d = distance(position, other.center) - other.radius;
        depth = std::min(depth, d);
        if (depth < deep) break;  // so the whole part is inside that ball
        if (d < reach + tolerance_) near_.push_back(other);
      }
      first = last;
    } else {
      depth = all_.depth(position, deep, ball_);
    }
    const std::size_t end = near_.size();
    if (depth >= deep) {
      // Paid for in portions: the budget is one number for all threads.
      if (++unpaid_ == 256) {
        budget_.spend(unpaid_);
        unpaid_ = 0;
      }
      if (reach <= spacing_) {
        const double norm = length(centroid);
        add(position, radius_ * radius_ * weight / (norm * norm * norm), depth);
      } else {
        const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        split(a, ab, ca, weight / 4, first, end);
        split(ab, b, bc, weight / 4, first, end);
        split(ca, bc, c, weight / 4, first, end);
        split(ab, bc, ca, weight / 4, first, end);
      }
    }
    near_.resize(last);
  }

  void add(Vec3 position, double area, double depth) {
    samples_->positions.push_back(position);
    samples_->areas.push_back(area);
    samples_->on_boundary.push_back(depth >= -tolerance_ ? 1 : 0);
  }

  const BallUnion& all_;
  double spacing_, tolerance_;
  Budget& budget_;
  Lookout look_;
  std::size_t ball_;
  Vec3 center_;
  double radius_;
  std::vector<Near> near_;  // a stack: the lists of all parts from the sphere to the one that is split
  BoundarySamples* samples_ = nullptr;
  std::int64_t unpaid_ = 0;
};

}  // namespace

BoundarySamples boundary_samples(const BallUnion& all, double spacing, double tolerance, Budget& budget,
                                 Monitor& monitor) {
  // Faces of few balls are shared out one by one, those of many balls ball by ball.
  const std::size_t count = faces * all.balls().size();
  const std::size_t block =
      count < 64 * faces ? 1 : faces * std::clamp<std::size_t>(count / faces / 256, 1, 64);
  const auto parts = by_blocks<BoundarySamples>(
      count, block, monitor, [&](std::size_t first, std::size_t last, BoundarySamples& part) {
        while (first < last) {
          SphereSampler sampler(all, spacing, tolerance, budget, monitor, first / faces);
          for (; first < last && first / faces == sampler.ball(); ++first)
            sampler.sample(first % faces, part);
        }
      });
  std::size_t size = 0;
  for (const BoundarySamples& part : parts) size += part.size();
  BoundarySamples samples;
  samples.positions.reserve(size);
  samples.areas.reserve(size);
  samples.on_boundary.reserve(size);
  for (const BoundarySamples& part : parts) {
    samples.positions.insert(samples.positions.end(), part.positions.begin(), part.positions.end());
    samples.areas.insert(samples.areas.end(), part.areas.begin(), part.areas.end());
    samples.on_boundary.insert(samples.on_boundary.end(), part.on_boundary.begin(), part.on_boundary.end());
  }
  return samples;
}

}  // namespace ballflow::geometry
