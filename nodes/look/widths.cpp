#include "look/widths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/arctangent.hpp"
#include "search/surface_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Ruler {
 public:
  Ruler(const TriangleMesh& mesh, const WidthsOptions& options, Monitor& monitor)
      : mesh_(mesh),
        tree_(mesh, monitor),
        // Within 1e-12 of the angle: a test by formulas gives the angle itself.
        least_cosine_(cosine(options.largest_angle * 0.017453292519943295) - 1e-12),
        whole_(2 * bounding_box(mesh.vertices.span()).longest_edge()) {}

  /// What lies opposite to a triangle on the side that `direction` says, 1 where it faces, -1 behind it, and
  /// is nearer than `limit`.
  std::optional<Width> opposite(std::int32_t t, double direction, double limit) const {
    const Vec3 normal = tree_.normal(t);
    if (normal == Vec3{}) return std::nullopt;
    const auto [a, b, c] = corners(t);
    const Vec3 middle = (1.0 / 3) * (a + b + c);
    const auto hit = tree_.first_hit(middle, direction * normal, 1e-9 * whole_, std::min(limit, whole_));
    if (!hit || dot(normal, tree_.normal(hit->triangle)) > -least_cosine_) return std::nullopt;
    for (const std::int32_t v : mesh_.triangles[static_cast<std::size_t>(t)]) {
      for (const std::int32_t w : mesh_.triangles[static_cast<std::size_t>(hit->triangle)]) {
        if (v == w) return std::nullopt;
      }
    }
    return Width{hit->distance, middle, hit->point, t, hit->triangle};
  }

  double longest_edge(std::int32_t t) const {
    const auto [a, b, c] = corners(t);
    return std::sqrt(std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
  }

 private:
  std::array<Vec3, 3> corners(std::int32_t t) const {
    const Triangle& ids = mesh_.triangles[static_cast<std::size_t>(t)];
    const auto vertex = [&](std::int32_t v) { return mesh_.vertices[static_cast<std::size_t>(v)]; };
    return {vertex(ids[0]), vertex(ids[1]), vertex(ids[2])};
  }

  const TriangleMesh& mesh_;
  SurfaceTree tree_;
  double least_cosine_, whole_;
};

}  // namespace

Widths widths_of(const TriangleMesh& mesh, const WidthsOptions& options, Monitor& monitor) {
  Widths result;
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  if (options.list_walls) result.walls.assign(mesh.triangles.size(), infinity);
  if (count == 0) return result;
  Lookout look(monitor);
  const Ruler ruler(mesh, options, monitor);
  const std::int64_t step = std::max<std::int64_t>(1, (count + options.places - 1) / options.places);
  // What is neither nearer than the nearest so far nor than the triangle is long changes nothing.
  const auto limit = [&](const std::optional<Width>& best, double size) {
    return options.list_walls || !best ? infinity : std::max(best->width, size);
  };
  const auto keep = [](std::optional<Width>& best, const Width& width) {
    if (!best || width.width < best->width) best = width;
  };
  for (std::int64_t t = 0; t < count; t += step) {
    look(256);
    ++result.places;
    const auto triangle = static_cast<std::int32_t>(t);
    const double size = ruler.longest_edge(triangle);
    if (const auto wall = ruler.opposite(triangle, -1, limit(result.wall, size))) {
      if (options.list_walls) result.walls[static_cast<std::size_t>(t)] = wall->width;
      result.thin_walls += wall->width < size;
      keep(result.wall, *wall);
    }
    if (const auto slot = ruler.opposite(triangle, 1, limit(result.slot, size))) {
      result.narrow_slots += slot->width < size;
      keep(result.slot, *slot);
    }
  }
  return result;
}

}  // namespace ballflow::geometry
