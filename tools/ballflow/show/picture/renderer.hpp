// The light that pixels of one view of a scene get.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "show/picture/camera.hpp"
#include "show/picture/light.hpp"
#include "show/picture/ray_caster.hpp"
#include "show/picture/surfaces.hpp"

namespace ballflow::show {

/// What lies beyond the plane is cut off: points p with dot(normal, p) > offset, in the camera's coordinates.
struct CutPlane {
  geometry::Vec3 normal;
  double offset = 0;
};

/// How much of a pixel is covered, and the light from what covers it.
struct Pixel {
  Light light;  // multiplied by coverage
  double coverage = 0;
};

/// Lambertian surfaces under a sky, of which the surroundings hide a part (ambient occlusion), and a lamp
/// with soft shadows to the upper left of the viewer. Opaque layers hide and cast shadows; the others only
/// lie over what is behind them, as thin sheets: the more oblique, the denser. Of balls that are not opaque
/// the boundary of their union is seen.
///
/// How much of sky and lamp a point sees is found by few rays per pixel, in patterns that differ within every
/// 4 x 4 pixels, and averaged over as many pixels of the same surface. Patterns are fixed, so equal scenes
/// give equal pictures. Thread-safe once constructed.
class Renderer {
 public:
  /// `scene` and `camera` outlive this. Throws Cancelled.
  Renderer(const std::vector<Layer>& scene, const Ranges& ranges, const Camera& camera,
           std::vector<CutPlane> planes, Strokes strokes, geometry::Monitor& monitor);

  /// Pixels from (x, y) on, row by row. Throws Cancelled.
  std::vector<Pixel> tile(int x, int y, int width, int height, geometry::Monitor& monitor) const;

 private:
  /// What is seen through one place of the picture.
  struct Sample {
    Light front{0, 0, 0};  // of sheets before the surface
    double through = 1;    // part of the light from the surface that passes them
    bool solid = false;    // there is an opaque surface
    SurfacePoint point;    // of it
    double pixel = 0;      // size of a pixel there
  };

  /// Parts of sky and lamp that a point sees.
  struct Open {
    double sky = 1, lamp = 1;
  };

  /// A part of the ray that no plane cuts off, and the normal of the plane that cuts its beginning.
  struct Kept {
    Interval interval;
    geometry::Vec3 cut;
  };

  static bool alike(const Sample& a, const Sample& b);
  Kept kept(const Ray& ray) const;
  Sample sample(double x, double y, std::vector<Hit>& hits) const;
  void add_sheets(const Ray& ray, const Kept& part, std::vector<Hit>& hits, Sample& sample) const;
  Open open(const SurfacePoint& point, int pattern) const;
  Light shaded(const SurfacePoint& point, const Open& open) const;
  bool free(const geometry::Vec3& from, const geometry::Vec3& towards, double distance) const;

  const Camera& camera_;
  std::vector<CutPlane> planes_;
  Surfaces surfaces_;
  RayCaster opaque_, sheets_;
  geometry::Vec3 lamp_, lamp_x_, lamp_y_;
};

}  // namespace ballflow::show
