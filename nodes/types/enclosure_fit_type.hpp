// How an EnclosureFit and BallCounts travel on edges (enclosure_fit.type.cpp).
#pragma once

#include "types/ball_counts.hpp"
#include "types/enclosure_fit.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::EnclosureFit> {
  static void declare(TypeDecl<geometry::EnclosureFit>& d);
};
template <>
struct TypeOf<geometry::BallCounts> {
  static void declare(TypeDecl<geometry::BallCounts>& d);
};

}  // namespace ballflow
