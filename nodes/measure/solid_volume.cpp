#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "measure/union_measure.hpp"
#include "search/generic_frame.hpp"
#include "search/lattice_lines.hpp"
#include "search/shells.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

/// The volume of what the surface winds around over the integral of how often it does, on lines along three
/// axes: 1 where that is once everywhere, whatever the lines miss.
double share_of_volume(const TriangleMesh& mesh, const SurfaceChain& chain, Monitor& monitor) {
  const GenericFrame frame(mesh.vertices.span());
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vec3 p : mesh.vertices) vertices.push_back(frame.into(p));
  constexpr double lines_along_edge = 256;
  const Box box = bounding_box(vertices);
  const Lattice lattice(box, box.longest_edge() / lines_along_edge);
  Lookout look(monitor);
  double once = 0, repeated = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<Crossing> crossings = crossings_along(axis, lattice, vertices, chain.triangles, look);
    int winding = 0;
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      if (c > 0 && crossings[c].line == crossings[c - 1].line) {
        const double length = crossings[c].at - crossings[c - 1].at;
        if (winding != 0) once += length;
        repeated += std::abs(winding) * length;
      } else {
        winding = 0;
      }
      winding += crossings[c].sign;
    }
  }
  return repeated > 0 ? once / repeated : 1;
}

}  // namespace

std::optional<SolidVolume> compare_volume(const MassProperties& of_union, const TriangleMesh& solid,
                                          const SolidVolumeOptions& options, Monitor& monitor) {
  if (solid.triangles.empty()) return std::nullopt;
  const WindingNumber winding(solid, monitor);
  if (!winding.chain().closed()) return std::nullopt;
  SolidVolume result;
  result.volume = winding.enclosed_volume();
  if (!(result.volume > 0)) return std::nullopt;
  const double share = share_of_volume(solid, winding.chain(), monitor);
  if (share < 1 - 1e-9) {
    // Shells in each other have a formula, which is wrong where they cross.
    constexpr double agree = 0.005;
    const double counted = share * result.volume;
    const double formula = winding.chain().nonmanifold_edges == 0
                               ? shells_of({solid.vertices, winding.chain().triangles}, monitor).volume()
                               : 0;
    result.exact = std::abs(formula - counted) <= agree * counted;
    result.volume = result.exact ? formula : counted;
  }
  result.error = (of_union.volume - result.volume) / result.volume;
  if (std::abs(result.error) * 100 > options.tolerance) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "the union of the balls has %.3g times the volume of the solid (%.4g instead of %.4g): grow the "
        "balls less (epsilon), or sample more densely (delta)",
        of_union.volume / result.volume, of_union.volume, result.volume);
    result.warning = text;
  }
  return result;
}

}  // namespace ballflow::geometry
