// Text and rectangles over a picture, in a font of strokes that needs no file.
#pragma once

#include <string_view>

#include "show/palette.hpp"
#include "show/picture/png.hpp"

namespace ballflow::show {

/// Width of a line of text in pixels; `capital` is the height of a capital letter.
double text_width(std::string_view text, double capital);

/// Draws a line of text whose first letter begins at x and whose letters stand on y. ASCII; other characters
/// become an empty box.
void draw_text(Image& image, double x, double y, double capital, std::string_view text, Colour colour);

/// Fills a rectangle; pixels that it covers in part are mixed.
void fill(Image& image, double x, double y, double width, double height, Colour colour);

}  // namespace ballflow::show
