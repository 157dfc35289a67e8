// Distances and ways as types of artifacts: for those who take or show them.
#pragma once

#include "types/ball_distance.hpp"
#include "types/path.hpp"
#include "types/type_of.hpp"
#include "types/way.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::BallDistance> {
  static void declare(TypeDecl<geometry::BallDistance>& d);
};

template <>
struct TypeOf<geometry::Path> {
  static void declare(TypeDecl<geometry::Path>& d);
};

template <>
struct TypeOf<geometry::Way> {
  static void declare(TypeDecl<geometry::Way>& d);
};

}  // namespace ballflow
