#include "prior/shape_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "prior/cloud.hpp"
#include "prior/shape_instance.hpp"
#include "prior/smooth_map.hpp"
#include "search/self_intersection.hpp"

namespace ballflow::geometry {
namespace {

// A dense system, whose time grows with the cube of this; models have 1000 points unless asked otherwise.
constexpr std::size_t most_anchors = 1500;
constexpr std::size_t most_pairs = 100'000;
constexpr std::size_t block = 256;

struct Anchors {
  std::vector<Vec3> from, to;
};

/// Evenly chosen pairs; points that are there twice count once.
Anchors anchors_of(std::span<const Vec3> from, std::span<const Vec3> to, Monitor& monitor) {
  Anchors anchors;
  const std::vector<std::int32_t> chosen = farthest_points(from, most_anchors, monitor);
  std::vector<std::pair<Vec3, std::size_t>> sorted;
  for (const std::int32_t i : chosen) {
    const auto at = static_cast<std::size_t>(i);
    sorted.emplace_back(from[at], at);
  }
  const auto key = [](const std::pair<Vec3, std::size_t>& p) {
    return std::tuple(p.first.x, p.first.y, p.first.z, p.second);
  };
  std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  for (const auto& [point, at] : sorted) {
    if (!anchors.from.empty() && anchors.from.back() == point) continue;
    anchors.from.push_back(point);
    anchors.to.push_back(to[at]);
  }
  return anchors;
}

struct Moved {
  std::vector<Vec3> vertices;
  std::int64_t folded = 0;
};

Moved moved_along(const SmoothMap& map, const TriangleMesh& mesh, Monitor& monitor, double begin,
                  double end) {
  const std::size_t n = mesh.vertices.size();
  Moved moved;
  moved.vertices.resize(n);
  std::vector<std::uint8_t> inside_out(n);
  for_each_block(n, block, monitor, begin, end, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      moved.vertices[i] = map.at(mesh.vertices[i]) + Vec3{0, 0, 0};  // no -0
      inside_out[i] = map.volume_factor(mesh.vertices[i]) > 0 ? 0 : 1;
    }
  });
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](int corner) {
      return inside_out[static_cast<std::size_t>(t[static_cast<std::size_t>(corner)])] != 0;
    };
    moved.folded += at(0) || at(1) || at(2) ? 1 : 0;
  }
  return moved;
}

std::int64_t intersections_of(const TriangleMesh& mesh, Monitor& monitor) {
  TriangleMesh proper;  // triangles that repeat a vertex have no inside
  proper.vertices = mesh.vertices;
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  const std::size_t repeated = mesh.triangles.size() - triangles.size();
  proper.triangles = std::move(triangles);
  const SelfIntersections found = self_intersections(proper, most_pairs, monitor);
  return static_cast<std::int64_t>(found.pairs.size() + found.flat.size() + repeated);
}

double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  const Vec3 origin = mesh.vertices.empty() ? Vec3{} : mesh.vertices[0];
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])] - origin; };
    sum += dot(corner(0), cross(corner(1), corner(2)));
  }
  return sum / 6;
}

void measure_distances(const TriangleMesh& mesh, const Balls& balls, ShapeMeshCheck& check,
                       Monitor& monitor) {
  const std::size_t n = mesh.vertices.size();
  if (n == 0 || balls.size() == 0) return;
  std::vector<double> distances(n);
  for_each_block(n, block, monitor, 0.9, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t ball = 0; ball < balls.size(); ++ball)
        least = std::min(least, distance(mesh.vertices[i], balls.centers[ball]) - balls.radii[ball]);
      distances[i] = std::abs(least);
    }
  });
  double sum = 0;
  for (const double d : distances) {
    sum += d;
    check.largest_distance = std::max(check.largest_distance, d);
  }
  check.mean_distance = sum / static_cast<double>(n);
}

std::string triangles_in_words(std::int64_t n) {
  return std::to_string(n) + (n == 1 ? " triangle" : " triangles");
}

}  // namespace

TriangleMesh mesh_of_mean(const ShapePrior& prior, const TriangleMesh& surface, const PointSet& points,
                          Monitor& monitor) {
  if (prior.points.empty() || points.points.size() != prior.points.size()) {
    throw InputError("the template has " + std::to_string(points.points.size()) +
                         " surface points, the model " + std::to_string(prior.points.size()),
                     "connect the samples of the template that all instances were matched with");
  }
  const Anchors anchors = anchors_of(points.points.span(), prior.points.span(), monitor);
  Moved moved = moved_along(SmoothMap(anchors.from, anchors.to), surface, monitor, 0, 1);
  if (moved.folded > 0) {
    monitor.warn("the mesh of the mean folds: " + triangles_in_words(moved.folded) +
                 " of the template's surface lie where it is turned inside out; is the template like the "
                 "other shapes?");
  }
  return {std::move(moved.vertices), surface.triangles};
}

ShapeMesh shape_mesh(const ShapePrior& prior, std::span<const double> scores,
                     const std::optional<std::array<double, 12>>& pose, const Balls& balls,
                     Monitor& monitor) {
  if (prior.triangles.empty()) {
    labelled_instance_points(prior, scores);  // refuses too many scores
    monitor.warn(
        "the model has no mesh, so its instances have none: make it again from its instances with "
        "shape_prior.json, or take the surface of the balls (BallMesh)");
    return {};
  }
  const TriangleMesh mean{prior.vertices, prior.triangles};
  const std::vector<Vec3> target = labelled_instance_points(prior, scores);
  ShapeMesh result;
  std::vector<Vec3> vertices(prior.vertices.begin(), prior.vertices.end());
  if (std::any_of(scores.begin(), scores.end(), [](double score) { return score != 0; })) {
    const Anchors anchors = anchors_of(prior.points.span(), target, monitor);
    Moved moved = moved_along(SmoothMap(anchors.from, anchors.to), mean, monitor, 0, 0.6);
    vertices = std::move(moved.vertices);
    result.check.folded = moved.folded;
  }
  if (pose) {
    const auto& t = *pose;
    for (Vec3& p : vertices) {
      p = {t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3], t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
           t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]};
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!is_finite(vertices[i]))
      throw InputError("vertex " + std::to_string(i) + " of the mesh is not finite",
                       "take scores between -3 and 3: they are standard deviations");
  }
  result.mesh = {std::move(vertices), prior.triangles};
  ShapeMeshCheck& check = result.check;
  check.closed = mesh_topology(mean).closed;
  if (check.closed) check.volume = volume_of(result.mesh);
  PartMonitor own(monitor, 0.6, 0.75), here(monitor, 0.75, 0.9);
  check.of_mean = intersections_of(mean, own);
  check.intersections = intersections_of(result.mesh, here);
  measure_distances(result.mesh, balls, check, monitor);
  if (check.folded > 0 || check.intersections > check.of_mean) {
    monitor.warn("the mesh folds: " + triangles_in_words(check.folded) + " turned inside out, " +
                 std::to_string(check.intersections) + " pairs of triangles cross, " +
                 std::to_string(check.of_mean) +
                 " of them on the mean already: this instance is farther from the mean than its surface can "
                 "follow. Take scores nearer 0, or the surface of the balls (BallMesh)");
  }
  return result;
}

}  // namespace ballflow::geometry
