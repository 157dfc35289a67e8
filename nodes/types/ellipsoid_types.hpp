// Ellipsoids and scalings as types of artifacts: for those who take or show them.
#pragma once

#include "types/ellipsoids.hpp"
#include "types/scaling.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::Ellipsoids> {
  static void declare(TypeDecl<geometry::Ellipsoids>& d);
};

template <>
struct TypeOf<geometry::Scaling> {
  static void declare(TypeDecl<geometry::Scaling>& d);
};

}  // namespace ballflow
