// Small layers that pictures are drawn of.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "show/picture/picture.hpp"

namespace ballflow::show::picture_cases {

using geometry::Vec3;

inline constexpr Colour white{255, 255, 255};

inline Layer balls(const std::string& name, std::vector<Vec3> centers, std::vector<double> radii) {
  Layer layer;
  layer.name = name;
  layer.shape = Shape::balls;
  layer.vertices = std::move(centers);
  layer.radii = std::move(radii);
  return layer;
}

/// A square in the plane z, facing the front.
inline Layer square(const std::string& name, double z, double half = 1) {
  Layer layer;
  layer.name = name;
  layer.shape = Shape::triangles;
  layer.vertices = std::vector<Vec3>{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  layer.triangles = {{0, 1, 2}, {0, 2, 3}};
  return layer;
}

inline PictureOptions front(int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.from = direction_named("front");
  options.legend = false;
  return options;
}

struct Rgba {
  int r, g, b, a;
  friend bool operator==(const Rgba&, const Rgba&) = default;
};

inline Rgba at(const Image& image, int x, int y) {
  const std::size_t i = 4 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgba.at(i), image.rgba.at(i + 1), image.rgba.at(i + 2), image.rgba.at(i + 3)};
}

}  // namespace ballflow::show::picture_cases
