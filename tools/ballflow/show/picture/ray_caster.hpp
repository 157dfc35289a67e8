// Finds what rays meet, among many bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "show/picture/intersect.hpp"

namespace ballflow::show {

/// What a body was made from: an element of a layer, or a vertex of it.
struct Origin {
  std::uint32_t layer = 0, element = 0;
};

/// Bodies are numbered: first the balls, then the capsules, then the triangles.
struct Bodies {
  std::vector<Ball> balls;
  std::vector<Capsule> capsules;
  std::vector<Triangle3> triangles;
  std::vector<Origin> origins;  // by number

  std::size_t size() const { return balls.size() + capsules.size() + triangles.size(); }
};

struct Hit {
  double t = 0;
  /// Negative where the ray begins inside a ball that a plane has cut open: the power of the point with
  /// respect to the ball. Else 0.
  double power = 0;
  std::uint32_t body = 0;
  bool leaves = false;  // the ray comes out of a ball

  /// By distance; on a cut the ball with the smallest power is seen, so that power cells show. No two hits of
  /// a ray are equal, so what is in front never depends on the order in which bodies are looked at.
  friend auto operator<=>(const Hit&, const Hit&) = default;
};

/// Thread-safe once constructed. Embree finds the bodies that a ray may meet; intersections and order are
/// computed here, so the result depends neither on the instructions of the machine nor on threads.
class RayCaster {
 public:
  /// Coordinates must be at most about 100 in magnitude. Throws Cancelled, and std::bad_alloc.
  RayCaster(Bodies bodies, geometry::Monitor& monitor);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Bodies& bodies() const;

  /// The first body that the ray enters within the interval, or that it is inside of at its beginning.
  std::optional<Hit> nearest(const Ray& ray, Interval interval) const;

  /// True when the ray enters a body within the interval.
  bool blocked(const Ray& ray, Interval interval) const;

  /// All hits within the interval, in order: balls when the ray enters and when it leaves them, capsules and
  /// triangles once. `hits` is overwritten.
  void all(const Ray& ray, Interval interval, std::vector<Hit>& hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballflow::show
