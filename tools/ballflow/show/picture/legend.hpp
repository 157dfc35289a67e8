// What the colours of a picture mean.
#pragma once

#include <string>
#include <vector>

#include "show/picture/png.hpp"
#include "show/picture/surfaces.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

/// Round numbers from `range.lower` to `range.upper`, about five, and how they are written: "0.05", "2e-07".
/// The two ends when no round number lies between; one number when they are equal.
struct Tick {
  double value = 0;
  std::string text;
};
std::vector<Tick> ticks(ValueRange range);

/// A column at the right of a picture: a bar with numbers for every attribute with a range, a list of colours
/// for categories, and for layers of one colour each when there are several.
class Legend {
 public:
  /// `scene`: the visible layers.
  Legend(const std::vector<Layer>& scene, const Ranges& ranges, int width, int height);

  /// Columns of pixels that it takes; 0 when there is nothing to say, or too little room to say it.
  int width() const { return width_; }

  void draw(Image& image, Colour ink) const;

 private:
  struct Entry {
    Colour colour;
    std::string text;
  };
  struct Block {
    std::string title, unit;
    std::vector<Tick> ticks;  // of a bar
    ValueRange range;
    std::vector<Entry> entries;  // of a list
  };
  double block_width(const Block& block) const;
  double block_height(const Block& block) const;

  std::vector<Block> blocks_;
  int width_ = 0;
  double capital_ = 0, bar_height_ = 0;
};

}  // namespace ballflow::show
