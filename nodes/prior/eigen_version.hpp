#pragma once

namespace ballflow::geometry {

/// The version of Eigen that the algorithms were built with ("3.4.0"): part of the keys of nodes that use it.
const char* eigen_version();

}  // namespace ballflow::geometry
