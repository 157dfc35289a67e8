// The surface of a cube with a ball taken out.
#pragma once

#include <cstdint>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The cube [-1, 1]^3 less the open ball of radius r around the origin, 1 < r < sqrt(2): the frame of its
/// edges, of genus 5, with sharp edges. About n vertices, on the surface up to rounding; outward oriented,
/// closed and manifold.
TriangleMesh frame_mesh(double r, std::int64_t n);

}  // namespace ballflow::geometry
