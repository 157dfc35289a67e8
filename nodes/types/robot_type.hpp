// How robots and their balls travel on edges (robot.type.cpp).
#pragma once

#include "types/robot.hpp"
#include "types/robot_spheres.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::Robot> {
  static void declare(TypeDecl<geometry::Robot>& d);
};

template <>
struct TypeOf<geometry::RobotSpheres> {
  static void declare(TypeDecl<geometry::RobotSpheres>& d);
};

}  // namespace ballflow
