// Reads PNG files strictly, to check those that are written: every chunk has the right checksum, the parts
// stand in order, and there are exactly the bytes that the size demands.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace ballflow::test {

struct DecodedPng {
  int width = 0, height = 0, colour_type = 0;
  std::vector<std::uint8_t> rgba;

  std::array<int, 4> at(int x, int y) const {
    const std::size_t i =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {rgba.at(i), rgba.at(i + 1), rgba.at(i + 2), rgba.at(i + 3)};
  }
};

inline DecodedPng decode_png(const std::string& file) {
  const auto fail = [](const char* why) { throw std::runtime_error(std::string("PNG: ") + why); };
  const auto u32 = [&file](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<std::uint8_t>(file.at(i + k));
    return value;
  };
  if (file.substr(0, 8) != "\x89PNG\r\n\x1a\n") fail("no signature");
  DecodedPng png;
  std::string data, palette, last;
  for (std::size_t i = 8; i < file.size();) {
    const std::uint32_t length = u32(i);
    const std::string name = file.substr(i + 4, 4), body = file.substr(i + 8, length);
    if (body.size() != length) fail("a chunk is cut off");
    const std::string checked = name + body;
    if (crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())) !=
        u32(i + 8 + length)) {
      fail("a checksum is wrong");
    }
    if ((i == 8) != (name == "IHDR")) fail("the header is not first");
    if (name == "IHDR") {
      png.width = static_cast<int>(u32(i + 8));
      png.height = static_cast<int>(u32(i + 12));
      png.colour_type = body.at(9);
      if (length != 13 || body.at(8) != 8 || body.substr(10) != std::string(3, '\0')) fail("unusual header");
    }
    if (name == "PLTE") palette = body;
    if (name == "IDAT") data += body;
    last = name;
    i += 12 + length;
  }
  if (last != "IEND") fail("no end");

  const std::size_t pixel = png.colour_type == 6   ? 4
                            : png.colour_type == 2 ? 3
                            : png.colour_type == 3 ? 1
                                                   : 0;
  if (pixel == 0) fail("unusual colours");
  const std::size_t stride = pixel * static_cast<std::size_t>(png.width);
  std::vector<std::uint8_t> raw((stride + 1) * static_cast<std::size_t>(png.height));
  uLongf size = raw.size();
  if (uncompress(raw.data(), &size, reinterpret_cast<const Bytef*>(data.data()), data.size()) != Z_OK ||
      size != raw.size()) {
    fail("the pixels cannot be unpacked");
  }
  std::vector<std::uint8_t> above(stride, 0), row(stride);
  for (std::size_t y = 0; y < static_cast<std::size_t>(png.height); ++y) {
    const std::uint8_t* const in = raw.data() + y * (stride + 1);
    for (std::size_t i = 0; i < stride; ++i) {
      const int a = i < pixel ? 0 : row[i - pixel], b = above[i], c = i < pixel ? 0 : above[i - pixel];
      int guess = 0;
      if (in[0] == 1) guess = a;
      if (in[0] == 2) guess = b;
      if (in[0] == 3) guess = (a + b) / 2;
      if (in[0] == 4) {
        const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
        guess = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      }
      if (in[0] > 4) fail("unknown filter");
      row[i] = static_cast<std::uint8_t>(in[1 + i] + guess);
    }
    for (std::size_t x = 0; x < static_cast<std::size_t>(png.width); ++x) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (pixel == 1) {
          png.rgba.push_back(k == 3 ? 255 : static_cast<std::uint8_t>(palette.at(3 * row[x] + k)));
        } else {
          png.rgba.push_back(k < pixel ? row[pixel * x + k] : 255);
        }
      }
    }
    above = row;
  }
  return png;
}

}  // namespace ballflow::test
