#include <cmath>
#include <cstdio>

#include "measure/union_measure.hpp"
#include "search/shells.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {

std::optional<SolidVolume> compare_volume(const MassProperties& of_union, const TriangleMesh& solid,
                                          const SolidVolumeOptions& options, Monitor& monitor) {
  if (solid.triangles.empty()) return std::nullopt;
  const WindingNumber winding(solid, monitor);
  if (!winding.chain().closed()) return std::nullopt;
  SolidVolume result;
  // What shells wind around twice counts once where every edge has two triangles.
  result.volume = winding.chain().nonmanifold_edges == 0
                      ? shells_of({solid.vertices, winding.chain().triangles}, monitor).volume()
                      : winding.enclosed_volume();
  if (!(result.volume > 0)) return std::nullopt;
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
