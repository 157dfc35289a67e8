// Pieces that several text formats share.
#pragma once

#include "base/vec3.hpp"
#include "export/output_file.hpp"

namespace ballflow {

/// "x y z" with `separator` between the numbers and nothing after them.
inline void text(OutputFile& out, geometry::Vec3 p, char separator = ' ') {
  out << p.x << separator << p.y << separator << p.z;
}

}  // namespace ballflow
