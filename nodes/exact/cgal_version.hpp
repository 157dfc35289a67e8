#pragma once

namespace ballflow::geometry {

/// The version of CGAL that the algorithms were built with ("5.5.1"): part of the keys of nodes that use it.
const char* cgal_version();

}  // namespace ballflow::geometry
