#include "enclose/surface_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/space_order.hpp"

namespace ballflow::geometry {
namespace {

using Corner3 = std::array<Vec3, 3>;

std::size_t longest_side(const Corner3& p) {
  std::array<double, 3> squared{};
  for (std::size_t k = 0; k < 3; ++k) squared[k] = squared_distance(p[(k + 1) % 3], p[(k + 2) % 3]);
  return static_cast<std::size_t>(std::max_element(squared.begin(), squared.end()) - squared.begin());
}

/// The number of each point in the list of different ones, which runs along a space-filling curve.
std::vector<std::int32_t> numbered(const std::vector<Vec3>& points, std::vector<Vec3>& different) {
  const SpaceOrder place(bounding_box(points));
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Vec3 p : points) keys.push_back(place(p));
  std::vector<std::int32_t> order(points.size()), number(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const std::uint64_t p = keys[static_cast<std::size_t>(a)], q = keys[static_cast<std::size_t>(b)];
    return p != q ? p < q : at(a) < at(b);
  });
  for (const std::int32_t i : order) {
    if (different.empty() || !(different.back() == at(i))) different.push_back(at(i));
    number[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(different.size()) - 1;
  }
  return number;
}

/// Numbers and orders patches of which the corners are known.
SurfacePatches ordered(const std::vector<Vec3>& points) {
  SurfacePatches result;
  const std::vector<std::int32_t> number = numbered(points, result.vertices);
  result.corners.reserve(points.size() / 3);
  for (std::size_t p = 0; p < points.size(); p += 3) {
    std::array<std::int32_t, 3> corners{number[p], number[p + 1], number[p + 2]};
    std::sort(corners.begin(), corners.end());
    result.corners.push_back(corners);
  }
  std::sort(result.corners.begin(), result.corners.end());
  result.corners.erase(std::unique(result.corners.begin(), result.corners.end()), result.corners.end());
  const SpaceOrder place(bounding_box(result.vertices));
  const auto key = [&](const std::array<std::int32_t, 3>& c) {
    Vec3 sum;
    for (const std::int32_t v : c) sum = sum + result.vertices[static_cast<std::size_t>(v)];
    return place(1.0 / 3 * sum);
  };
  std::vector<std::pair<std::uint64_t, std::array<std::int32_t, 3>>> order;
  order.reserve(result.corners.size());
  for (const auto& corners : result.corners) order.emplace_back(key(corners), corners);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) result.corners[i] = order[i].second;
  return result;
}

}  // namespace

SurfacePatches surface_patches(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               double longest) {
  std::vector<Vec3> points;  // three for each patch
  std::vector<Corner3> waiting;
  for (const Triangle& triangle : triangles) {
    Corner3 whole;
    for (std::size_t k = 0; k < 3; ++k) whole[k] = vertices[static_cast<std::size_t>(triangle[k])];
    waiting.push_back(whole);
    while (!waiting.empty()) {
      const Corner3 part = waiting.back();
      waiting.pop_back();
      const std::size_t k = longest_side(part);
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const Vec3 middle = 0.5 * (part[i] + part[j]);
      if (distance(part[i], part[j]) <= longest || middle == part[i] || middle == part[j]) {
        points.insert(points.end(), part.begin(), part.end());
        continue;
      }
      Corner3 first = part, second = part;
      first[i] = middle;
      second[j] = middle;
      waiting.push_back(first);
      waiting.push_back(second);
    }
  }
  return ordered(points);
}

SurfacePatches refined(const SurfacePatches& patches, const std::vector<std::uint8_t>& cut, double shortest) {
  std::vector<Vec3> points;
  for (std::size_t p = 0; p < patches.corners.size(); ++p) {
    Corner3 part;
    for (std::size_t k = 0; k < 3; ++k)
      part[k] = patches.vertices[static_cast<std::size_t>(patches.corners[p][k])];
    const std::size_t k = longest_side(part);
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (cut[p] == 0 || distance(part[i], part[j]) <= shortest) {
      points.insert(points.end(), part.begin(), part.end());
      continue;
    }
    Corner3 first = part, second = part;
    first[i] = second[j] = 0.5 * (part[i] + part[j]);
    points.insert(points.end(), first.begin(), first.end());
    points.insert(points.end(), second.begin(), second.end());
  }
  return ordered(points);
}

double surface_area(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 p = vertices[static_cast<std::size_t>(a)];
    area += 0.5 * length(cross(vertices[static_cast<std::size_t>(b)] - p,
                               vertices[static_cast<std::size_t>(c)] - p));
  }
  return area;
}

}  // namespace ballflow::geometry
