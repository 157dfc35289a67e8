// The ball that holds given points and as little as possible of what lies outside.
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "enclose/lanes.hpp"

namespace ballflow::geometry {

/// A ball is wanted that holds all of `held`; its radius is therefore known from its centre.
class BallFit {
 public:
  /// Forgets all points. What is outside counts smoothly over `width` across the sphere; centres stay where the whole
  /// ball keeps within `reach` of (x, y, z), since only there all points to avoid are known.
  void begin(float x, float y, float z, float reach, float width);
  void hold(float x, float y, float z) { held_.push_back(x, y, z); }
  void avoid(float x, float y, float z, float weight) {
    avoided_.push_back(x, y, z);
    weights_.push_back(weight);
  }
  /// After the last point.
  void end();
  bool empty() const { return points_held_ == 0; }

  /// The least ball around a centre.
  FloatBall around(float x, float y, float z) const;
  /// The weight in a ball, of points by which side of the sphere they are on.
  float weight_in(const FloatBall& ball) const;
  float weight_in_either(const FloatBall& a, const FloatBall& b) const;
  /// Pattern search from the least ball around a centre: steps along random frames, from `coarse` to `fine` radii.
  FloatBall search(float x, float y, float z, Random& random, float coarse, float fine) const;
  /// The middle of the box of the points held: where a search may begin.
  FloatBall middle() const;

 private:
  float value(const FloatBall& ball) const;

  float x_ = 0, y_ = 0, z_ = 0, reach_ = 0, width_ = 0;
  std::size_t points_held_ = 0;
  FloatPoints held_, avoided_;
  std::vector<float> weights_;
};

}  // namespace ballflow::geometry
