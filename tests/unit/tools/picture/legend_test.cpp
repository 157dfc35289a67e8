#include "show/picture/legend.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "show/picture/lettering.hpp"

namespace ballflow::show {
namespace {

std::vector<std::string> texts(double lower, double upper) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks({lower, upper})) all.push_back(tick.text);
  return all;
}

using Texts = std::vector<std::string>;

TEST(legend, ticks_are_round_numbers) {
  EXPECT_EQ(texts(0.013, 0.26), (Texts{"0.05", "0.10", "0.15", "0.20", "0.25"}));
  EXPECT_EQ(texts(-1, 1), (Texts{"-1.0", "-0.5", "0", "0.5", "1.0"}));
  EXPECT_EQ(texts(0.4852261, 0.485246), (Texts{"0.485230", "0.485235", "0.485240", "0.485245"}));
  EXPECT_EQ(texts(0, 941), (Texts{"0", "200", "400", "600", "800"}));
  EXPECT_EQ(texts(0, 3e-9), (Texts{"0", "5e-10", "10e-10", "15e-10", "20e-10", "25e-10", "30e-10"}));
  EXPECT_EQ(texts(0, 5e9), (Texts{"0", "1e9", "2e9", "3e9", "4e9", "5e9"}));
}

TEST(legend, a_range_of_one_value_has_one_tick) { EXPECT_EQ(texts(2.5, 2.5), Texts{"2.5"}); }

TEST(legend, ticks_of_any_range_are_few_and_in_it_and_say_their_value) {
  std::mt19937_64 bits(5);
  for (int i = 0; i < 3000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(bits() % 600) - 300);
    const double a = scale * (static_cast<double>(bits()) / 1e19 - 0.9);
    const double b = scale * (static_cast<double>(bits()) / 1e19 - 0.9);
    const ValueRange range{std::min(a, b), std::max(a, b)};
    const auto all = ticks(range);
    ASSERT_GE(all.size(), range.lower < range.upper ? 2u : 1u);
    ASSERT_LE(all.size(), 9u);
    for (const Tick& tick : all) {
      const double slack = 1e-9 * std::max(std::abs(range.lower), std::abs(range.upper));
      EXPECT_GE(tick.value, range.lower - slack);
      EXPECT_LE(tick.value, range.upper + slack);
      EXPECT_NEAR(std::stod(tick.text), tick.value, 1e-3 * std::abs(tick.value) + slack) << tick.text;
    }
  }
  EXPECT_EQ(ticks({-1.7e308, 1.7e308}).size(), 2u);
}

Layer layer(const std::string& name, const std::string& attribute, std::vector<std::string> categories = {}) {
  Layer result;
  result.name = name;
  result.vertices = std::vector<geometry::Vec3>{{0, 0, 0}, {1, 1, 1}};
  if (!attribute.empty()) {
    result.attributes = {{attribute, "model units", std::move(categories), true, {0, 1}}};
    result.colour_by = attribute;
  }
  return result;
}

int legend_width(const std::vector<Layer>& scene, int width, int height) {
  return Legend(scene, ranges_of(scene), width, height).width();
}

TEST(legend, takes_room_only_when_it_has_something_to_say) {
  EXPECT_EQ(legend_width({layer("mesh", "")}, 800, 600), 0) << "one plain layer";
  EXPECT_GT(legend_width({layer("mesh", ""), layer("points", "")}, 800, 600), 0);
  EXPECT_GT(legend_width({layer("balls", "radius")}, 800, 600), 0);
  EXPECT_GT(legend_width({layer("mesh", "kind", {"wall", "facet"})}, 800, 600), 0);
}

TEST(legend, is_left_out_when_it_would_take_much_of_the_picture) {
  EXPECT_EQ(legend_width({layer("balls", "radius")}, 100, 100), 0);
  EXPECT_EQ(legend_width({layer(std::string(200, 'm'), ""), layer("points", "")}, 800, 600), 0);
}

TEST(legend, shows_the_colours_from_top_to_bottom) {
  const std::vector<Layer> scene = {layer("balls", "radius")};
  const Legend legend(scene, ranges_of(scene), 800, 600);
  Image image{800, 600, std::vector<std::uint8_t>(4 * 800 * 600, 255)};
  legend.draw(image, {0, 0, 0});
  std::set<std::string> seen;
  std::vector<std::string> column;
  const int x = 800 - legend.width() + 25;
  for (int y = 0; y < 600; ++y) {
    const std::size_t i = 4 * static_cast<std::size_t>(y * 800 + x);
    const Colour colour{image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
    if (colour.red != colour.green || colour.green != colour.blue) column.push_back(hex(colour));
  }
  ASSERT_GT(column.size(), 200u);
  EXPECT_EQ(column[2], hex(scalar(1 - 2.5 / static_cast<double>(column.size()))));
  EXPECT_EQ(column[column.size() / 2], hex(scalar(0.5 - 0.5 / static_cast<double>(column.size()))));
  for (int y = 0; y < 600; ++y) {
    for (int i = 0; i < 800 - legend.width(); ++i) {
      ASSERT_EQ(image.rgba[4 * static_cast<std::size_t>(y * 800 + i)], 255) << "ink outside of its column";
    }
  }
}

Image written(const std::string& text, double capital) {
  Image image{400, 60, std::vector<std::uint8_t>(4 * 400 * 60, 255)};
  draw_text(image, 10, 40, capital, text, {0, 0, 0});
  return image;
}

TEST(lettering, every_character_looks_different) {
  std::set<std::vector<std::uint8_t>> seen;
  const std::string all =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,:;-+/()[]%_=<>*#'! ";
  for (const char c : all) seen.insert(written(std::string(1, c), 18).rgba);
  seen.insert(written("\x01", 18).rgba);
  EXPECT_EQ(seen.size(), all.size() + 1);
}

TEST(lettering, ink_stays_within_the_width_of_the_text) {
  for (const std::string text : {"radius", "model units", "Voronoi facet", "10e-10", "(MWQ%)"}) {
    const Image image = written(text, 20);
    int first = 400, last = 0, top = 60, bottom = 0;
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 400; ++x) {
        if (image.rgba[4 * static_cast<std::size_t>(400 * y + x)] > 128) continue;
        first = std::min(first, x);
        last = std::max(last, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
    EXPECT_NEAR(first, 10, 3) << text;
    EXPECT_NEAR(last, 10 + text_width(text, 20), 3) << text;
    EXPECT_GE(top, 40 - 25);
    EXPECT_LE(bottom, 40 + 8);
  }
}

TEST(lettering, text_over_the_side_of_a_picture_is_cut_off) {
  Image image{20, 10, std::vector<std::uint8_t>(4 * 20 * 10, 0)};
  draw_text(image, -5, 5, 12, "mmmmmm", {255, 0, 0});
  fill(image, -3, -3, 100, 100, {0, 0, 255});
  EXPECT_EQ(image.rgba.size(), 800u);
  EXPECT_EQ(image.rgba[2], 255);
  EXPECT_EQ(image.rgba[3], 255);
}

}  // namespace
}  // namespace ballflow::show
