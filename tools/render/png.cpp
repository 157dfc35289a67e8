#include "png.hpp"

#include <zlib.h>

#include <fstream>
#include <stdexcept>

namespace ballflow::render {

namespace {

void append_u32(std::string& text, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) text.push_back(static_cast<char>(value >> shift & 0xFF));
}

// A chunk: length, name, data, CRC of name and data.
std::string chunk(const std::string& name, const std::string& data) {
  std::string text;
  append_u32(text, static_cast<std::uint32_t>(data.size()));
  const std::string body = name + data;
  text += body;
  append_u32(text, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                    static_cast<uInt>(body.size()))));
  return text;
}

}  // namespace

void write_png(const Image& image, const std::string& path) {
  std::string header;
  append_u32(header, static_cast<std::uint32_t>(image.width));
  append_u32(header, static_cast<std::uint32_t>(image.height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB, deflate, default filters, not interlaced

  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  std::string raw;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.rgb.data() + static_cast<std::size_t>(y) * stride;
    raw.push_back(1);  // filter "sub": differences to the pixel on the left
    for (std::size_t i = 0; i < stride; ++i) {
      raw.push_back(static_cast<char>(row[i] - (i < 3 ? 0 : row[i - 3])));
    }
  }
  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
                raw.size(), 9) != Z_OK) {
    throw std::runtime_error(path + ": zlib cannot compress the picture");
  }
  packed.resize(size);

  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << "\x89PNG\r\n\x1a\n" << chunk("IHDR", header) << chunk("IDAT", packed) << chunk("IEND", "");
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace ballflow::render
