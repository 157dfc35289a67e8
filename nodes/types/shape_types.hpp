// Models of shapes and fits of them as types of artifacts: for those who make, take or show them.
#pragma once

#include "types/shape_fit.hpp"
#include "types/shape_prior.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::ShapePrior> {
  static void declare(TypeDecl<geometry::ShapePrior>& d);
};

template <>
struct TypeOf<geometry::ShapeFit> {
  static void declare(TypeDecl<geometry::ShapeFit>& d);
};

}  // namespace ballflow
