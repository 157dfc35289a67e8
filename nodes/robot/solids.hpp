// Boxes, cylinders and balls as triangle meshes that contain them.
#pragma once

#include <vector>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Triangles, counter-clockwise seen from outside.
struct SolidMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// How far the meshes below stand out of round shapes at most, as a part of the radius.
constexpr double roundness = 0.004;

/// A box around the origin.
SolidMesh box_mesh(Vec3 edges);
/// A prism around the cylinder of this radius and length whose axis is z and whose middle is the origin: its
/// sides touch the cylinder from outside, up to 1e-12 of the radius. One that is inscribed would leave the
/// cylinder outside, and what encloses it need not enclose the cylinder.
SolidMesh cylinder_mesh(double radius, double length);
/// A polyhedron around the ball around the origin, whose triangles touch it from outside, likewise.
SolidMesh ball_mesh_around(double radius);

}  // namespace ballflow::geometry
