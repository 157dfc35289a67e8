#include "show/palette.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace ballflow::show {
namespace {

using Triple = std::array<double, 3>;

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Triple linear(Colour c) { return {linear(c.red), linear(c.green), linear(c.blue)}; }

Triple times(const std::array<Triple, 3>& matrix, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i] += matrix[i][k] * v[k];
  }
  return result;
}

// B. Ottosson, "A perceptual color space for image processing" (2020).
Triple oklab(const Triple& rgb) {
  Triple lms = times({{{0.4122214708, 0.5363325363, 0.0514459929},
                       {0.2119034982, 0.6806995451, 0.1073969566},
                       {0.0883024619, 0.2817188376, 0.6299787005}}},
                     rgb);
  for (double& c : lms) c = std::cbrt(c);
  return times({{{0.2104542553, 0.7936177850, -0.0040720468},
                 {1.9779984951, -2.4285922050, 0.4505937099},
                 {0.0259040371, 0.7827717662, -0.8086757660}}},
               lms);
}

double distance(const Triple& a, const Triple& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// G. M. Machado et al., "A physiologically-based model for simulation of color vision deficiency" (2009),
// severity 1.
const std::array<Triple, 3> deuteranopia = {
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
const std::array<Triple, 3> protanopia = {
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};

TEST(palette, scalar_grows_in_lightness_by_equal_steps) {
  const auto table = scalar_table();
  ASSERT_EQ(table.size(), 256u);
  std::vector<Triple> lab;
  for (const Colour colour : table) lab.push_back(oklab(linear(colour)));
  // Over 15 entries, since a single step is near the rounding to 8 bits.
  double shortest = 1e9, longest = 0;
  for (std::size_t i = 0; i + 15 < lab.size(); ++i) {
    EXPECT_GT(lab[i + 15][0], lab[i][0] + 0.015) << i;
    shortest = std::min(shortest, distance(lab[i], lab[i + 15]));
    longest = std::max(longest, distance(lab[i], lab[i + 15]));
  }
  EXPECT_LT(longest / shortest, 1.2);
  EXPECT_GT(lab.front()[0], 0.35);
  EXPECT_LT(lab.back()[0], 0.95);
}

TEST(palette, scalar_begins_with_violet_and_ends_with_yellow) {
  EXPECT_EQ(hex(scalar(0)), "#532583");
  EXPECT_EQ(hex(scalar(1)), "#f6e54f");
  EXPECT_EQ(scalar(-5), scalar(0));
  EXPECT_EQ(scalar(7), scalar(1));
  EXPECT_EQ(hex(scalar(0.5)), hex(scalar_table()[128]));
}

TEST(palette, categories_differ_for_every_eye_and_on_every_ground) {
  const auto all = categories();
  ASSERT_EQ(all.size(), 10u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Triple a = linear(all[i]), b = linear(all[k]);
      EXPECT_GT(distance(oklab(a), oklab(b)), 0.08) << i << " " << k;
      for (const auto& eye : {deuteranopia, protanopia}) {
        EXPECT_GT(distance(oklab(times(eye, a)), oklab(times(eye, b))), 0.04) << i << " " << k;
      }
    }
    EXPECT_GT(distance(oklab(linear(all[i])), oklab({1, 1, 1})), 0.15) << i;
    EXPECT_GT(distance(oklab(linear(all[i])), oklab(linear(Colour{24, 26, 30}))), 0.15) << i;
  }
  EXPECT_EQ(category(13), all[3]);
}

TEST(palette, plain_colours_go_by_name_then_by_shape) {
  Layer layer;
  layer.name = "something";
  std::set<std::string> by_shape;
  for (const Shape shape : {Shape::points, Shape::balls, Shape::segments, Shape::triangles}) {
    layer.shape = shape;
    by_shape.insert(hex(plain(layer)));
  }
  EXPECT_EQ(by_shape.size(), 4u);
  layer.name = "mesh";
  EXPECT_EQ(by_shape.count(hex(plain(layer))), 0u);
}

TEST(palette, one_range_spans_the_layers_that_share_an_attribute) {
  Layer a, b, hidden, other;
  for (Layer* layer : {&a, &b, &hidden, &other}) layer->colour_by = "radius";
  a.attributes = {{"radius", "", {}, true, {2, 3}}};
  b.attributes = {{"radius", "", {}, true, {2.5, 10}}};
  hidden.attributes = {{"radius", "", {}, true, {1000}}};
  hidden.visible = false;
  other.attributes = {{"order", "", {}, true, {-7}}};
  other.colour_by = "order";
  const ValueRange range = value_range({a, b, hidden, other}, "radius");
  EXPECT_EQ(range.lower, 2);
  EXPECT_EQ(range.upper, 10);
  EXPECT_EQ(range.place(2), 0);
  EXPECT_EQ(range.place(6), 0.5);
  EXPECT_EQ(range.place(11), 1);
  EXPECT_EQ((ValueRange{4, 4}.place(4)), 0.5);
  EXPECT_EQ((ValueRange{-1.7e308, 1.7e308}.place(0)), 0.5) << "the difference overflows";
}

TEST(palette, pages_get_the_same_colours) {
  const Json json = palette_json();
  ASSERT_EQ(json["scalar"].size(), 256u);
  EXPECT_EQ(json["scalar"][77], hex(scalar_table()[77]));
  EXPECT_EQ(json["categories"][4], hex(category(4)));
  Layer mesh;
  mesh.name = "mesh";
  EXPECT_EQ(json["plain"]["names"]["mesh"], hex(plain(mesh)));
  mesh.name = "other";
  mesh.shape = Shape::segments;
  EXPECT_EQ(json["plain"]["shapes"]["segments"], hex(plain(mesh)));
}

}  // namespace
}  // namespace ballflow::show
