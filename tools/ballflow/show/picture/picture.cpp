#include "show/picture/picture.hpp"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "ballflow/error.hpp"
#include "show/picture/legend.hpp"
#include "show/picture/lettering.hpp"
#include "show/picture/light.hpp"
#include "show/picture/number.hpp"
#include "show/picture/renderer.hpp"

namespace ballflow::show {
namespace {

using geometry::Box;
using geometry::Vec3;

constexpr int tile_side = 64;

double coordinate(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::vector<Layer> all_layers(const std::vector<std::vector<Layer>>& scenes) {
  std::vector<Layer> all;
  for (const auto& scene : scenes) {
    for (const Layer& layer : scene) {
      if (layer.visible && layer.elements() > 0) all.push_back(layer);
    }
  }
  return all;
}

void check(const PictureOptions& options) {
  for (const int side : {options.width, options.height}) {
    if (side < 16 || side > 16384) {
      throw Error(ExitCode::usage,
                  "a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
                      " pixels",
                  "choose a width and a height from 16 to 16384");
    }
  }
}

void refuse_nothing(const std::vector<std::vector<Layer>>& scenes) {
  std::string hidden;
  for (const auto& scene : scenes) {
    for (const Layer& layer : scene) {
      if (layer.elements() > 0) hidden += (hidden.empty() ? "" : ", ") + layer.name;
    }
  }
  throw Error(ExitCode::usage, "there is nothing to draw",
              hidden.empty() ? "all layers are empty" : "these layers are hidden: " + hidden);
}

std::vector<CutPlane> planes_of(const std::vector<Clip>& clips, const std::vector<Layer>& scene,
                                const Camera& camera) {
  const Box box = bounding_box(scene);
  std::vector<CutPlane> planes;
  for (const Clip& clip : clips) {
    const double lower = coordinate(box.lower, clip.axis), upper = coordinate(box.upper, clip.axis);
    const double part = clip.value / 100;
    const double value = clip.percent ? (1 - part) * lower + part * upper : clip.value;
    std::array<double, 3> normal{0, 0, 0}, point{0, 0, 0};
    normal[static_cast<std::size_t>(clip.axis)] = clip.above ? 1 : -1;
    point[static_cast<std::size_t>(clip.axis)] = value;
    const double offset = coordinate(camera.inward({point[0], point[1], point[2]}), clip.axis);
    planes.push_back({{normal[0], normal[1], normal[2]}, clip.above ? offset : -offset});
  }
  return planes;
}

/// Points that are many are small; lines are half as wide.
Strokes strokes_of(const PictureOptions& options, const std::vector<Layer>& scene) {
  if (options.point_size > 0) return {options.point_size / 2, options.point_size / 2};
  std::size_t points = 1;
  for (const Layer& layer : scene) {
    if (layer.shape == Shape::points) points = std::max(points, layer.elements());
  }
  const double side = std::min(options.width, options.height);
  const double radius = 0.25 * side / std::sqrt(static_cast<double>(points));
  return {std::clamp(radius, 0.0011 * side, 0.006 * side), std::max(0.6, 0.0012 * side)};
}

/// For text: dark on light ground, light on dark ground, and what can be read on both when there is none.
Colour ink_on(const std::optional<Colour>& ground) {
  if (!ground) return {122, 130, 140};
  const Light light = light_of(*ground);
  const bool bright = 0.21 * light.x + 0.72 * light.y + 0.07 * light.z > 0.3;
  return bright ? Colour{43, 49, 56} : Colour{216, 221, 227};
}

/// One scene into its part of the picture.
void draw_scene(const Renderer& renderer, const Viewport& part, const PictureOptions& options, Image& image,
                geometry::Monitor& monitor) {
  const int columns = (part.width + tile_side - 1) / tile_side,
            rows = (part.height + tile_side - 1) / tile_side;
  std::atomic<int> done = 0;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1), [&](const auto& range) {
    for (int row = range.rows().begin(); row != range.rows().end(); ++row) {
      for (int column = range.cols().begin(); column != range.cols().end(); ++column) {
        const int x = part.x + column * tile_side, y = part.y + row * tile_side;
        const int width = std::min(tile_side, part.x + part.width - x);
        const int height = std::min(tile_side, part.y + part.height - y);
        const std::vector<Pixel> pixels = renderer.tile(x, y, width, height, monitor);
        for (int j = 0; j < height; ++j) {
          for (int i = 0; i < width; ++i) {
            const Pixel& pixel = pixels[static_cast<std::size_t>(j * width + i)];
            const std::size_t at =
                4 * (static_cast<std::size_t>(y + j) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x + i));
            Light light = pixel.light;
            double opacity = 1;
            if (options.ground) {
              light = light + (1 - pixel.coverage) * light_of(*options.ground);
            } else {
              opacity = pixel.coverage;
              if (opacity > 0) light = 1 / opacity * light;
            }
            const Colour colour = colour_of(light);
            image.rgba[at] = colour.red;
            image.rgba[at + 1] = colour.green;
            image.rgba[at + 2] = colour.blue;
            image.rgba[at + 3] = static_cast<std::uint8_t>(255 * opacity + 0.5);
          }
        }
        monitor.step(static_cast<double>(++done) / (rows * columns));
      }
    }
  });
}

}  // namespace

