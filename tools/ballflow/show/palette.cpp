#include "show/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace ballflow::show {
namespace {

constexpr Colour rgb(std::uint32_t hexadecimal) {
  return {static_cast<std::uint8_t>(hexadecimal >> 16), static_cast<std::uint8_t>(hexadecimal >> 8 & 0xff),
          static_cast<std::uint8_t>(hexadecimal & 0xff)};
}

// Points at equal distances on a curve in Oklab (B. Ottosson, 2020) whose lightness runs from 0.38 to 0.91
// and whose hue from 302 to 103 degrees, with the chroma that fits into sRGB everywhere. Viridis is a like
// curve, but begins so dark that shading cannot be seen.
constexpr std::array<std::uint32_t, 17> scalar_stops = {
    0x532583, 0x4d378f, 0x454799, 0x3c57a1, 0x3067a7, 0x2177aa, 0x1086ac, 0x0594ac, 0x13a2aa,
    0x2bafa6, 0x45bba0, 0x60c697, 0x7cd08d, 0x9ad880, 0xb8de71, 0xd7e360, 0xf6e54f};

// M. A. Petroff: Accessible color sequences for data visualization (2021), the sequence of ten.
constexpr std::array<Colour, 10> category_colours = {
    rgb(0x3f90da), rgb(0xffa90e), rgb(0xbd1f01), rgb(0x94a4a2), rgb(0x832db6),
    rgb(0xa96b59), rgb(0xe76300), rgb(0xb9ac70), rgb(0x717581), rgb(0x92dadd)};

constexpr std::array<std::pair<std::string_view, Colour>, 11> plain_by_name = {{
    {"mesh", rgb(0xb9c0c9)},
    {"inner poles", rgb(0x3f90da)},
    {"inner poles as balls", rgb(0x3f90da)},
    {"outer poles", rgb(0xe76300)},
    {"outer poles as balls", rgb(0xe76300)},
    {"regular triangles", rgb(0x8fb6cf)},
    {"singular triangles", rgb(0xffa90e)},
    {"singular edges", rgb(0xbd1f01)},
    {"isolated vertices", rgb(0x832db6)},
    {"not covered", rgb(0xe3000f)},
    {"voids", rgb(0xe3000f)},
}};

constexpr std::array<std::pair<Shape, Colour>, 4> plain_by_shape = {{
    {Shape::points, rgb(0x5b6673)},
    {Shape::balls, rgb(0x7fb2d9)},
    {Shape::segments, rgb(0xc2571a)},
    {Shape::triangles, rgb(0xa9b7c6)},
}};

std::array<Colour, 256> interpolated() {
  std::array<Colour, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::size_t position = i * (scalar_stops.size() - 1);  // in 255ths of a stop
    const std::size_t stop = std::min(position / 255, scalar_stops.size() - 2);
    const std::size_t part = position - 255 * stop;
    const Colour a = rgb(scalar_stops[stop]), b = rgb(scalar_stops[stop + 1]);
    const auto mixed = [part](std::size_t from, std::size_t to) {
      return static_cast<std::uint8_t>(((255 - part) * from + part * to + 127) / 255);
    };
    table[i] = {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
  }
  return table;
}

}  // namespace

std::string hex(Colour colour) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) {
    text += digits[channel >> 4];
    text += digits[channel & 15];
  }
  return text;
}

std::span<const Colour> scalar_table() {
  static const std::array<Colour, 256> table = interpolated();
  return table;
}

Colour scalar(double t) {
  return scalar_table()[static_cast<std::size_t>(std::clamp(t, 0.0, 1.0) * 255 + 0.5)];
}

std::span<const Colour> categories() { return category_colours; }

Colour category(std::size_t i) { return category_colours[i % category_colours.size()]; }

Colour plain(const Layer& layer) {
  for (const auto& [name, colour] : plain_by_name) {
    if (name == layer.name) return colour;
  }
  for (const auto& [shape, colour] : plain_by_shape) {
    if (shape == layer.shape) return colour;
  }
  return {};
}

double ValueRange::place(double value) const {
  if (!(lower < upper)) return 0.5;
  return std::clamp((value / 2 - lower / 2) / (upper / 2 - lower / 2), 0.0, 1.0);  // halves cannot overflow
}

ValueRange value_range(const std::vector<Layer>& layers, const std::string& attribute) {
  bool any = false;
  ValueRange range;
  for (const Layer& layer : layers) {
    if (!layer.visible || layer.colour_by != attribute) continue;
    const Attribute* const found = layer.find(attribute);
    if (found == nullptr || !found->categories.empty()) continue;
    for (const double value : found->values) {
      range.lower = any ? std::min(range.lower, value) : value;
      range.upper = any ? std::max(range.upper, value) : value;
      any = true;
    }
  }
  return range;
}

Json palette_json() {
  const auto names_of = [](std::span<const Colour> colours) {
    Json list = Json::array();
    for (const Colour colour : colours) list.push_back(hex(colour));
    return list;
  };
  Json names = Json::object(), shapes = Json::object();
  for (const auto& [name, colour] : plain_by_name) names[std::string(name)] = hex(colour);
  for (const auto& [shape, colour] : plain_by_shape) shapes[std::string(to_string(shape))] = hex(colour);
  Json json = Json::object();
  json["scalar"] = names_of(scalar_table());
  json["categories"] = names_of(categories());
  json["plain"]["names"] = std::move(names);
  json["plain"]["shapes"] = std::move(shapes);
  return json;
}

}  // namespace ballflow::show
