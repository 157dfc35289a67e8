// Pictures of layers, drawn without a graphics card or a display.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "show/palette.hpp"
#include "show/picture/camera.hpp"
#include "show/picture/png.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

/// Removes what is on one side of a plane; balls are cut open, and the cut shows to which ball its points
/// belong.
struct Clip {
  int axis = 0;          // 0, 1, 2: x, y, z
  bool above = true;     // removes what is larger than the value, else what is smaller
  double value = 0;      // model units, or
  bool percent = false;  // percent of the bounding box: 0 is its lower side
};

/// "x=0.5" removes what has x > 0.5, "-x=0.5" what has x < 0.5; "x=50%" is the middle of the bounding box.
/// Throws Error (code usage).
Clip clip_named(const std::string& text);

struct PictureOptions {
  int width = 1600, height = 1200;  // pixels, 16 to 16384 each
  Direction from;
  Upward up = Upward::y;
  std::optional<Colour> ground = Colour{255, 255, 255};  // nothing: transparent
  std::vector<Clip> clips;
  double point_size = 0;  // diameter of points and width of lines, in pixels; 0 chooses by size and number
  bool legend = true;     // what colours mean, at the right, where there is room
  unsigned threads = 0;   // 0: those of the caller
  std::vector<Layer> room_for;  // what the picture has room for; nothing: what is drawn
};

/// Draws the visible layers, each as its `colour_by` and `opacity` say. Equal layers and options give equal
/// pixels, on every machine and for every number of threads.
///
/// Throws Error (code usage) when no layer is visible, when an option is out of range, and when coordinates
/// span more than a double can hold; Cancelled.
Image draw(const std::vector<Layer>& layers, const PictureOptions& options = {},
           geometry::Monitor& monitor = geometry::no_monitor());

/// The same for several scenes side by side, in one scale and with one legend.
Image draw_beside(const std::vector<std::vector<Layer>>& scenes, const PictureOptions& options = {},
                  geometry::Monitor& monitor = geometry::no_monitor());

}  // namespace ballflow::show