Clip clip_named(const std::string& text) {
  Clip clip;
  std::string_view rest = text;
  if (rest.starts_with('-')) {
    clip.above = false;
    rest.remove_prefix(1);
  }
  const std::size_t axis = rest.empty() ? std::string_view::npos : std::string_view("xyz").find(rest.front());
  if (axis != std::string_view::npos && rest.substr(1).starts_with('=')) {
    rest.remove_prefix(2);
    clip.axis = static_cast<int>(axis);
    clip.percent = rest.ends_with('%');
    if (clip.percent) rest.remove_suffix(1);
    if (const auto value = number_in(rest)) {
      clip.value = *value;
      return clip;
    }
  }
  throw Error(ExitCode::usage, "\"" + text + "\" is no clipping plane",
              "write x=0.5 to remove what has x > 0.5, -x=0.5 for the other side, x=50% for the middle");
}

Image draw(const std::vector<Layer>& layers, const PictureOptions& options, geometry::Monitor& monitor) {
  return draw_beside({layers}, options, monitor);
}

Image draw_beside(const std::vector<std::vector<Layer>>& scenes, const PictureOptions& options,
                  geometry::Monitor& monitor) {
  check(options);
  const std::vector<Layer> scene = all_layers(scenes);
  if (scene.empty()) refuse_nothing(scenes);
  const std::vector<Layer>& shown = options.room_for.empty() ? scene : options.room_for;
  Image image{options.width, options.height,
              std::vector<std::uint8_t>(4 * static_cast<std::size_t>(options.width) *
                                        static_cast<std::size_t>(options.height))};
  const unsigned threads =
      options.threads > 0 ? options.threads : static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
  tbb::task_arena arena(static_cast<int>(threads));
  const int n = static_cast<int>(scenes.size());
  const Ranges ranges = ranges_of(scene);
  const Legend legend(options.legend ? scene : std::vector<Layer>{}, options.legend ? ranges : Ranges{},
                      options.width, options.height);
  const int room = options.width - legend.width();
  arena.execute([&] {
    for (int k = 0; k < n; ++k) {
      const int x = room * k / n;
      const Viewport part{x, 0, room * (k + 1) / n - x, options.height};
      const Camera camera(shown, options.from, options.up, part, 0.04 * std::min(part.width, part.height));
      geometry::PartMonitor watched(monitor, static_cast<double>(k) / n, (k + 1.0) / n);
      const Renderer renderer(scenes[static_cast<std::size_t>(k)], ranges, camera,
                              planes_of(options.clips, shown, camera), strokes_of(options, scene), watched);
      draw_scene(renderer, part, options, image, watched);
    }
  });
  if (legend.width() > 0) {
    if (options.ground) fill(image, room, 0, legend.width(), options.height, *options.ground);
    legend.draw(image, ink_on(options.ground));
  }
  return image;
}

}  // namespace ballflow::show
