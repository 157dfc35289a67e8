#include "prior/eigen_version.hpp"

#include <Eigen/Core>
#include <string>

namespace ballflow::geometry {

const char* eigen_version() {
  static const std::string version = std::to_string(EIGEN_WORLD_VERSION) + "." +
                                     std::to_string(EIGEN_MAJOR_VERSION) + "." +
                                     std::to_string(EIGEN_MINOR_VERSION);
  return version.c_str();
}

}  // namespace ballflow::geometry
