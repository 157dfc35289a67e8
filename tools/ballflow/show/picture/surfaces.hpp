// What layers look like where a ray meets them: their bodies, colours and normals.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "show/palette.hpp"
#include "show/picture/camera.hpp"
#include "show/picture/light.hpp"
#include "show/picture/ray_caster.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

/// Radii of points and half widths of lines.
struct Strokes {
  double point = 0, line = 0;  // pixels
};

/// The range of values of every attribute that visible layers are coloured by, by its name.
using Ranges = std::map<std::string, ValueRange>;
Ranges ranges_of(const std::vector<Layer>& scene);

/// The colours of the elements of a layer.
class Paint {
 public:
  Paint(const Layer& layer, const Ranges& ranges);

  Light of_element(std::size_t i) const { return at(i); }
  /// Between vertices, with these weights. Values are interpolated, not colours.
  Light between(std::size_t a, std::size_t b, double of_b) const;
  Light between(const std::array<std::uint32_t, 3>& corners, double of_b, double of_c) const;

  bool per_vertex() const { return per_vertex_; }

 private:
  Light at(std::size_t i) const;

  Light plain_;
  std::vector<float> values_;  // places in the range or numbers of categories; empty when plain
  bool categories_ = false, per_vertex_ = true;
};

/// A point of a surface as the camera sees it.
struct SurfacePoint {
  geometry::Vec3 position;
  geometry::Vec3 normal;  // of length 1, of the smooth surface; towards the camera
  geometry::Vec3 facet;   // of length 1, of the surface that rays meet; towards the camera
  Light colour;
};

class Surfaces {
 public:
  /// The visible layers of `scene`; it and `camera` outlive this.
  Surfaces(const std::vector<Layer>& scene, const Ranges& ranges, const Camera& camera, Strokes strokes);

  /// The bodies of all layers that are opaque, or of all that are not.
  Bodies bodies(bool opaque) const;

  /// `cut`: the normal of the plane where the interval of the ray begins, for hits on cut balls.
  SurfacePoint point(const Bodies& bodies, const Ray& ray, const Hit& hit, geometry::Vec3 cut) const;

  const Layer& layer(Origin origin) const { return scene_[origin.layer]; }

 private:
  geometry::Vec3 normal(Origin origin, const Triangle3& triangle, const TriangleHit& hit) const;

  const std::vector<Layer>& scene_;
  const Camera& camera_;
  Strokes strokes_;
  std::vector<Paint> paints_;                                        // by layer
  std::vector<std::vector<std::array<geometry::Vec3, 3>>> corners_;  // normals, by layer; empty for facets
};

}  // namespace ballflow::show
