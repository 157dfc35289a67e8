// The weighted zero alpha-shape of a set of balls (thesis, 2.6): the dual complex of their union.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Where a simplex of the complex lies in it.
enum class SimplexClass : std::uint8_t {
  interior = 0,  // its whole star in the regular triangulation is in the complex, and finite
  regular = 1,   // neither interior nor singular
  singular = 2,  // no proper coface in the complex
};

struct SimplicialComplex {
  // The balls the complex was made of: ball i is { x : |x - centers[i]|^2 <= weights[i] }.
  Array<Vec3> centers;    // n x 3, model units
  Array<double> weights;  // n, squared model units, delta included

  // Simplices, each an ascending tuple of ball indices, each list in lexicographic order. The list is
  // closed: faces of a simplex are listed too.
  Array<std::int32_t> vertices;                   // v
  Array<std::array<std::int32_t, 2>> edges;       // e x 2
  Array<std::array<std::int32_t, 3>> triangles;   // t x 3
  Array<std::array<std::int32_t, 4>> tetrahedra;  // c x 4 (always interior)
  Array<std::uint8_t> vertex_classes;             // v, SimplexClass
  Array<std::uint8_t> edge_classes;               // e
  Array<std::uint8_t> triangle_classes;           // t

  // Added to every squared radius before anything was decided; 0 for enlarged balls (see AlphaShape).
  double delta = 0;
  std::array<std::int64_t, 3> betti{0, 0, 0};  // components, tunnels, cavities of the union

  std::int64_t euler_characteristic() const {
    return static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
           static_cast<std::int64_t>(triangles.size()) - static_cast<std::int64_t>(tetrahedra.size());
  }
};

/// Empty when the invariants above hold (closedness included), else what is wrong and where.
std::string broken_invariant(const SimplicialComplex& complex);

}  // namespace ballflow::geometry
