// Pictures as PNG files (ISO/IEC 15948).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballflow::show {

/// Rows from top to bottom, 4 bytes a pixel: red, green, blue (sRGB) and opacity.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// The content of a PNG file: 8 bits a channel, without opacity when all pixels are opaque, with a palette
/// when there are at most 256 colours. Equal images give equal bytes (with one version of zlib).
std::string png(const Image& image);

}  // namespace ballflow::show
