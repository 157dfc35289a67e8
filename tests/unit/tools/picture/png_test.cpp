#include "show/picture/png.hpp"

#include <gtest/gtest.h>

#include <random>

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

}  // namespace
}  // namespace ballflow::show
