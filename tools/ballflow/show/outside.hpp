// Where balls leave a surface out, to be looked at.
#pragma once

#include "show/scene.hpp"

namespace ballflow::show {

/// A surface in two layers of triangles: "mesh", what is in balls, and "not covered", what is in none.
struct SplitSurface {
  Layer inside, outside;
};

/// Bisects triangles at their longest edge until a part is in one ball, meets none, or is at most `fineness`
/// long (at least a thousandth of the longest edge of the surface's box); then its middle decides. That is
/// for the eye, VerifyEnclosure proves. Where both layers go with frames, a surface is covered by the balls
/// of its own frame alone. Attributes are not kept.
SplitSurface split_by_balls(const Layer& surface, const Layer& balls, double fineness);

}  // namespace ballflow::show
