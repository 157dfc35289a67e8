// The edges of a power diagram outside of the union, as a net of ways.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "power/voids.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

class FreeSkeleton {
 public:
  /// Keeps references. `voids` is of the diagram.
  FreeSkeleton(const PowerDiagram& diagram, const Voids& voids, Monitor& monitor);

  /// A polyline of edges of the diagram, outside of the union but for rounding, from a place near `start` to
  /// one near `goal`, with both at its ends. Both lie in the component of this number. Short, and the same on
  /// every machine.
  std::vector<Vec3> way(Vec3 start, Vec3 goal, std::int32_t component) const;

 private:
  struct Landing;
  Landing land(Vec3 from, std::int32_t component) const;
  Vec3 at_sphere(Vec3 from, Vec3 direction) const;
  Vec3 on_sphere(Vec3 p) const;
  bool beyond(Vec3 p) const { return !(distance(p, middle_) < far_); }
  Vec3 outward(std::size_t cell, std::size_t facet) const;
  std::vector<Vec3> around(Vec3 from, Vec3 to) const;

  const PowerDiagram& diagram_;
  const Voids& voids_;
  Monitor& monitor_;
  std::vector<Vec3> vertices_;  // of the power diagram, one per cell; of infinite cells unused
  Vec3 middle_;
  double far_ = 1;  // a sphere of this radius around the middle, and everything outside, is free
};

}  // namespace ballflow::geometry
