// From where a scene is seen.
#pragma once

#include <string>
#include <vector>

#include "show/picture/intersect.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

/// Where the viewer is, seen from the middle of the scene. Degrees.
struct Direction {
  double azimuth = 30;    // around the upward axis, counter-clockwise seen from above; 0 is the front
  double elevation = 20;  // above the horizon
};

/// The names that direction_named knows.
std::vector<std::string> direction_names();

/// iso, front, back, left, right, top, bottom, or "azimuth,elevation". Throws Error (code usage).
Direction direction_named(const std::string& text);

/// The axis of the model that points up in pictures. The front is seen along -z when y is up, and along y
/// when z is up.
enum class Upward { y, z };

/// z where something moves in joints, since descriptions of robots stand on z = 0; else y.
Upward upward_of(const std::vector<Layer>& layers);

/// Part of a picture, in pixels.
struct Viewport {
  int x = 0, y = 0, width = 1, height = 1;
};

/// A perspective camera, turned towards the scene and just so far away that all of it is seen. Works in the
/// coordinates that `inward` gives: the bounding box of the scene is around the origin and its longest edge
/// is 1.
class Camera {
 public:
  /// `scene` are the layers that must be seen: the visible ones, of which there is at least one element. At
  /// `margin` pixels from the sides of the viewport nothing is seen.
  Camera(const std::vector<Layer>& scene, Direction from, Upward up, const Viewport& viewport, double margin);

  /// From model units.
  geometry::Vec3 inward(geometry::Vec3 point) const;
  double inward(double length) const { return length / scale_; }

  /// Through a place in the picture: pixel (x, y) spans from x to x + 1 and y to y + 1, downwards.
  Ray ray(double x, double y) const;

  /// The place in the picture of a point in model units.
  struct Place {
    double x = 0, y = 0, distance = 0;
  };
  Place place(geometry::Vec3 point) const;

  /// Size of a pixel at this distance from the camera, and in the middle of the scene.
  double pixel_at(double distance) const { return distance / focal_; }
  double pixel() const { return pixel_at(eye_.z); }

  geometry::Vec3 right() const { return right_; }
  geometry::Vec3 up() const { return up_; }
  geometry::Vec3 backward() const { return backward_; }  // from the scene to the viewer

 private:
  geometry::Vec3 center_, right_, up_, backward_;
  double scale_ = 1;
  geometry::Vec3 eye_;                              // along right_, up_, backward_
  double focal_ = 1, middle_x_ = 0, middle_y_ = 0;  // pixels
};

}  // namespace ballflow::show
