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

/// An animated PNG (PNG, third edition): images of one size, each shown for a time, again and again. Viewers
/// that know no animations show the first one.
class AnimatedPng {
 public:
  /// `opaque`: all pixels of all images are.
  AnimatedPng(int milliseconds, bool opaque) : milliseconds_(milliseconds), opaque_(opaque) {}

  void add(const Image& image);
  /// The content of the file. At least one image was added.
  std::string file() const;

 private:
  int milliseconds_;
  bool opaque_;
  int width_ = 0, height_ = 0;
  std::uint32_t images_ = 0, number_ = 0;
  std::string chunks_;
};

}  // namespace ballflow::show
