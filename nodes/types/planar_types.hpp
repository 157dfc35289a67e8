// Shapes in the plane as types of artifacts: for those who take or show them.
#pragma once

#include "types/disc_outline.hpp"
#include "types/outline_comparison.hpp"
#include "types/polygon2.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::Polygon2> {
  static void declare(TypeDecl<geometry::Polygon2>& d);
};

template <>
struct TypeOf<geometry::DiscOutline> {
  static void declare(TypeDecl<geometry::DiscOutline>& d);
};

template <>
struct TypeOf<geometry::OutlineComparison> {
  static void declare(TypeDecl<geometry::OutlineComparison>& d);
};

}  // namespace ballflow
