// The boundary of a union of balls as triangles between points on it, from the dual complex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/monitor.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct ExactMesh {
  TriangleMesh mesh;
  double error = 0;  // no point of a triangle is farther from the sphere that it stands for, model units
  std::int32_t rounds = 0;  // how often chords had to be bisected
};

/// Corners, arcs and patches of the boundary are those that the complex names. Nothing where the balls are
/// not in general position, up to rounding. `complex` is that of `diagram`, `extent` the size of the union in
/// model units. Throws InputError when there would be more than `most_faces`. The same bytes for any number
/// of threads.
std::optional<ExactMesh> exact_mesh(const PowerDiagram& diagram, const SimplicialComplex& complex,
                                    double error, double extent, std::int64_t most_faces, Monitor& monitor);

/// What is thrown then.
InputError too_many_faces(std::int64_t most);

}  // namespace ballflow::geometry
