#pragma once

#include <vector>

#include "model.hpp"
#include "png.hpp"

namespace ballflow::render {

struct PictureOptions {
  Vector from{0.35, 0.25, 1};  // direction from the models to the viewer
  Vector up{0, 1, 0};
  int height = 600;  // pixels
};

/// Models side by side in one scale, in orthographic projection. Points become beads, balls are spheres,
/// polygons are surfaces lit from both sides; where there are radii their square roots give the colour
/// (violet: small). Smooth shading for surfaces without radii. The same bytes for the same input.
Image picture(const std::vector<Model>& models, const PictureOptions& options);

}  // namespace ballflow::render
