// Poses of shapes and what statistics of shapes are made of, as types of artifacts: for those who take or
// show them.
#pragma once

#include "types/matched_balls.hpp"
#include "types/shape_pose.hpp"
#include "types/type_of.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::MatchedBalls> {
  static void declare(TypeDecl<geometry::MatchedBalls>& d);
};

template <>
struct TypeOf<geometry::ShapePose> {
  static void declare(TypeDecl<geometry::ShapePose>& d);
};

}  // namespace ballflow
