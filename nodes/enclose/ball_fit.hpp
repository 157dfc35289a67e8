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
  /// Forgets all points. What is outside counts smoothly over `width` across the sphere; centres stay where
  /// the whole ball keeps within `reach` of (x, y, z), since only there all points to avoid are known.
  void begin(float x, float y, float z, float reach, float width);
  void hold(float x, float y, float z) { held_.push_back(x, y, z); }
  void avoid(float x, float y, float z, float weight) { whole_.add(x, y, z, weight); }
  /// After the last point.
  void end();
  bool empty() const { return points_held_ == 0; }

  /// The least ball around a centre.
  FloatBall around(float x, float y, float z) const;
  /// The weight in a ball, of points by which side of the sphere they are on.
  float weight_in(const FloatBall& ball) const;
  float weight_in_either(const FloatBall& a, const FloatBall& b) const;
  /// Pattern search from the least ball around a centre: steps along random frames, from `coarse` to `fine`
  /// radii.
  FloatBall search(float x, float y, float z, Random& random, float coarse, float fine);
  /// The middle of the box of the points held: where a search may begin.
  FloatBall middle() const;

 private:
  /// What may be avoided by balls that keep within a distance of a centre.
  struct Scene {
    float x = 0, y = 0, z = 0, reach = 0;
    std::size_t size = 0;  // of the arrays, which only grow
    FloatPoints points;
    std::vector<float> weights;

    void clear(float cx, float cy, float cz, float within);
    void add(float px, float py, float pz, float weight) {
      if (size == weights.size()) grow();
      points.x[size] = px;
      points.y[size] = py;
      points.z[size] = pz;
      weights[size++] = weight;
    }
    void grow();
    void pad();
  };

  float value(const FloatBall& ball, const Scene& scene) const;
  void narrow(const FloatBall& ball, float reach);

  float width_ = 0;
  std::size_t points_held_ = 0;
  FloatPoints held_;
  Scene whole_, near_, last_;
};

}  // namespace ballflow::geometry
