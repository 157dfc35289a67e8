// Four floats at a time, with the same bits on every machine: what sums and comparisons of balls run on.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

using Lanes = float __attribute__((vector_size(16)));
using LaneNumbers = std::int32_t __attribute__((vector_size(16)));  // and truth values of comparisons
inline constexpr std::size_t lanes = 4;

inline Lanes load(const float* values) {
  Lanes result;
  std::memcpy(&result, values, sizeof result);
  return result;
}
inline Lanes all(float value) { return Lanes{value, value, value, value}; }
#ifdef __SSE__
inline Lanes greater_of(Lanes a, Lanes b) { return _mm_max_ps(a, b); }  // of a and b that are numbers
inline Lanes less_of(Lanes a, Lanes b) { return _mm_min_ps(a, b); }
inline Lanes square_root(Lanes a) { return _mm_sqrt_ps(a); }
#else
inline Lanes greater_of(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes less_of(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes square_root(Lanes a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
#endif
inline float sum(Lanes a) { return (a[0] + a[2]) + (a[1] + a[3]); }
inline float greatest(Lanes a) {
  const float p = a[0] > a[2] ? a[0] : a[2], q = a[1] > a[3] ? a[1] : a[3];
  return p > q ? p : q;
}
/// Bit l is set where lane l is true.
inline unsigned bits(LaneNumbers truth) {
#ifdef __SSE__
  return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<Lanes>(truth)));
#else
  unsigned result = 0;
  for (std::size_t l = 0; l < lanes; ++l) result |= truth[l] != 0 ? 1U << l : 0U;
  return result;
#endif
}

/// Points by coordinates, n floats each.
struct FloatPoints {
  std::vector<float> x, y, z;

  std::size_t size() const { return x.size(); }
  void clear() {
    x.clear();
    y.clear();
    z.clear();
  }
  void push_back(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
  void push_back(Vec3 p) {
    push_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  }
  /// Squared distances of four of them from (cx, cy, cz).
  Lanes squared_from(std::size_t first, Lanes cx, Lanes cy, Lanes cz) const {
    const Lanes dx = load(&x[first]) - cx, dy = load(&y[first]) - cy, dz = load(&z[first]) - cz;
    return dx * dx + dy * dy + dz * dz;
  }
};

struct FloatBall {
  float x = 0, y = 0, z = 0, r = 0;
};

inline float squared_from(const FloatBall& ball, float x, float y, float z) {
  const float dx = x - ball.x, dy = y - ball.y, dz = z - ball.z;
  return dx * dx + dy * dy + dz * dz;
}
inline float center_distance(const FloatBall& a, const FloatBall& b) {
  return std::sqrt(squared_from(a, b.x, b.y, b.z));
}

}  // namespace ballflow::geometry
