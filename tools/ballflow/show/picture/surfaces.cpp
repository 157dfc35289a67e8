#include "show/picture/surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::show {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::length;
using geometry::Vec3;

using CornerNormals = std::vector<std::array<Vec3, 3>>;

Vec3 unit(Vec3 v, Vec3 otherwise) {
  const double l = length(v);
  return l > 0 ? 1 / l * v : otherwise;
}

/// The normal at each corner of each triangle: the mean over the triangles around the vertex that are at most
/// 40 degrees off, so that sharp edges stay sharp. Orientations may differ. A vertex with very many triangles
/// is the apex of a fan and keeps facets.
CornerNormals smooth_normals(const Layer& layer, const Camera& camera) {
  constexpr double cos_40 = 0.766044443118978;
  constexpr std::size_t most = 64;
  const auto& triangles = layer.triangles;
  std::vector<Vec3> areas, units;  // vectors along the normals, by triangle
  std::vector<std::size_t> begin(layer.vertices.size() + 1, 0);
  for (const auto& [a, b, c] : triangles) {
    const Vec3 p = camera.inward(layer.vertices[a]);
    areas.push_back(cross(camera.inward(layer.vertices[b]) - p, camera.inward(layer.vertices[c]) - p));
    units.push_back(unit(areas.back(), {0, 0, 0}));
    for (const std::uint32_t v : {a, b, c}) ++begin[v + 1];
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<std::uint32_t> around(3 * triangles.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t v : triangles[i]) around[next[v]++] = static_cast<std::uint32_t>(i);
  }
  CornerNormals normals(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles[i][k];
      Vec3 sum{0, 0, 0};
      if (begin[v + 1] - begin[v] <= most) {
        for (std::size_t j = begin[v]; j < begin[v + 1]; ++j) {
          const double cosine = dot(units[i], units[around[j]]);
          if (std::abs(cosine) >= cos_40) sum = sum + (cosine < 0 ? -1.0 : 1.0) * areas[around[j]];
        }
      }
      normals[i][k] = unit(sum, units[i]);
    }
  }
  return normals;
}

}  // namespace

Ranges ranges_of(const std::vector<Layer>& scene) {
  Ranges ranges;
  for (const Layer& layer : scene) {
    const Attribute* const attribute = layer.colour_by.empty() ? nullptr : layer.find(layer.colour_by);
    if (!layer.visible || attribute == nullptr || !attribute->categories.empty()) continue;
    ranges[attribute->name] = value_range(scene, attribute->name);
  }
  return ranges;
}

Paint::Paint(const Layer& layer, const Ranges& ranges) : plain_(light_of(plain(layer))) {
  const Attribute* const attribute = layer.colour_by.empty() ? nullptr : layer.find(layer.colour_by);
  if (attribute == nullptr) return;
  categories_ = !attribute->categories.empty();
  per_vertex_ = attribute->per_vertex;
  const auto known = ranges.find(attribute->name);
  const ValueRange range = known != ranges.end() ? known->second : ValueRange{};
  values_.reserve(attribute->values.size());
  for (const double value : attribute->values) {
    values_.push_back(static_cast<float>(categories_ ? value : range.place(value)));
  }
}

Light Paint::at(std::size_t i) const {
  if (values_.empty()) return plain_;
  const auto value = static_cast<double>(values_[i]);
  return light_of(categories_ ? category(static_cast<std::size_t>(value)) : scalar(value));
}

Light Paint::between(std::size_t a, std::size_t b, double of_b) const {
  if (values_.empty() || categories_) return at(of_b < 0.5 ? a : b);
  return light_of(
      scalar((1 - of_b) * static_cast<double>(values_[a]) + of_b * static_cast<double>(values_[b])));
}

Light Paint::between(const std::array<std::uint32_t, 3>& corners, double of_b, double of_c) const {
  const double of_a = 1 - of_b - of_c;
  if (values_.empty() || categories_) {
    return at(of_a >= of_b && of_a >= of_c ? corners[0] : of_b >= of_c ? corners[1] : corners[2]);
  }
  return light_of(scalar(of_a * static_cast<double>(values_[corners[0]]) +
                         of_b * static_cast<double>(values_[corners[1]]) +
                         of_c * static_cast<double>(values_[corners[2]])));
}

