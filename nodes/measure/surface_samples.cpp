#include "measure/surface_samples.hpp"

#include <cmath>
#include <limits>

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double segment_distance(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0;
  return distance(p, a + t * ab);
}

/// How many parts an edge is split in, as a double: there may be too many for an integer.
double parts_of_edge(const std::array<Vec3, 3>& corners, double spacing) {
  const auto& [a, b, c] = corners;
  const Vec3 centroid = (1.0 / 3) * (a + b + c);
  const double radius = std::max({distance(a, centroid), distance(b, centroid), distance(c, centroid)});
  return std::max(1.0, std::ceil(radius / spacing));
}

}  // namespace

double triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double squared = squared_length(normal);
  const auto left_of = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, p - from), normal) >= 0; };
  if (squared > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    return std::abs(dot(p - a, normal)) / std::sqrt(squared);
  }
  return std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

ComparedSurface::ComparedSurface(const PointSet& points, const TriangleMesh& mesh)
    : points_(points.points), mesh_(mesh) {
  tree_ = is_cloud() ? BoxTree(points_.span()) : BoxTree(boxes_of(mesh_.vertices, mesh_.triangles));
}

double ComparedSurface::distance_to(Vec3 p) const {
  return tree_.smallest(p, infinity, -infinity, [&](std::size_t i) {
    if (is_cloud()) return distance(p, points_[i]);
    const auto corners = triangle(i);
    // Rounded below that of the box it would depend on the order in which triangles are looked at.
    return std::max(distance_to_box(bounding_box(corners), p),
                    triangle_distance(p, corners[0], corners[1], corners[2]));
  });
}

void ComparedSurface::sample(double spacing, Budget& budget) {
  if (is_cloud()) return budget.spend(static_cast<std::int64_t>(points_.size()));
  edges_.reserve(mesh_.triangles.size());
  first_.assign(1, 0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const double edges =
        std::min(parts_of_edge(triangle(t), spacing), 1e6);  // 1e12 parts are too many anyway
    const auto parts = static_cast<std::int64_t>(edges * edges);
    budget.spend(parts);
    edges_.push_back(static_cast<std::int32_t>(edges));
    first_.push_back(first_.back() + parts);
  }
}

ComparedSurface::Parts::Parts(const std::array<Vec3, 3>& corners, std::int32_t edges, std::int64_t number)
    : a_(corners[0]), ab_(corners[1] - corners[0]), ac_(corners[2] - corners[0]), edges_(edges) {
  // Before row i there are i (2 edges - i) parts, and `rest` = (edges - row)^2 of them from the row on.
  const std::int64_t rest = std::int64_t{edges} * edges - number;
  auto rows = static_cast<std::int64_t>(std::sqrt(static_cast<double>(rest)));
  while (rows * rows < rest) ++rows;
  while ((rows - 1) * (rows - 1) >= rest) --rows;
  row_ = static_cast<std::int32_t>(edges - rows);
  const auto in_row =
      static_cast<std::int32_t>(number - std::int64_t{row_} * (2 * std::int64_t{edges} - row_));
  column_ = in_row / 2;
  turned_ = in_row % 2 != 0;
  area_ = length(cross(ab_, ac_)) / 2 / (static_cast<double>(edges) * static_cast<double>(edges));
}

Vec3 ComparedSurface::Parts::centroid() const {
  const double third = turned_ ? 2.0 / 3 : 1.0 / 3;
  return a_ + ((row_ + third) / edges_) * ab_ + ((column_ + third) / edges_) * ac_;
}

void ComparedSurface::Parts::advance() {
  if (!turned_ && row_ + column_ + 1 < edges_) {
    turned_ = true;
    return;
  }
  turned_ = false;
  if (row_ + ++column_ < edges_) return;
  ++row_;
  column_ = 0;
}

}  // namespace ballflow::geometry
