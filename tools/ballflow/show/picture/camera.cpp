#include "show/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "ballflow/error.hpp"
#include "base/circle.hpp"
#include "show/picture/number.hpp"

namespace ballflow::show {
namespace {

using geometry::Box;
using geometry::dot;
using geometry::Vec3;

const std::vector<std::pair<std::string, Direction>>& named_directions() {
  // Isometric: all three axes are shortened equally, the elevation is atan(1 / sqrt 2).
  static const std::vector<std::pair<std::string, Direction>> names = {{"iso", {45, 35.264389682754654}},
                                                                       {"front", {0, 0}},
                                                                       {"back", {180, 0}},
                                                                       {"left", {-90, 0}},
                                                                       {"right", {90, 0}},
                                                                       {"top", {0, 90}},
                                                                       {"bottom", {0, -90}}};
  return names;
}

/// Calls visit(center, radius) for everything that must be seen.
template <class Visit>
void for_all_parts(const std::vector<Layer>& scene, const Visit& visit) {
  for (const Layer& layer : scene) {
    if (!layer.visible) continue;
    for (std::size_t i = 0; i < layer.vertices.size(); ++i) {
      visit(layer.vertices[i], layer.shape == Shape::balls ? layer.radii[i] : 0.0);
    }
  }
}

double middle(double lower, double upper) { return lower / 2 + upper / 2; }

}  // namespace

std::vector<std::string> direction_names() {
  std::vector<std::string> names;
  for (const auto& [name, direction] : named_directions()) names.push_back(name);
  return names;
}

Upward upward_of(const std::vector<Layer>& layers) {
  const bool jointed =
      std::any_of(layers.begin(), layers.end(), [](const Layer& layer) { return layer.chain != nullptr; });
  return jointed ? Upward::z : Upward::y;
}

Direction direction_named(const std::string& text) {
  for (const auto& [name, direction] : named_directions()) {
    if (name == text) return direction;
  }
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const auto azimuth = number_in(std::string_view(text).substr(0, comma));
    const auto elevation = number_in(std::string_view(text).substr(comma + 1));
    if (azimuth && elevation && std::abs(*azimuth) <= 360 && std::abs(*elevation) <= 90) {
      return {*azimuth, *elevation};
    }
  }
  std::string all;
  for (const std::string& name : direction_names()) all += name + ", ";
  throw Error(
      ExitCode::usage, "there is no view \"" + text + "\"",
      "use " + all + "or azimuth,elevation in degrees: 30,20 (azimuth -360 to 360, elevation -90 to 90)");
}

Camera::Camera(const std::vector<Layer>& scene, Direction from, Upward upward, const Viewport& viewport,
               double margin) {
  Box box;
  for_all_parts(scene, [&box](Vec3 center, double radius) {
    const Vec3 r{radius, radius, radius};
    box.add(center - r);
    box.add(center + r);
  });
  center_ = {middle(box.lower.x, box.upper.x), middle(box.lower.y, box.upper.y),
             middle(box.lower.z, box.upper.z)};
  const Vec3 half = box.upper - center_;
  const double extent = 2 * std::max({half.x, half.y, half.z});
  if (!std::isfinite(extent)) {
    throw Error(ExitCode::usage, "the coordinates are too large to be drawn: they span more than 1e308",
                "scale the model down");
  }
  scale_ = extent > 0 ? extent : 1;

  // With y up: at azimuth 0 the viewer is on the positive z axis, x points to the right.
  const auto [ca, sa] = geometry::on_circle(from.azimuth / 360);
  const auto [ce, se] = geometry::on_circle(from.elevation / 360);
  const auto turned = [upward](Vec3 v) { return upward == Upward::y ? v : Vec3{v.x, -v.z, v.y}; };
  right_ = turned({ca, 0, -sa});
  up_ = turned({-se * sa, ce, -se * ca});
  backward_ = turned({ce * sa, se, ce * ca});

  // Half of the longer side is seen under 15 degrees.
  constexpr double tan_15 = 0.26794919243112271;
  focal_ = std::max(viewport.width, viewport.height) / 2.0 / tan_15;
  middle_x_ = viewport.x + viewport.width / 2.0;
  middle_y_ = viewport.y + viewport.height / 2.0;

  // A ball is within a side of the pyramid of view when its center is on the inner side by its radius. Each
  // side gives one linear condition on the eye; the least distance that fulfils all of them is taken.
  const double slope_x = std::max(viewport.width / 2.0 - margin, 0.25 * viewport.width) / focal_;
  const double slope_y = std::max(viewport.height / 2.0 - margin, 0.25 * viewport.height) / focal_;
  const double length_x = std::sqrt(1 + slope_x * slope_x), length_y = std::sqrt(1 + slope_y * slope_y);
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  double at_right = nothing, at_left = nothing, at_top = nothing, at_bottom = nothing, nearest = nothing;
  for_all_parts(scene, [&](Vec3 center, double radius) {
    const Vec3 p = inward(center);
    const double x = dot(p, right_), y = dot(p, up_), z = dot(p, backward_), r = inward(radius);
    at_right = std::max(at_right, x + slope_x * z + length_x * r);
    at_left = std::max(at_left, -x + slope_x * z + length_x * r);
    at_top = std::max(at_top, y + slope_y * z + length_y * r);
    at_bottom = std::max(at_bottom, -y + slope_y * z + length_y * r);
    nearest = std::max(nearest, z + r);
  });
  eye_ = {
      (at_right - at_left) / 2, (at_top - at_bottom) / 2,
      std::max({(at_right + at_left) / (2 * slope_x), (at_top + at_bottom) / (2 * slope_y), nearest + 0.1})};
}

Vec3 Camera::inward(Vec3 point) const {
  const Vec3 p = point - center_;
  return {p.x / scale_, p.y / scale_, p.z / scale_};
}

Ray Camera::ray(double x, double y) const {
  const Vec3 towards = (x - middle_x_) * right_ + (middle_y_ - y) * up_ - focal_ * backward_;
  return {eye_.x * right_ + eye_.y * up_ + eye_.z * backward_, 1 / geometry::length(towards) * towards};
}

Camera::Place Camera::place(Vec3 point) const {
  const Vec3 p = inward(point);
  const double distance = eye_.z - dot(p, backward_);
  return {middle_x_ + focal_ * (dot(p, right_) - eye_.x) / distance,
          middle_y_ - focal_ * (dot(p, up_) - eye_.y) / distance, distance};
}

}  // namespace ballflow::show
