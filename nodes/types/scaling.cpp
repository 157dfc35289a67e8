#include "types/scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ballflow::geometry {

double Scaling::largest_factor() const { return std::max({factors.x, factors.y, factors.z}); }

std::string describe(const Scaling& scaling) {
  static constexpr std::array<const char*, 3> sources{"mean chords", "extents", "factors as given"};
  char text[240];
  const Vec3 f = scaling.factors, t = scaling.thickness;
  const char* const source = sources[std::min<std::size_t>(scaling.thickness_from, 2)];
  if (scaling.thickness_from == static_cast<std::uint8_t>(ThicknessFrom::given)) {
    std::snprintf(text, sizeof text, "stretched by %.3g x %.3g x %.3g (%s)", f.x, f.y, f.z, source);
  } else {
    std::snprintf(text, sizeof text, "stretched by %.3g x %.3g x %.3g (%s %.3g x %.3g x %.3g)", f.x, f.y, f.z,
                  source, t.x, t.y, t.z);
  }
  return text;
}

std::string broken_invariant(const Scaling& scaling) {
  const Vec3 f = scaling.factors;
  if (!is_finite(scaling.origin)) return "the origin is not finite";
  if (!is_finite(f) || std::min({f.x, f.y, f.z}) != 1) {
    return "the factors " + std::to_string(f.x) + ", " + std::to_string(f.y) + ", " + std::to_string(f.z) +
           " do not begin with 1 as the least";
  }
  const Quaternion q = scaling.rotation;
  if (!(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) <= 2e-9)) {
    return "the quaternion has not the length 1";
  }
  if (!is_finite(scaling.thickness) || !std::isfinite(scaling.longest_edge) || scaling.longest_edge < 0) {
    return "a length is negative or not finite";
  }
  if (scaling.thickness_from > static_cast<std::uint8_t>(ThicknessFrom::given)) {
    return "thickness_from is " + std::to_string(scaling.thickness_from);
  }
  return {};
}

}  // namespace ballflow::geometry
