#include "types/shape_pose.hpp"

#include <array>

#include "types/prior_types.hpp"

namespace ballflow {

void TypeOf<geometry::ShapePose>::declare(TypeDecl<geometry::ShapePose>& d) {
  using T = geometry::ShapePose;
  d.id("ShapePose", 1).doc("A similarity transform that lays one shape on another, and how sure it is.");
  d.scalar("rotation", &T::rotation).doc("3 x 3 by rows; determinant +1, or -1 where it mirrors");
  d.scalar("scale", &T::scale).doc("above 0; 1 of a rigid transform");
  d.scalar("translation", &T::translation).doc("added last, model units of the target");
  d.scalar("forward", &T::forward)
      .doc("root mean square distance from what was moved to the target, trimmed, model units");
  d.scalar("backward", &T::backward).doc("the same the other way; 0 where only a part was moved");
  d.scalar("diagonal", &T::diagonal).doc("of the bounding box of the target, model units");
  d.scalar("second_best", &T::second_best)
      .doc("residual of the second best pose by that of this one; 1: ambiguous; 0: there is no other");
  d.scalar("mirror_image", &T::mirror_image)
      .doc("residual of the best mirroring pose by that of this one; 0: not looked for");
  d.scalar("starts", &T::starts).doc("poses that the search began from; 0: none, the transform was given");
  d.scalar("similarity", &T::similarity).doc("1: the scale was free");
  d.scalar("mirrored", &T::mirrored).doc("1: the transform mirrors");
  d.summary("rotation", "by rows")
      .summary("scale", "factor")
      .summary("translation", "[x, y, z], model units");
  d.summary("degrees", "angle of the rotation, degrees; null where it mirrors");
  d.summary("residual", "[forward, backward] root mean square, model units");
  d.summary("relative_residual", "root of the sum of their squares, as part of the target's diagonal");
  d.summary("second_best", "residual of the second best pose by that of this one; null: there is no other");
  d.summary("mirror_image", "residual of the best mirroring pose by that of this one; null: not looked for");
  d.summary("starts", "poses that the search began from")
      .summary("mirrored", "whether the transform mirrors");
  d.summarize([](const T& v) {
    const auto known = [](double x) { return x == 0 ? SummaryValue(nullptr) : SummaryValue(x); };
    return Summary{{"rotation", v.rotation},
                   {"scale", v.scale},
                   {"translation", std::array{v.translation.x, v.translation.y, v.translation.z}},
                   {"degrees", v.mirrored != 0 ? SummaryValue(nullptr)
                                               : SummaryValue(geometry::degrees_between(v, T{}))},
                   {"residual", std::array{v.forward, v.backward}},
                   {"relative_residual", geometry::relative_residual(v)},
                   {"second_best", known(v.second_best)},
                   {"mirror_image", known(v.mirror_image)},
                   {"starts", static_cast<std::int64_t>(v.starts)},
                   {"mirrored", v.mirrored != 0}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
