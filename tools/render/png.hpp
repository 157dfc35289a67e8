#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballflow::render {

/// 8-bit RGB, rows from top to bottom.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height
};

/// Throws std::runtime_error when the file cannot be written.
void write_png(const Image& image, const std::string& path);

}  // namespace ballflow::render