Surfaces::Surfaces(const std::vector<Layer>& scene, const Ranges& ranges, const Camera& camera,
                   Strokes strokes)
    : scene_(scene), camera_(camera), strokes_(strokes), corners_(scene.size()) {
  for (std::size_t i = 0; i < scene.size(); ++i) {
    paints_.emplace_back(scene[i], ranges);
    if (scene[i].visible && scene[i].smooth) corners_[i] = smooth_normals(scene[i], camera);
  }
}

Bodies Surfaces::bodies(bool opaque) const {
  Bodies all;
  std::vector<Origin> of_capsules, of_triangles;
  for (std::size_t number = 0; number < scene_.size(); ++number) {
    const Layer& layer = scene_[number];
    if (!layer.visible || (layer.opacity >= 1) != opaque) continue;
    const auto vertex = [&](std::size_t v) { return camera_.inward(layer.vertices[v]); };
    for (std::size_t i = 0; i < layer.elements(); ++i) {
      const Origin origin{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(i)};
      switch (layer.shape) {
        case Shape::points:
          all.balls.push_back({vertex(i), strokes_.point * camera_.pixel()});
          all.origins.push_back(origin);
          break;
        case Shape::balls:
          all.balls.push_back({vertex(i), camera_.inward(layer.radii[i])});
          all.origins.push_back(origin);
          break;
        case Shape::segments: {
          const auto& [a, b] = layer.segments[i];
          all.capsules.push_back({vertex(a), vertex(b), strokes_.line * camera_.pixel()});
          of_capsules.push_back(origin);
          break;
        }
        case Shape::triangles: {
          const auto& [a, b, c] = layer.triangles[i];
          all.triangles.push_back({vertex(a), vertex(b), vertex(c)});
          of_triangles.push_back(origin);
          break;
        }
      }
    }
  }
  all.origins.insert(all.origins.end(), of_capsules.begin(), of_capsules.end());
  all.origins.insert(all.origins.end(), of_triangles.begin(), of_triangles.end());
  return all;
}

SurfacePoint Surfaces::point(const Bodies& bodies, const Ray& ray, const Hit& hit, Vec3 cut) const {
  const Origin origin = bodies.origins[hit.body];
  const Layer& from = scene_[origin.layer];
  const Paint& paint = paints_[origin.layer];
  SurfacePoint point;
  point.position = ray.at(hit.t);
  const std::size_t capsules = bodies.balls.size(), triangles = capsules + bodies.capsules.size();
  if (hit.body < capsules) {
    const Ball& ball = bodies.balls[hit.body];
    point.normal = hit.power < 0 ? cut : unit(point.position - ball.center, cut);
    point.facet = point.normal;
    point.colour = paint.of_element(origin.element);
  } else if (hit.body < triangles) {
    const Capsule& capsule = bodies.capsules[hit.body - capsules];
    const double place = capsule.place(point.position);
    const Vec3 nearest = (1 - place) * capsule.a + place * capsule.b;
    point.normal = point.facet = unit(point.position - nearest, -ray.direction);
    const auto& [a, b] = from.segments[origin.element];
    point.colour = paint.per_vertex() ? paint.between(a, b, place) : paint.of_element(origin.element);
  } else {
    const Triangle3& triangle = bodies.triangles[hit.body - triangles];
    const TriangleHit where = meeting(ray, triangle).value_or(TriangleHit{});
    point.facet = unit(cross(triangle.b - triangle.a, triangle.c - triangle.a), -ray.direction);
    point.normal = normal(origin, triangle, where);
    point.colour = paint.per_vertex() ? paint.between(from.triangles[origin.element], where.of_b, where.of_c)
                                      : paint.of_element(origin.element);
  }
  if (dot(point.facet, ray.direction) > 0) point.facet = -point.facet;
  if (dot(point.normal, point.facet) < 0) point.normal = -point.normal;
  return point;
}

Vec3 Surfaces::normal(Origin origin, const Triangle3& triangle, const TriangleHit& hit) const {
  const Vec3 facet = unit(cross(triangle.b - triangle.a, triangle.c - triangle.a), {0, 0, 1});
  const CornerNormals& corners = corners_[origin.layer];
  if (corners.empty()) return facet;
  const auto& [a, b, c] = corners[origin.element];
  return unit((1 - hit.of_b - hit.of_c) * a + hit.of_b * b + hit.of_c * c, facet);
}

}  // namespace ballflow::show
