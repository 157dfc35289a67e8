// A sphere of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::show {

struct Icosphere {
  std::vector<geometry::Vec3> vertices;  // of length 1: their own normals
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// An icosahedron whose triangles are cut into four `rounds` times.
Icosphere icosphere(int rounds);

}  // namespace ballflow::show
