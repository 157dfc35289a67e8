// Light: amounts that add up, not the sRGB values of files. Only arithmetic and sqrt, as for artifacts.
#pragma once

#include <cstdint>

#include "base/vec3.hpp"
#include "show/palette.hpp"

namespace ballflow::show {

/// Red, green and blue light, 0 for none and 1 for white. x, y, z are the three.
using Light = geometry::Vec3;

/// The light of an sRGB colour (IEC 61966-2-1), and the nearest colour of a light, clamped.
Light light_of(Colour colour);
Colour colour_of(Light light);

/// The light that a channel of sRGB stands for.
double light_of_channel(std::uint8_t channel);

/// `from` where t is 0, `to` where t is 1.
inline Light mixed(Light from, Light to, double t) { return (1 - t) * from + t * to; }

}  // namespace ballflow::show
