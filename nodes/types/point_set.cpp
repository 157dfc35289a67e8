#include "types/point_set.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace ballflow::geometry {
namespace {

// A normal that went through a text file of six digits is still a unit vector.
constexpr double unit_tolerance = 1e-5;

std::string first_not_finite(const Array<Vec3>& values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_finite(values[i])) return std::string(what) + " " + std::to_string(i) + " is not finite";
  }
  return {};
}

std::uint64_t hash(const Vec3& p) {
  // + 0.0 turns -0 into 0: the two compare equal.
  std::uint64_t h = std::bit_cast<std::uint64_t>(p.x + 0.0) * 0x9e3779b97f4a7c15ull;
  h = (h ^ (h >> 29) ^ std::bit_cast<std::uint64_t>(p.y + 0.0)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 32) ^ std::bit_cast<std::uint64_t>(p.z + 0.0)) * 0x94d049bb133111ebull;
  return h ^ (h >> 31);
}

std::string first_repeated(const Array<Vec3>& points) {
  const std::size_t slots = std::bit_ceil(2 * points.size() + 1);
  std::vector<std::size_t> table(slots, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t slot = hash(points[i]) & (slots - 1);
    for (; table[slot] != points.size(); slot = (slot + 1) & (slots - 1)) {
      if (points[table[slot]] == points[i]) {
        return "points " + std::to_string(table[slot]) + " and " + std::to_string(i) + " are equal";
      }
    }
    table[slot] = i;
  }
  return {};
}

}  // namespace

std::string broken_invariant(const PointSet& points) {
  if (std::string broken = first_not_finite(points.points, "point"); !broken.empty()) return broken;
  if (std::string broken = first_repeated(points.points); !broken.empty()) return broken;
  if (points.normals.empty()) return {};
  if (points.normals.size() != points.points.size()) {
    return std::to_string(points.points.size()) + " points have " + std::to_string(points.normals.size()) +
           " normals";
  }
  for (std::size_t i = 0; i < points.normals.size(); ++i) {
    // Written so that nan fails.
    if (!(std::abs(length(points.normals[i]) - 1) <= unit_tolerance)) {
      return "normal " + std::to_string(i) + " is not a unit vector";
    }
  }
  return {};
}

}  // namespace ballflow::geometry
