#include "show/picture/png.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "png_decoder.hpp"

namespace ballflow::show {
namespace {

/// `colours`: of how many colours pixels are; 0: of any.
Image noise(int width, int height, unsigned colours, bool opaque) {
  std::mt19937 random(7);
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const auto number = static_cast<unsigned>(random());
    const unsigned value = colours > 0 ? number % colours * 257 : number;
    for (unsigned k = 0; k < 3; ++k) image.rgba.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
    image.rgba.push_back(opaque ? 255 : static_cast<std::uint8_t>(number >> 24));
  }
  return image;
}

void expect_kept(const Image& image, int colour_type) {
  const test::DecodedPng decoded = test::decode_png(png(image));
  EXPECT_EQ(decoded.width, image.width);
  EXPECT_EQ(decoded.height, image.height);
  EXPECT_EQ(decoded.colour_type, colour_type);
  EXPECT_TRUE(decoded.rgba == image.rgba);
}

TEST(png, keeps_every_pixel_with_opacity) { expect_kept(noise(37, 23, 0, false), 6); }
TEST(png, leaves_opacity_out_when_all_pixels_are_opaque) { expect_kept(noise(37, 23, 0, true), 2); }
TEST(png, uses_a_palette_for_few_colours) {
  expect_kept(noise(61, 50, 256, true), 3);
  expect_kept(noise(1, 1, 1, true), 3);
}
TEST(png, a_colour_too_many_for_a_palette_is_kept) { expect_kept(noise(200, 50, 257, true), 2); }

TEST(png, predicts_smooth_pictures) {
  Image image{64, 64, {}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (const int channel : {2 * x + y, x + 2 * y, 3 * x, 255}) {
        image.rgba.push_back(static_cast<std::uint8_t>(channel));
      }
    }
  }
  expect_kept(image, 2);
  EXPECT_LT(png(image).size(), 600u) << "of 12288 bytes";
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
  return value;
}

/// Each chunk's name and data, in order.
std::vector<std::pair<std::string, std::string>> chunks_of(const std::string& file) {
  std::vector<std::pair<std::string, std::string>> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number_at(file, at);
    chunks.emplace_back(file.substr(at + 4, 4), file.substr(at + 8, size));
    at += 12 + size;
  }
  return chunks;
}

TEST(png, an_animation_holds_its_images_in_order) {
  for (const bool opaque : {true, false}) {
    AnimatedPng animation(40, opaque);
    std::vector<Image> images;
    for (const unsigned colours : {0u, 3u, 1000u}) images.push_back(noise(31, 17, colours, opaque));
    for (const Image& image : images) animation.add(image);
    const std::string file = animation.file();
    EXPECT_TRUE(test::decode_png(file).rgba == images[0].rgba) << "what other viewers show";
    std::string names;
    std::uint32_t expected = 0;
    std::size_t image = 0;
    const auto chunks = chunks_of(file);
    for (const auto& [name, data] : chunks) {
      names += name + " ";
      if (name == "acTL") {
        EXPECT_EQ(number_at(data, 0), 3u);
      }
      if (name == "fcTL" || name == "fdAT") {
        EXPECT_EQ(number_at(data, 0), expected++);
      }
      if (name != "fdAT") continue;
      // The same picture as a file of its own.
      std::string alone = file.substr(0, 8);
      const auto append = [&alone](const std::string& chunk_name, const std::string& chunk_data) {
        const auto size = static_cast<std::uint32_t>(chunk_data.size());
        for (int shift = 24; shift >= 0; shift -= 8) alone.push_back(static_cast<char>(size >> shift & 0xFF));
        alone += chunk_name + chunk_data;
        const auto crc = static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>((chunk_name + chunk_data).data()), size + 4));
        for (int shift = 24; shift >= 0; shift -= 8) alone.push_back(static_cast<char>(crc >> shift & 0xFF));
      };
      append("IHDR", chunks[0].second);
      append("IDAT", data.substr(4));
      append("IEND", "");
      EXPECT_TRUE(test::decode_png(alone).rgba == images[++image].rgba);
    }
    EXPECT_EQ(names, "IHDR sRGB acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND ");
    EXPECT_EQ(image, 2u);
    EXPECT_THROW(animation.add(noise(30, 17, 0, opaque)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace ballflow::show
