#include "show/picture/png.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace ballflow::show {
namespace {

using Bytes = std::vector<std::uint8_t>;

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

/// Pixels as a file has them: how many bytes each, and the colours that one-byte pixels are numbers of.
struct Pixels {
  std::size_t size = 4;  // bytes
  Bytes bytes;
  std::string palette;
};

Pixels smallest(const Image& image) {
  Pixels pixels;
  std::map<std::array<std::uint8_t, 3>, std::uint8_t> numbers;
  bool opaque = true, few = true;
  for (std::size_t i = 0; i < image.rgba.size() && (opaque || few); i += 4) {
    opaque = opaque && image.rgba[i + 3] == 255;
    if (!few) continue;
    const std::array<std::uint8_t, 3> colour = {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
    if (numbers.contains(colour)) continue;
    few = numbers.size() < 256;
    if (few) numbers.emplace(colour, static_cast<std::uint8_t>(numbers.size()));
  }
  if (!opaque) {
    pixels.bytes = image.rgba;
    return pixels;
  }
  pixels.size = few ? 1 : 3;
  pixels.bytes.reserve(image.rgba.size() / 4 * pixels.size);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::array<std::uint8_t, 3> colour = {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
    if (few) {
      pixels.bytes.push_back(numbers.at(colour));
    } else {
      pixels.bytes.insert(pixels.bytes.end(), colour.begin(), colour.end());
    }
  }
  if (few) {
    pixels.palette.resize(3 * numbers.size());
    for (const auto& [colour, number] : numbers) {
      for (std::size_t k = 0; k < 3; ++k) pixels.palette[3 * number + k] = static_cast<char>(colour[k]);
    }
  }
  return pixels;
}

std::uint8_t paeth(int left, int up, int corner) {
  const int guess = left + up - corner;
  const int by_left = std::abs(guess - left), by_up = std::abs(guess - up),
            by_corner = std::abs(guess - corner);
  return static_cast<std::uint8_t>(by_left <= by_up && by_left <= by_corner ? left
                                   : by_up <= by_corner                     ? up
                                                                            : corner);
}

/// A row as differences to what filter 0 (nothing), 1 (left), 2 (up), 3 (their mean) or 4 (Paeth) predicts.
void filter(int kind, const std::uint8_t* row, const std::uint8_t* above, std::size_t n, std::size_t pixel,
            Bytes& out) {
  out.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int left = i < pixel ? 0 : row[i - pixel];
    const int up = above == nullptr ? 0 : above[i];
    const int corner = above == nullptr || i < pixel ? 0 : above[i - pixel];
    const int guess = kind == 0   ? 0
                      : kind == 1 ? left
                      : kind == 2 ? up
                      : kind == 3 ? (left + up) / 2
                                  : paeth(left, up, corner);
    out[i] = static_cast<std::uint8_t>(row[i] - guess);
  }
}

/// Every row by the filter whose differences are smallest in sum, which compresses well.
Bytes filtered(const Pixels& pixels, int width, int height) {
  const std::size_t stride = pixels.size * static_cast<std::size_t>(width);
  Bytes all, row, best;
  all.reserve((stride + 1) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* here = pixels.bytes.data() + static_cast<std::size_t>(y) * stride;
    const std::uint8_t* above = y == 0 ? nullptr : here - stride;
    std::uint8_t best_kind = 0;
    long best_sum = -1;
    for (std::uint8_t kind = 0; kind < (pixels.palette.empty() ? 5 : 1); ++kind) {
      filter(kind, here, above, stride, pixels.size, row);
      long sum = 0;
      for (const std::uint8_t byte : row) sum += std::min<long>(byte, 256 - byte);
      if (best_sum >= 0 && sum >= best_sum) continue;
      best_sum = sum;
      best_kind = kind;
      best.swap(row);
    }
    all.push_back(best_kind);
    all.insert(all.end(), best.begin(), best.end());
  }
  return all;
}

std::string packed(const Bytes& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string text(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(), bytes.size(), 7) != Z_OK) {
    throw std::runtime_error("zlib cannot compress the picture");
  }
  text.resize(size);
  return text;
}

/// The signature and the first chunks.
std::string head(int width, int height, std::size_t pixel) {
  const char colour_type = pixel == 4 ? 6 : pixel == 3 ? 2 : 3;
  std::string header;
  append_u32(header, static_cast<std::uint32_t>(width));
  append_u32(header, static_cast<std::uint32_t>(height));
  header += {8, colour_type, 0, 0, 0};  // 8 bits, deflate, filters by row, not interlaced
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("sRGB", std::string(1, '\0'));
}

void append_u16(std::string& text, int value) {
  text += {static_cast<char>(value >> 8 & 0xFF), static_cast<char>(value & 0xFF)};
}

}  // namespace

void AnimatedPng::add(const Image& image) {
  if (images_ == 0) width_ = image.width, height_ = image.height;
  if (image.width != width_ || image.height != height_)
    throw std::invalid_argument("the images of an animation differ in size");
  std::string control;
  append_u32(control, number_++);
  append_u32(control, static_cast<std::uint32_t>(width_));
  append_u32(control, static_cast<std::uint32_t>(height_));
  append_u32(control, 0);
  append_u32(control, 0);
  append_u16(control, milliseconds_);
  append_u16(control, 1000);
  control += std::string(2, '\0');  // it stays until the next one replaces it
  chunks_ += chunk("fcTL", control);
  Pixels pixels{4, image.rgba, {}};
  if (opaque_) {
    pixels = {3, {}, {}};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      pixels.bytes.insert(pixels.bytes.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  const std::string data = packed(filtered(pixels, width_, height_));
  if (images_++ == 0) {
    chunks_ += chunk("IDAT", data);
    return;
  }
  std::string numbered;
  append_u32(numbered, number_++);
  chunks_ += chunk("fdAT", numbered + data);
}

std::string AnimatedPng::file() const {
  std::string count;
  append_u32(count, images_);
  append_u32(count, 0);  // without end
  return head(width_, height_, opaque_ ? 3 : 4) + chunk("acTL", count) + chunks_ + chunk("IEND", "");
}

std::string png(const Image& image) {
  const Pixels pixels = smallest(image);
  std::string file = head(image.width, image.height, pixels.size);
  if (!pixels.palette.empty()) file += chunk("PLTE", pixels.palette);
  return file + chunk("IDAT", packed(filtered(pixels, image.width, image.height))) + chunk("IEND", "");
}

}  // namespace ballflow::show
