// k balls that contain a surface and everything inside it, with little volume outside.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class EncloseEffort {
  low,     // no rounds of shifts and swaps
  normal,  // one
  high,    // four
};

struct EncloseBallsOptions {
  std::int64_t balls = 20;
  EncloseEffort effort = EncloseEffort::normal;
  std::int64_t seed = 1;
};

struct EnclosingBalls {
  Balls balls;
  double solid = 0;    // volume inside the surface, about; cubed model units
  double outside = 0;  // volume of the union outside of it, about
};

EnclosingBalls enclose_balls(const TriangleMesh& mesh, const EncloseBallsOptions& options, const Balls* start = nullptr,
                             Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
