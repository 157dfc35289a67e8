#include "sample/frame_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

class Frame {
 public:
  Frame(double r, std::int64_t n) : r_(r) {
    // 24 k (p + q) vertices: k a side of a square, p rings of quadrangles in the plane and q on the ball,
    // which are about 3/10 and 2/10 of k where quadrangles are squares.
    const double sides = std::max(2.0, std::round(std::sqrt(static_cast<double>(n) / 12)));
    const double rings = std::max(2.0, std::round(static_cast<double>(n) / (24 * sides)));
    sides_ = static_cast<int>(sides);
    plane_ = static_cast<int>(std::max(1.0, std::round(0.6 * rings)));
    ball_ = static_cast<int>(std::max(1.0, rings - std::round(0.6 * rings)));
  }

  TriangleMesh mesh() {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        for (int i = 0; i < 4 * sides_; ++i) {
          for (int j = 0; j < plane_; ++j) {
            quadrangle([&](int u, int v) { return placed(in_plane(i + u, j + v), axis, sign); },
                       placed({0, 0, 1}, axis, sign));
          }
          for (int j = 0; j < ball_; ++j) {
            const auto corner = [&](int u, int v) { return placed(on_ball(i + u, j + v), axis, sign); };
            quadrangle(corner, -1 * corner(0, 0));  // the solid is around the ball
          }
        }
      }
    }
    return {std::move(vertices_), std::move(triangles_)};
  }

 private:
  /// A point of the square around [-1, 1]^2, one of 4 k.
  std::array<double, 2> on_square(int i) const {
    i %= 4 * sides_;
    const double s = static_cast<double>(2 * (i % sides_) - sides_) / sides_;
    switch (i / sides_) {
      case 0:
        return {1, s};
      case 1:
        return {-s, 1};
      case 2:
        return {-1, -s};
      default:
        return {s, -1};
    }
  }
  /// Where the ball meets the plane z = 1.
  Vec3 on_rim(int i) const {
    const auto [x, y] = on_square(i);
    const double scale = std::sqrt(r_ * r_ - 1) / std::sqrt(x * x + y * y);
    return {scale * x, scale * y, 1};
  }
  /// Rings from the square to the rim.
  Vec3 in_plane(int i, int j) const {
    const auto [x, y] = on_square(i);
    if (j == 0) return {x, y, 1};
    if (j == plane_) return on_rim(i);
    const double t = static_cast<double>(j) / plane_;
    return (1 - t) * Vec3{x, y, 1} + t * on_rim(i);
  }
  /// Rings from the rim to where the planes x = z and y = z, and their mirror images, meet the ball.
  Vec3 on_ball(int i, int j) const {
    if (j == 0) return on_rim(i);
    const auto [x, y] = on_square(i);
    const double scale = r_ / std::sqrt(x * x + y * y + 1);
    const Vec3 corner{scale * x, scale * y, scale};
    if (j == ball_) return corner;
    const double t = static_cast<double>(j) / ball_;
    const Vec3 chord = (1 - t) * on_rim(i) + t * corner;
    return r_ / length(chord) * chord;
  }
  /// From the side z = 1 to another one; equal points of two sides have equal coordinates but for the order
  /// of additions, which numbers_ does not see.
  static Vec3 placed(Vec3 p, int axis, double sign) {
    const double z = sign * p.z;
    return axis == 2 ? Vec3{p.x, p.y, z} : axis == 0 ? Vec3{z, p.x, p.y} : Vec3{p.y, z, p.x};
  }

  std::int32_t number(Vec3 p) {
    constexpr double steps = 0x1p30;
    const std::array<double, 3> key{std::round(steps * p.x) + 0.0, std::round(steps * p.y) + 0.0,
                                    std::round(steps * p.z) + 0.0};
    const auto [found, added] = numbers_.try_emplace(key, static_cast<std::int32_t>(vertices_.size()));
    if (added) vertices_.push_back(p);
    return found->second;
  }

  template <class Corner>
  void quadrangle(const Corner& corner, Vec3 outwards) {
    const Vec3 a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
    if (distance(a, c) <= distance(b, d)) {
      triangle(a, b, c, outwards);
      triangle(a, c, d, outwards);
    } else {
      triangle(a, b, d, outwards);
      triangle(b, c, d, outwards);
    }
  }
  void triangle(Vec3 a, Vec3 b, Vec3 c, Vec3 outwards) {
    if (dot(cross(b - a, c - a), outwards) < 0) std::swap(b, c);
    triangles_.push_back({number(a), number(b), number(c)});
  }

  double r_;
  int sides_, plane_, ball_;
  std::map<std::array<double, 3>, std::int32_t> numbers_;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace

TriangleMesh frame_mesh(double r, std::int64_t n) { return Frame(r, n).mesh(); }

}  // namespace ballflow::geometry
