// Pieces that several text formats share.
#pragma once

#include "ballflow/output_file.hpp"
#include "base/vec3.hpp"

namespace ballflow {

/// "x y z" with `separator` between the numbers and nothing after them.
inline void text(OutputFile& out, geometry::Vec3 p, char separator = ' ') {
  out << p.x << separator << p.y << separator << p.z;
}

}  // namespace ballflow
