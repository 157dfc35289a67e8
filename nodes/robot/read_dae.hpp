// Collada files.
#pragma once

#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "robot/solids.hpp"

namespace ballflow::geometry {

/// The triangles of all meshes of a Collada file where its scene has them, in metres: the unit of the file is
/// applied. The up axis that it names is not, as robot programs do it: files say Y_UP and mean the frame of
/// their link.
///
/// Coordinates are those of the file rounded to single precision. Faces of two corners and less are left out,
/// polygons are triangulated. Throws InputError for content that is no Collada, has no triangle, or
/// coordinates that are not finite.
SolidMesh read_dae(std::string_view content, const std::string& file, Monitor& monitor = no_monitor());

/// "5.2", of the library that reads it.
std::string dae_library_version();

}  // namespace ballflow::geometry
