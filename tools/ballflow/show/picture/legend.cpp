#include "show/picture/legend.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "show/picture/lettering.hpp"

namespace ballflow::show {
namespace {

// In heights of a capital letter.
constexpr double line = 2, bar_width = 1.3, space = 0.8, margin = 2;

std::string shortest(double value) {
  std::array<char, 32> text;
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 4);
  return {text.data(), error == std::errc() ? end : text.data()};
}

/// The power of ten at or below a positive value.
int exponent_of(double value) {
  std::array<char, 32> text;
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific);
  int exponent = 0;
  for (const char* p = text.data(); error == std::errc() && p != end; ++p) {
    if (*p == 'e') std::from_chars(p[1] == '+' ? p + 2 : p + 1, end, exponent);
  }
  return exponent;
}

double power_of_ten(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// n times 10 to the power of `exponent`, exactly.
std::string decimal(long long n, int exponent) {
  std::string digits = std::to_string(std::llabs(n));
  if (n == 0) {
    digits = "0";
  } else if (exponent > 5 || (exponent < -5 && static_cast<int>(digits.size()) + exponent < -2)) {
    digits += "e" + std::to_string(exponent);
  } else if (exponent >= 0) {
    digits.append(static_cast<std::size_t>(exponent), '0');
  } else {
    const auto decimals = static_cast<std::size_t>(-exponent);
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    digits.insert(digits.size() - decimals, 1, '.');
  }
  return (n < 0 ? "-" : "") + digits;
}

/// Which of the categories occur in layers that are coloured by an attribute of this name.
std::vector<bool> used_categories(const std::vector<Layer>& scene, const Attribute& attribute) {
  std::vector<bool> used(attribute.categories.size(), false);
  for (const Layer& layer : scene) {
    const Attribute* const own = layer.colour_by == attribute.name ? layer.find(attribute.name) : nullptr;
    if (own == nullptr || own->categories.empty()) continue;
    for (const double value : own->values) {
      if (value < static_cast<double>(used.size())) used[static_cast<std::size_t>(value)] = true;
    }
  }
  return used;
}

}  // namespace

std::vector<Tick> ticks(ValueRange range) {
  const double span = range.upper - range.lower;
  if (!(span > 0)) return {{range.lower, shortest(range.lower)}};
  std::vector<Tick> all;
  if (std::isfinite(span)) {
    int exponent = exponent_of(span / 5);
    const double mantissa = span / 5 / power_of_ten(exponent);
    long long digit = mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10;
    if (digit == 10) {
      digit = 1;
      ++exponent;
    }
    const double step = static_cast<double>(digit) * power_of_ten(exponent);
    const double first = std::ceil(range.lower / step), last = std::floor(range.upper / step);
    if (step > 0 && std::max(std::abs(first), std::abs(last)) < 1e15) {
      for (double n = first; n <= last; ++n) {
        all.push_back({n * step, decimal(static_cast<long long>(n) * digit, exponent)});
      }
    }
  }
  if (all.size() < 2) all = {{range.lower, shortest(range.lower)}, {range.upper, shortest(range.upper)}};
  return all;
}

