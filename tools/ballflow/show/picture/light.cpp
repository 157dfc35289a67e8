#include "show/picture/light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ballflow::show {
namespace {

/// x to the power of 2.4, for x in (0, 1]: the 12th power of the fifth root, which Newton's method finds.
double power_2_4(double x) {
  double root = 1;
  for (int i = 0; i < 60; ++i) {
    const double fourth = root * root * root * root;
    root -= (root * fourth - x) / (5 * fourth);
  }
  const double square = root * root, fourth = square * square;
  return fourth * fourth * fourth;
}

double decoded(double value) { return value <= 0.04045 ? value / 12.92 : power_2_4((value + 0.055) / 1.055); }

/// `offset` 0: the light of every channel value; 0.5: that halfway to the next one.
std::array<double, 256> table(double offset) {
  std::array<double, 256> lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i] = decoded((static_cast<double>(i) + offset) / 255);
  }
  return lights;
}

std::uint8_t channel_of(double light) {
  static const std::array<double, 256> limits = table(0.5);
  // The last limit is beyond white.
  return static_cast<std::uint8_t>(std::lower_bound(limits.begin(), limits.end() - 1, light) -
                                   limits.begin());
}

}  // namespace

double light_of_channel(std::uint8_t channel) {
  static const std::array<double, 256> lights = table(0);
  return lights[channel];
}

Light light_of(Colour colour) {
  return {light_of_channel(colour.red), light_of_channel(colour.green), light_of_channel(colour.blue)};
}

Colour colour_of(Light light) { return {channel_of(light.x), channel_of(light.y), channel_of(light.z)}; }

}  // namespace ballflow::show
