// How an Enclosure travels on edges (enclosure.type.cpp).
#pragma once

#include "types/enclosure.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::Enclosure> {
  static void declare(TypeDecl<geometry::Enclosure>& d);
};

}  // namespace ballflow
