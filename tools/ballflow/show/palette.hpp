// The colours of layers, so that pictures, pages and exports agree. All are sRGB, 8 bits a channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ballflow/node_decl.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// "#532583"
std::string hex(Colour colour);

/// 256 colours for numbers, from violet (small) over blue and green to yellow (large): equal steps look
/// equal, lightness grows, and even the darkest is light enough to be shaded.
std::span<const Colour> scalar_table();

/// The entry of scalar_table() nearest to 255 t; t is clamped to [0, 1].
Colour scalar(double t);

/// Ten colours that people with colour vision deficiencies can tell apart, on light and on dark ground.
std::span<const Colour> categories();

/// The colour of the i-th category; they repeat after ten.
Colour category(std::size_t i);

/// The colour of a layer that is not coloured by an attribute: that of its name, else that of its shape.
Colour plain(const Layer& layer);

/// The smallest and the largest value that the colours span.
struct ValueRange {
  double lower = 0, upper = 0;

  /// Where `value` lies: 0 at `lower`, 1 at `upper`, 0.5 when these are equal.
  double place(double value) const;
};

/// Of the attribute of this name in all visible layers that are coloured by it, so that equal colours mean
/// equal values throughout a scene. {0, 0} when there is none. Attributes of categories have no range.
ValueRange value_range(const std::vector<Layer>& layers, const std::string& attribute);

/// The same colours for pages: {"scalar": ["#532583", ...], "categories": [...],
/// "plain": {"names": {"mesh": "#..."}, "shapes": {"points": "#..."}}}.
Json palette_json();

}  // namespace ballflow::show