Legend::Legend(const std::vector<Layer>& scene, const Ranges& ranges, int width, int height) {
  capital_ = std::max(7.0, std::min(width, height) / 62.0);
  for (const auto& [name, range] : ranges) {
    Block block{name, "", ticks(range), range, {}};
    for (const Layer& layer : scene) {
      if (const Attribute* attribute = layer.find(name); attribute != nullptr && block.unit.empty()) {
        block.unit = attribute->unit;
      }
    }
    blocks_.push_back(std::move(block));
  }
  std::set<std::string> listed;
  Block layers;
  std::size_t coloured = 0;
  for (const Layer& layer : scene) {
    const Attribute* const attribute = layer.colour_by.empty() ? nullptr : layer.find(layer.colour_by);
    if (attribute == nullptr) {
      const Entry entry{plain(layer), layer.name};
      const bool known = std::any_of(layers.entries.begin(), layers.entries.end(), [&](const Entry& other) {
        return other.text == entry.text && other.colour == entry.colour;
      });
      if (!known) layers.entries.push_back(entry);
    } else {
      ++coloured;
      if (attribute->categories.empty() || !listed.insert(attribute->name).second) continue;
      Block block{attribute->name, attribute->unit, {}, {}, {}};
      const std::vector<bool> used = used_categories(scene, *attribute);
      for (std::size_t i = 0; i < attribute->categories.size(); ++i) {
        if (used[i]) block.entries.push_back({category(i), attribute->categories[i]});
      }
      blocks_.push_back(std::move(block));
    }
  }
  if (layers.entries.size() > (coloured > 0 ? 0 : 1)) blocks_.push_back(std::move(layers));

  double widest = 0, fixed = 0;
  for (const Block& block : blocks_) {
    widest = std::max(widest, block_width(block));
    fixed += block_height(block) + line * capital_;
  }
  const auto bars = static_cast<double>(ranges.size());
  const double room = height - 2 * margin * capital_ - fixed;
  bar_height_ = bars > 0 ? std::floor(std::min(0.42 * height, room / bars)) : 0;
  const double needed = widest + 2 * margin * capital_;
  const bool fits = needed < 0.34 * width && (bars > 0 ? bar_height_ >= 10 * capital_ : room >= 0);
  if (blocks_.empty() || !fits) {
    blocks_.clear();
  } else {
    width_ = static_cast<int>(std::ceil(needed));
  }
}

double Legend::block_width(const Block& block) const {
  double widest = std::max(text_width(block.title, capital_), text_width(block.unit, 0.8 * capital_));
  for (const Tick& tick : block.ticks) {
    widest = std::max(widest, (bar_width + space) * capital_ + text_width(tick.text, capital_));
  }
  for (const Entry& entry : block.entries) {
    widest = std::max(widest, (bar_width + space) * capital_ + text_width(entry.text, capital_));
  }
  return widest;
}

/// Without the bar.
double Legend::block_height(const Block& block) const {
  double lines = static_cast<double>(block.entries.size());
  if (!block.title.empty()) ++lines;
  if (!block.unit.empty()) lines += 0.8;
  return lines * line * capital_;
}

void Legend::draw(Image& image, Colour ink) const {
  if (blocks_.empty()) return;
  double height = -line * capital_;
  for (const Block& block : blocks_) {
    height += block_height(block) + line * capital_ + (block.ticks.empty() ? 0 : bar_height_);
  }
  const double x = image.width - width_ + margin * capital_, beside = x + (bar_width + space) * capital_;
  double y = (image.height - height) / 2 + capital_;
  for (const Block& block : blocks_) {
    if (!block.title.empty()) {
      draw_text(image, x, y, capital_, block.title, ink);
      y += line * capital_;
    }
    if (!block.unit.empty()) {
      draw_text(image, x, y - 0.3 * capital_, 0.8 * capital_, block.unit, ink);
      y += 0.8 * line * capital_;
    }
    if (!block.ticks.empty()) {
      const double top = std::floor(y - 0.6 * capital_);  // whole rows: no two strips share one
      for (int row = 0; row < bar_height_; ++row) {
        fill(image, x, top + row, bar_width * capital_, 1, scalar(1 - (row + 0.5) / bar_height_));
      }
      for (const Tick& tick : block.ticks) {
        const double at = top + bar_height_ * (1 - block.range.place(tick.value));
        fill(image, x + bar_width * capital_, at - 0.06 * capital_, 0.4 * capital_, 0.12 * capital_, ink);
        draw_text(image, beside, at + 0.5 * capital_, capital_, tick.text, ink);
      }
      y += bar_height_;
    }
    for (const Entry& entry : block.entries) {
      fill(image, x, y - 1.15 * capital_, bar_width * capital_, bar_width * capital_, entry.colour);
      draw_text(image, beside, y, capital_, entry.text, ink);
      y += line * capital_;
    }
    y += line * capital_;
  }
}

}  // namespace ballflow::show
